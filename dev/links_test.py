"""The faults that the check of links must see."""

from links import faults

PAGE = """# A page

## One `part`, of two

[`Item`] and [here](#one-part-of-two), [there](other.md#part), [a folder](src) and [a page](https://a.b/c.html).
Code: `[`, `a[0]`, and a range [0, 1].

```text
[`Nothing`] [x](nowhere)
```

[`Item`]: https://docs.rs/lib/latest/lib/struct.Item.html#method.run
"""


def test_links():
    files = {"docs/other.md": "# Other\n\n## Part\n", "docs/src": None}

    def read(path):
        if path not in files:
            raise FileNotFoundError(path)
        return files[path]

    def source(crate):
        return {"lib": "pub struct Item;\nimpl Item { pub fn run(&self) {} }\npub mod stage;"}.get(crate)

    def of(old="", new="", is_shown=False):
        return faults("docs/page.md", PAGE.replace(old, new), is_shown, read, source)

    assert of() == [], "as it is"
    for old, new, expected in [
        ("[`Item`]: https://docs.rs", "https://docs.rs", "[`Item`] has no address"),
        ("(#one-part-of-two)", "(#one)", "#one leads to no heading"),
        ("other.md#part", "other.md#parts", "other.md#parts leads to no heading"),
        ("other.md", "another.md", "another.md#part leads to no file"),
        ("(src)", "(lib)", "lib leads to no file"),
        ("struct.Item", "struct.Items", "lib has no struct Items"),
        ("struct.Item", "enum.Item", "lib has no enum Item"),
        ("struct.Item.html#method.run", "stages/index.html", "lib has no mod stages"),
        ("method.run", "method.walk", "Item has no walk"),
    ]:
        assert of(old, new) == [f"docs/page.md: {expected}"], (old, of(old, new))
    relative = [fault for fault in of(is_shown=True) if "is relative" in fault]
    assert len(relative) == 2, "a registry shows no tree"


if __name__ == "__main__":
    test_links()
    print("test_links: passed")

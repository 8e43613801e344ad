"""The faults that the checks of texts must see."""

from checks import public, traceability


def test_traceability():
    page = (
        "# Page\n\n## 1. One\n\nIt is. <!-- r:1/1 --> So. And so. <!-- r:- -->\n\n1. Item one: <!-- r:1/2 -->\n\n"
        "   | a |\n   | --- |\n   <!-- r:1/3 -->\n\n```\ncode. More\n```\n<!-- r:1/4 -->\n"
    )
    table = (
        "| mark | demands | seen by |\n| --- | --- | --- |\n| 1/1 | a | `t.rs::one` |\n| 1/2 | b | `golden/a.csv`, "
        "`t.rs::one` |\n| 1/3 | c | `docs/rules.md::same` |\n| 1/4 | d | `rtl/dv/formal/prove_place.sv` |\n"
    )
    tests = "#[test]\nfn one() {}\nfn two() {}\n#[test]\n#[ignore]\nfn three() {}"
    texts = {"t.rs": tests, "docs/rules.md": "\n| `same` | x |", "golden/a.csv": "", "rtl/dv/formal/prove_place.sv": ""}

    def read(path):
        if path not in texts:
            raise FileNotFoundError("no file")
        return texts[path]

    assert traceability(page, table, read) == (4, []), "as it is"
    for text, old, new, expected in [
        (page, "It is. <!-- r:1/1 -->", "It is. More. <!-- r:1/1 -->", "r:1/1 stands behind more than one"),
        (page, "<!-- r:- -->", "", "no mark stands behind: So. And so."),
        (page, "one: <!-- r:1/2 -->", "one:", "no mark stands behind:\nItem one:"),
        (page, "\n   <!-- r:1/3 -->", "", "no mark stands behind:\n| a |"),
        (page, "r:1/2", "r:1/1", "r:1/1 stands in the specification twice"),
        (page, "r:1/2", "r:2/2", "r:2/2 stands in section 1"),
        (page, "It is.", "It is.\n<!-- r:1/7 --> More.", "This mark begins a line"),
        (table, "| 1/1 | a | `t.rs::one` |\n", "", "has 0 rows for r:1/1"),
        (table, "| 1/2 |", "| 1/1 |", "has 2 rows for r:1/1"),
        (table, "| 1/2 |", "| 1/9 |", "has no mark r:1/9"),
        (table, "`t.rs::one` |\n| 1/2", "|\n| 1/2", "r:1/1: `` is no name"),
        (table, "t.rs::one", "t.rs::two", "r:1/1: there is no t.rs::two"),
        (table, "t.rs::one", "t.rs::three", "there is no t.rs::three"),
        (table, "t.rs::one", "u.rs::one", "r:1/1: u.rs: no file"),
        (table, "same", "other", "there is no docs/rules.md::other"),
        (table, "golden/a.csv", "t.rs", "there is no t.rs"),
    ]:
        changed = text.replace(old, new, 1)
        _, errors = traceability(*((changed, table) if text == page else (page, changed)), read)
        assert any(expected in error for error in errors), (expected, errors)


def test_public():
    source = (
        "pub struct Used;\n/// Text.\npub const fn lonely(x: u32) {}\npub(crate) fn own() {}\npub const ALONE: u32 = 1;\n"
        "impl Used {\n    pub fn method(&self) {}\n}\npub use other::Thing;\n\n#[cfg(test)]\nmod tests {\n    pub fn helper() {}\n}\n"
    )
    tests = "use lib::Used; // lonely\nfn f(x: Used) { x.method() }"
    lonely, alone = "lib/src/lib.rs:3: lonely", "lib/src/lib.rs:5: ALONE"
    for more, expected in [("", [lonely, alone]), ("lonely(1)", [alone]), ("lonely(ALONE)", [])]:
        assert public(["lib"], {"lib/src/lib.rs": source, "lib/tests/a.rs": tests + more}) == (4, expected), more
    types = "pub struct Result;\npub struct Nobody;\npub fn f() -> Result {}\n"
    found = public(["lib"], {"lib/src/lib.rs": types, "lib/tests/a.rs": "f()"})
    assert found == (3, ["lib/src/lib.rs:2: Nobody"]), "a type comes with its caller"


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"{name}: passed")

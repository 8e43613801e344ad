"""The faults that the checks of texts must see."""

from checks import WIDTH, public, traceability, width


def test_traceability():
    page = "# Page\n\n## 1. One\n\nIt is.\n\n## 2. Two\n\n### 2.1 A\n\nSo.\n\n### 2.2 B\n\n| 1 | a |\n"
    table = (
        "| section | demands | seen by |\n| --- | --- | --- |\n| 1 | a | `t.rs::one` |\n| 1 | b | `golden/a.csv`, "
        "`t.rs::one` |\n| 2.1 | c | `docs/rules.md::same` |\n| 2.2 | d | `rtl/dv/formal/prove_place.sv` |\n"
    )
    tests = "#[test]\nfn one() {}\nfn two() {}\n#[test]\n#[ignore]\nfn three() {}"
    texts = {"t.rs": tests, "docs/rules.md": "\n| `same` | x |", "golden/a.csv": "", "rtl/dv/formal/prove_place.sv": ""}

    def read(path):
        if path not in texts:
            raise FileNotFoundError("no file")
        return texts[path]

    assert traceability(page, table, read) == (4, []), "as it is"
    for text, old, new, expected in [
        (page, "### 2.2 B", "### 2.3 B", "section 2.2, d: the specification has no such section"),
        (page, "## 2. Two", "## 3. Three\n\nMore.\n\n## 2. Two", "no row for section 3"),
        (table, "| 2.1 | c | `docs/rules.md::same` |\n", "", "no row for section 2.1"),
        (table, "| 1 | b |", "| 9 | b |", "section 9, b: the specification has no such section"),
        (table, "`t.rs::one` |\n| 1", "|\n| 1", "section 1, a: `` is no name"),
        (table, "t.rs::one", "t.rs::two", "section 1, a: there is no t.rs::two"),
        (table, "t.rs::one", "t.rs::three", "there is no t.rs::three"),
        (table, "t.rs::one", "u.rs::one", "section 1, a: u.rs: no file"),
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


def test_width():
    long, word = "word " * 30, "w" * (WIDTH + 9)
    for line, expected in [
        (f"/// {long}", 1),
        (f"    // {long}", 1),
        (f"//! {long[: WIDTH - 4]}", 0),
        (f"//! ```text\n//! {long}\n//! ```", 0),
        (f"//! ```text\n//! ```\n//! {long}", 1),
        (f"/// | {long} |", 0),
        (f"/// {word}", 0),
        (f"let text = \"{long}\";", 0),
        (f"let text = r#\"{long}\"#;", 0),
        (f'let quote = (\'"\', \'\\\'\', {"x, " * 40});', 1),
        (f"let text = (\"short\", {'x, ' * 40});", 1),
        (f"let text = (\"{'w' * 90}\")?;", 0),
        (f"let text = (\"{'w' * 70}\", a, b, c, d, e, f, g);", 1),
        (f"call(); // {long}", 1),
        ("binned!(" + "$more:tt " * 15, 1),
    ]:
        assert len(width("a.rs", line)) == expected, line


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"{name}: passed")

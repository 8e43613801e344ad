"""The circles of imports that the check of modules must see, and what it must allow."""

from modules import check


def faults(**texts):
    """The circles of a crate with these modules; `a__b` stands for a/b.rs."""
    return check({f"c/src/{name.replace('__', '/')}.rs": text for name, text in texts.items()})[1]


def test_circles():
    assert faults(a="use crate::b::B;", b="use super::a::A;") == ["c/src/a.rs imports b; c/src/b.rs imports a"]
    assert len(faults(a="use crate::b;", b="use crate::c;", c="fn f() { crate::a::f() }")) == 1, "of three"
    assert len(faults(a="use crate::{b::{self, B}, d};", b="use crate::a::A as X;", d="")) == 1, "in a list"
    assert len(faults(a="use crate::b;", b="", b__part="use crate::a::A;")) == 1, "by a part of a module"
    assert len(faults(p="", p__a="use super::b;", p__b="use super::a;")) == 1, "inside a module"
    assert len(faults(a="use crate::b;", b="mod inside {\n    use super::super::a;\n}\n")) == 1, "from a module in a file"
    two = faults(a="use crate::b;", b="use crate::a;", c="use crate::d;", d="use crate::c;")
    assert len(two) == 2, f"each: {two}"


def test_what_is_allowed():
    assert not faults(a="use crate::b;", b="use crate::c;", c=""), "one direction"
    assert not faults(a="use crate::b;", b="// use crate::a;\nconst A: &str = \"crate::a\";"), "no code"
    assert not faults(a="use self::part::P;", a__part="use super::A;"), "a module and its own part"
    assert not faults(lib="mod a;\nuse a::A;", a="use crate::B;"), "the root and its modules"
    assert not faults(a="use crate::b;", b="x\n#[cfg(test)]\nmod tests {\n    use crate::a;\n}"), "tests"
    assert not faults(a="use crate::b;", b__tests="use crate::a;"), "tests in a file"
    assert not faults(a="use other::b;", b="use crate::a;"), "another crate"


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
            print(f"{name}: passed")

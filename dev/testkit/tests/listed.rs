//! Lists of faults are parsed as documented.

use tess_testkit::listed::parse;

const LIST: &str = "\
# A list
in src
seen by a/tests/b.rs one two
fault first
equivalent: nobody asks
<<<
x + 1
===
x - 1
>>>

planted by a/tests/c.rs
fault second: y
<<<
y
z
===
>>>
fault third
<<<
y;
===
>>>
";

#[test]
fn a_list_has_its_faults() {
    let faults = parse(LIST).expect("a list");
    let [first, second, third] = &faults[..] else { panic!("{} faults", faults.len()) };
    assert_eq!(
        (first.name.as_str(), second.name.as_str(), third.folder.as_str()),
        ("first", "second: y", "src"),
        "names and folder"
    );
    assert_eq!(
        (first.tests.as_str(), &first.filters[..]),
        ("a/tests/b.rs", &["one".to_owned(), "two".to_owned()][..]),
        "tests"
    );
    assert_eq!((third.tests.as_str(), third.filters.len()), ("a/tests/c.rs", 0), "tests");
    let planted = faults.iter().map(|fault| fault.is_planted_by_tests);
    assert_eq!(planted.collect::<Vec<_>>(), [false, true, true], "who plants them");
    assert_eq!(first.equivalent.as_deref(), Some("nobody asks"), "the reason");
    assert_eq!((&second.equivalent, &third.equivalent), (&None, &None), "no reason");
    assert_eq!(first.planted("x + 1, x + 1").as_deref(), Some("x - 1, x - 1"), "one line");
    assert_eq!(first.places("x + 1, x + 1"), 2, "places");
    assert_eq!(second.planted("a\ny\nz\n").as_deref(), Some("a\n\n"), "two lines go");
    assert_eq!(third.planted("y;").as_deref(), Some(""), "a line goes");
    assert_eq!(third.planted("y"), None, "no such text");
}

#[test]
fn a_line_of_another_form_is_refused_with_its_number() {
    for (wrong, line) in [
        ("fault a\n<<<\nx\n===\ny\n>>>\n", 1),
        ("in src\nfault a\n<<<\nx\n===\ny\n>>>\n", 2),
        ("in src\nseen by t\nfault a\nx\n===\ny\n>>>\n", 3),
        ("in src\nseen by t\nfault a\n<<<\nx\n>>>\n", 3),
        ("in src\nseen by t\n", 2),
        ("in src\nplanted by t\n", 2),
        ("in src\nseen by t\nseen by u\nfault a\n<<<\nx\n===\ny\n>>>\n", 2),
        ("\nwhat", 2),
    ] {
        let message = parse(wrong).expect_err(wrong);
        assert!(message.starts_with(&format!("line {line}: ")), "{wrong}: {message}");
    }
}

//! The examples run, and see what they are to show.

#[path = "../examples/device.rs"]
#[expect(dead_code, reason = "its `main` reads the command line")]
mod device;

const CAPTURE: &str = include_str!("../examples/device.capture");

#[test]
fn a_capture_is_compared() {
    let report = device::compare(CAPTURE).expect("a capture");
    assert_eq!((report.cases, report.mismatches), (3, 0), "{report:?}");
    let moved = CAPTURE.replacen("at 0.5 0\n", "at 0.5 0.5\n", 1);
    assert_ne!(moved, CAPTURE, "a fault is planted");
    let report = device::compare(&moved).expect("a capture");
    assert_eq!((report.cases, report.mismatches), (3, 1), "{report:?}");
    let shown = report.differences[0].to_string();
    assert!(shown.contains("point (08000, 00000): observed 0 times"), "{shown}");
}

#[test]
fn a_capture_that_is_none_is_refused() {
    let error = |capture: &str| device::compare(capture).expect_err("refused").to_string();
    assert_eq!(error("# nothing"), "the capture has no patches");
    assert_eq!(error("at 0 0"), "line 1: expected `draw`, then `at` and `prim`");
    let inexact = CAPTURE.replacen("at 0.5 0\n", "at 0.1 0\n", 1);
    assert!(error(&inexact).ends_with("0.1 is no multiple of 2^-16 in 0..1"), "{inexact}");
}

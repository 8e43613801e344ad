//! Tests that the examples run and detect what they should show.

#[path = "../examples/device.rs"]
#[expect(dead_code, reason = "its `main` reads the command line")]
mod device;

const CAPTURE: &str = include_str!("../examples/device.capture");

#[test]
fn a_capture_is_judged() {
    let verdicts = device::judge(CAPTURE).expect("a capture");
    assert_eq!((verdicts.report.cases, verdicts.report.mismatches), (3, 0), "{verdicts}");
    assert_eq!((verdicts.in_order, verdicts.in_any_order), (0, 3), "{verdicts}");
    let moved = CAPTURE.replacen("at 0.5 0\n", "at 0.5 0.5\n", 1);
    assert_ne!(moved, CAPTURE, "a fault is planted");
    let verdicts = device::judge(&moved).expect("a capture");
    assert_eq!((verdicts.report.cases, verdicts.report.mismatches), (3, 1), "{verdicts}");
    let shown = verdicts.to_string();
    assert!(shown.contains("point (08000, 00000): observed 0 times"), "{shown}");
    assert!(!shown.contains("explained"), "{shown}");
}

#[test]
fn an_explanation_is_given() {
    let quad = CAPTURE.replacen("triangle_ccw", "triangle_cw", 1);
    let turned = quad.replacen("tri integer triangle_cw", "tri integer triangle_ccw", 1);
    assert!(quad != CAPTURE && turned != quad, "both surfaces turn the other way");
    let shown = device::judge(&turned).expect("a capture").to_string();
    assert!(
        shown.contains("explained, not allowed: every triangle turns the other way"),
        "{shown}"
    );
    // If only the quad turns, the triangle refutes it.
    let shown = device::judge(&quad).expect("a capture").to_string();
    assert!(!shown.contains("every triangle turns"), "{shown}");
}

#[test]
fn a_capture_that_is_none_is_refused() {
    let error = |capture: &str| device::judge(capture).expect_err("refused").to_string();
    assert_eq!(error("# nothing"), "the capture has no patches");
    assert_eq!(error("at 0 0"), "line 1: expected `draw`, then `at` and `prim`");
    let inexact = CAPTURE.replacen("at 0.5 0\n", "at 0.1 0\n", 1);
    assert!(error(&inexact).ends_with("0.1 is not a multiple of 2^-16 in 0..1"), "{inexact}");
}

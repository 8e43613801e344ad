//! Tests that the example that fuzzes a device finds a planted fault, and nothing without one.

#[path = "../examples/fuzz/main.rs"]
#[expect(dead_code, reason = "its `main` reads the command line")]
mod fuzz;

use fuzz::device::Device;
use tess_verify::Case;

fn search(truncates: bool, cases: usize) -> Option<String> {
    let mut device = Device { truncates };
    let mut left = 0..cases;
    fuzz::search(&mut device, 1, || left.next().is_some())
}

#[test]
fn a_right_device_passes() {
    assert_eq!(search(false, 20_000), None);
}

#[test]
fn a_planted_fault_is_found_and_its_line_shows_it_again() {
    let message = search(true, 20_000).expect("a finding");
    let (line, rest) = message.split_once('\n').expect("a case line, then more");
    let case: Case = line.parse().expect("a case");
    assert!(rest.contains(&case.command()) && rest.contains("(stage: "), "{message}");
    let again = |truncates| fuzz::device::check(&mut Device { truncates }, &case);
    assert_eq!(again(true), Err(message.clone()), "the fault shows again");
    assert_eq!(again(false), Ok(()), "without the fault the case is right");
}

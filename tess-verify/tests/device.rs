//! Listings of a device under test: which differences are seen, and which stage they point to.

use tess_core::{DomainPoint, Tessellation};
use tess_verify::backend::Backend;
use tess_verify::case::Case;
use tess_verify::checker::{Report, check};
use tess_verify::compare::Stage;
use tess_verify::core_backend::CoreBackend;
use tess_verify::strength::{Conversion, Elements, Order, Strength};
use tess_verify::vectors::{Listing, VectorFile};

const TRIANGLE: &str =
    "case tri fractional_even triangle_ccw ruler 40733333 40a00000 40e66666 4119999a";

fn case(line: &str) -> Case {
    line.parse().unwrap_or_else(|error| panic!("{line}: {error}"))
}

/// Checks what a device says of `case`.
fn observe(case: Case, output: Tessellation, strength: Strength) -> Report {
    let listing = Listing { line: 0, case, output };
    let text = format!("# tess-vectors 1 kind=listings count=1 source=device\n{listing}");
    let file = VectorFile::new("device", text.as_bytes()).expect("a header");
    let mut backends: [Box<dyn Backend>; 1] = [Box::new(CoreBackend)];
    check(file, &mut backends, strength, &|_| ()).expect("a verdict")
}

/// The stage that a wrong output points to.
fn stage(line: &str, output: Tessellation) -> Stage {
    let report = observe(case(line), output, Strength::default());
    assert_eq!((report.cases, report.mismatches), (1, 1), "the difference is seen");
    report.differences[0].mismatch.stage
}

fn right(line: &str) -> Tessellation {
    case(line).patch().tessellate()
}

#[test]
fn a_right_device_passes() {
    let report = observe(case(TRIANGLE), right(TRIANGLE), Strength::default());
    assert_eq!((report.cases, report.mismatches), (1, 0), "{report:?}");
}

#[test]
fn stages_of_a_device_are_told_apart() {
    let truncated = right(&TRIANGLE.replace("40733333", "40733300"));
    assert_eq!(stage(TRIANGLE, truncated), Stage::Factors, "converted by truncation");
    let center = right(&TRIANGLE.replace("ruler", "center"));
    assert_eq!(stage(TRIANGLE, center), Stage::Context, "split in another order");
    let mut moved = right(TRIANGLE);
    moved.points[3] = DomainPoint::from_bits(0, 1);
    assert_eq!(stage(TRIANGLE, moved), Stage::Location, "a point in the wrong place");
    let mut swapped = right(TRIANGLE);
    swapped.points.swap(2, 9);
    assert_eq!(stage(TRIANGLE, swapped), Stage::PointOrder, "points in another order");
    let clockwise = right(&TRIANGLE.replace("ccw", "cw"));
    assert_eq!(stage(TRIANGLE, clockwise), Stage::Stitch, "the other winding");
    assert_eq!(stage(TRIANGLE, Tessellation::default()), Stage::Factors, "culled");
    let mut short = right(TRIANGLE);
    short.indices.truncate(6);
    assert_eq!(stage(TRIANGLE, short), Stage::Counts, "too few indices");
}

#[test]
fn strength_applies_to_devices() {
    let mut turned = right(TRIANGLE);
    turned.indices[..3].rotate_left(1);
    let any = Strength { order: Order::Any, ..Strength::default() };
    assert_eq!(observe(case(TRIANGLE), turned.clone(), any).mismatches, 0, "leading vertex");
    assert_eq!(observe(case(TRIANGLE), turned, Strength::default()).mismatches, 1, "exact order");

    let mut missing = right(TRIANGLE);
    let first = missing.indices[..3].to_vec();
    missing.indices[3..6].copy_from_slice(&first);
    let report = observe(case(TRIANGLE), missing, any);
    let shown = report.differences[0].mismatch.to_string();
    assert!(shown.starts_with("primitive ("), "{shown}");
    assert!(shown.contains("times, expected"), "{shown}");

    let tie = TRIANGLE.replace("40733333", "40733320");
    let up = right(&TRIANGLE.replace("40733333", "40733340"));
    let lenient = Strength { conversion: Conversion::Within06Ulp, ..Strength::default() };
    assert_eq!(observe(case(&tie), up, lenient).mismatches, 0, "the other neighbour");
}

/// A device that has points alone is told of a wrong point, not of the indices that it lacks.
#[test]
fn points_alone() {
    let strength = Strength { elements: Elements::Points, ..Strength::default() };
    let mut device = right(TRIANGLE);
    device.indices.clear();
    assert_eq!(observe(case(TRIANGLE), device.clone(), strength).mismatches, 0, "no indices");
    let v = device.points[3].v.to_bits();
    device.points[3] = DomainPoint::from_bits(0, v ^ 1);
    let report = observe(case(TRIANGLE), device.clone(), strength);
    let shown = report.differences[0].mismatch.to_string();
    assert!(shown.starts_with("point 3 v: observed"), "{shown}");
    device.points.pop();
    let report = observe(case(TRIANGLE), device, strength);
    assert_eq!(report.differences[0].mismatch.stage, Stage::Counts, "a point too few");
}

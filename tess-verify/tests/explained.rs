//! Tests of reports with many differences: what explains all of them, and how many differences
//! there are of each kind.

use tess_core::{Domain, DomainPoint, Tessellation};
use tess_verify::Case;
use tess_verify::check::{
    Conversion, Denormals, Elements, Freedoms, ListOrder, SpecStage, Strength, check_device,
};

const ANY: Strength = Strength {
    order: ListOrder::Any,
    elements: Elements::Primitives,
    conversion: Conversion::Exact,
    denormals: Denormals::Keep,
};
const CULLED: &str = "case tri integer triangle_cw ruler 00000001 40400000 40400000 40400000";
/// A factor of 3 + 2^-17: converted to 0x30000 by rounding to nearest, ties to even, or to 0x30001.
const TIE: &str = "case tri fractional_odd line center 40a00000 40400020 40200000 40900000";

fn case(line: &str) -> Case {
    line.parse().unwrap_or_else(|error| panic!("{line}: {error}"))
}

/// A device that flushes denormals.
fn flushed() -> (Case, Tessellation) {
    (case(CULLED), Tessellation::default())
}

/// A device that rounds a tie up: its result is the model's for the next number.
fn rounded_up() -> (Case, Tessellation) {
    let other = case(&TIE.replace("40400020", "40400040"));
    (case(TIE), other.patch().tessellate())
}

fn moved(line: &str) -> (Case, Tessellation) {
    let case = case(line);
    let mut output = case.patch().tessellate();
    output.points[4] = DomainPoint::from_bits(0x1234, 0x4321);
    (case, output)
}

fn freedom(answers: &[(Case, Tessellation)]) -> Option<String> {
    let report = check_device(answers.iter().cloned(), ANY);
    assert_eq!(report.mismatches, answers.len() as u64, "{report}");
    report.freedoms().map(Freedoms::options)
}

#[test]
fn a_freedom_that_explains_all() {
    let wrong = moved("case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000");
    assert_eq!(freedom(&[flushed()]).as_deref(), Some("--denormals flush"), "a culled patch");
    assert_eq!(freedom(&[rounded_up()]).as_deref(), Some("--conversion 0.6ulp"), "a tie");
    let both = "--denormals flush --conversion 0.6ulp";
    assert_eq!(freedom(&[rounded_up(), flushed()]).as_deref(), Some(both), "one of each");
    assert_eq!(freedom(&[flushed(), wrong]), None, "and one that nothing explains");
    assert_eq!(check_device([], ANY).explanations, [], "nothing to explain");
}

/// A device that emits its triangles from the last to the first.
fn reversed(line: &str) -> (Case, Tessellation) {
    let case = case(line);
    let mut output = case.patch().tessellate();
    output.indices = output.indices.chunks(3).rev().flatten().copied().collect();
    (case, output)
}

#[test]
fn another_order_explains_all() {
    let line = "case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000";
    let freedom = |answers: &[(Case, Tessellation)]| {
        let report = check_device(answers.iter().cloned(), Strength::default());
        assert_eq!(report.mismatches, answers.len() as u64, "{report}");
        report.freedoms().map(Freedoms::options)
    };
    assert_eq!(freedom(&[reversed(line)]).as_deref(), Some("--order any"), "in order only");
    assert_eq!(freedom(&[reversed(line), moved(line)]), None, "and a point elsewhere");
    let both = Some("--denormals flush --order any");
    assert_eq!(freedom(&[reversed(line), flushed()]).as_deref(), both, "and a culled patch");
}

#[test]
fn a_stray_element_is_shown() {
    let stray = moved("case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000");
    let report = check_device([stray], ANY);
    let found = report.differences[0].mismatch.to_string();
    assert!(found.contains("12"), "an element of the device: {found}");
}

#[test]
fn differences_are_counted_by_stage_and_configuration() {
    let [small, large, quad] = [
        "case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000",
        "case tri integer triangle_cw ruler 40e00000 40e00000 40e00000 40e00000",
        "case quad integer line ruler 40400000 40400000 40400000 40400000 40400000 40400000",
    ];
    let mut answers = vec![moved(quad), flushed(), moved(large)];
    answers.extend((0..30).map(|_| moved(small)));
    let report = check_device(answers, ANY);
    let groups = report.groups();
    let counts: Vec<_> = groups.iter().map(|group| (group.stage, group.mismatches)).collect();
    let [lines, culled, tri] = &groups[..] else { panic!("{counts:?}") };
    assert_eq!(
        counts,
        [(SpecStage::Location, 1), (SpecStage::Factors, 1), (SpecStage::Location, 31)]
    );
    assert_eq!((lines.smallest.number, culled.smallest.number), (1, 2), "by size");
    assert_eq!(
        tri.smallest.number, 4,
        "the first of the small ones, though a large one comes before"
    );
    assert_eq!(lines.config.map(|(domain, _)| domain), Some(Domain::Quad), "{lines}");
    assert_eq!(tri.to_string(), "      31  location     tri integer triangle_cw ruler");
}

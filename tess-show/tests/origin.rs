//! The origins of elements that a report has as different.

use tess_core::{DomainPoint, Tessellation};
use tess_verify::Case;
use tess_verify::check::{
    Conversion, Denormals, Elements, ListOrder, Report, Strength, check_device,
};

const ANY: Strength = Strength {
    order: ListOrder::Any,
    elements: Elements::Primitives,
    conversion: Conversion::Exact,
    denormals: Denormals::Keep,
};

fn case(line: &str) -> Case {
    line.parse().unwrap_or_else(|error| panic!("{line}: {error}"))
}

/// A patch with point 4 elsewhere.
fn moved(line: &str) -> (Case, Tessellation) {
    let case = case(line);
    let mut output = case.patch().tessellate();
    output.points[4] = DomainPoint::from_bits(0x1234, 0x4321);
    (case, output)
}

fn origin(report: &Report) -> Option<String> {
    tess_show::origin(&report.differences[0])
}

#[test]
fn elements_in_any_order_come_from_somewhere() {
    let line = "case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000";
    let (case, mut output) = (case(line), case(line).patch().tessellate());
    output.indices.truncate(output.indices.len() - 3);
    let report = check_device([(case, output.clone())], ANY);
    let last = output.indices.len() / 3;
    let shown = origin(&report).expect("a triangle of the model");
    assert!(shown.starts_with(&format!("primitive {last}: ")), "{shown}");

    let points = "case tri integer point ruler 40400000 40400000 40400000 40400000";
    let (case, mut output) = (self::case(points), self::case(points).patch().tessellate());
    let last = output.indices.pop().expect("points");
    let shown = origin(&check_device([(case, output)], ANY)).expect("a point of the model");
    assert!(shown.starts_with(&format!("point {last}: ")), "{shown}");
}

/// In the exact order, elements have numbers, which are those of the model's elements.
#[test]
fn elements_come_from_their_numbers() {
    let line = "case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000";
    let report = check_device([moved(line)], Strength::default());
    let shown = origin(&report).expect("a point of the model");
    assert!(shown.starts_with("point 4: "), "{shown}");
    let (case, mut output) = (case(line), case(line).patch().tessellate());
    output.indices[7] = 0;
    let shown = origin(&check_device([(case, output)], Strength::default()));
    assert!(shown.is_some_and(|shown| shown.starts_with("primitive 2: ")), "index 7");
}

//! Faults planted in captures are detected and explained correctly.
#![expect(
    clippy::float_cmp,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "exact numbers"
)]

use std::sync::{Arc, OnceLock};
use tess_core::{Domain, Tessellation};
use tess_probe::{Captured, Info, Judge, Method, ProbeReport};
use tess_verify::check::{Denormals, Known, ListOrder, Strength};
use tess_verify::{Case, mistakes};

const LINE: &str = "case quad fractional_odd triangle_cw ruler 40a00000 40d00000 40e00000 40500000 40a80000 40c00000";
const DENORMAL: &str = "case tri integer triangle_cw ruler 00000001 40400000 40400000 40400000";
const CULLED: &str = "case tri integer triangle_cw ruler 00000000 40400000 40400000 40400000";
const ISOLINES: &str = "case isoline integer line ruler 40400000 40a00000";

fn case(line: &str) -> Case {
    line.parse().expect("a case")
}

/// A device of no manufacturer.
fn info() -> &'static Info {
    static INFO: OnceLock<Info> = OnceLock::new();
    INFO.get_or_init(|| Info::named("a device", 64))
}

/// The output of an exact device.
fn exact(case: &Case) -> Captured {
    drawn(case, &case.patch().tessellate())
}

/// What is captured of a patch with this output.
fn drawn(case: &Case, output: &Tessellation) -> Captured {
    let third = |[u, v]: [u32; 2]| match case.domain() {
        // Negative outside of the domain.
        Domain::Triangle => match 0x1_0000u32.checked_sub(u + v) {
            Some(w) => float(w),
            None => float(u + v - 0x1_0000) | 1 << 31,
        },
        _ => 0,
    };
    let vertex = |&index: &u32| {
        let point = output.points[index as usize];
        let uv = [point.u.to_bits(), point.v.to_bits()];
        [float(uv[0]), float(uv[1]), third(uv)]
    };
    Captured { vertices: output.indices.iter().map(vertex).collect() }
}

/// The bits of a 16.16 number up to 1 as a binary32.
fn float(number: u32) -> u32 {
    match number.checked_ilog2() {
        None => 0,
        Some(top) => (127 + top - 16) << 23 | (number << (23 - top)) & 0x7F_FFFF,
    }
}

fn any() -> Strength {
    Strength { order: ListOrder::Any, ..Strength::default() }
}

/// The report on one patch after a fault is planted in its capture.
fn judged(line: &str, strength: Strength, fault: impl FnOnce(&mut Captured)) -> ProbeReport {
    let case = case(line);
    let mut captured = exact(&case);
    fault(&mut captured);
    let mut judge = Judge::new(info(), Method::Primitives, strength);
    judge.add(&case, &captured);
    judge.finish()
}

/// The report on one patch of a device that makes a mistake of the table.
fn mistaken(line: &str, strength: Strength, words: &str) -> ProbeReport {
    let case = case(line);
    let mistake = mistakes::named(words).unwrap_or_else(|| panic!("{words} is not in the table"));
    let request = mistakes::requests([case]).next().expect("one");
    let wrong = mistake.wrong_answer(&request, &case.patch().tessellate());
    let wrong = wrong.unwrap_or_else(|| panic!("{words} does not show on {line}"));
    judged(line, strength, |own| *own = drawn(&case, &wrong))
}

fn explained(report: &ProbeReport) -> Vec<&str> {
    report.explanations.iter().map(|explanation| &*explanation.words).collect()
}

#[test]
fn exact_captures_are_equal_in_order() {
    for line in [LINE, DENORMAL, CULLED] {
        let report = judged(line, Strength { order: ListOrder::Sequence, ..any() }, |_| {});
        assert_eq!(
            (report.different, report.odd, report.rows[0].sequence),
            (0, 0, 1),
            "{line}: {report}"
        );
    }
}

/// A known case that differs is not counted as different; another known case changes nothing.
#[test]
fn known_differences_are_no_verdict() {
    for (known, different, excused) in [(LINE, 0, 1), (DENORMAL, 1, 0)] {
        let known = Known::read("known", known.as_bytes(), None, "").expect("a case");
        let known = Arc::new(known);
        let mut judge = Judge::new(info(), Method::Primitives, any()).with_known(&known);
        let mut captured = exact(&case(LINE));
        captured.vertices.truncate(3);
        judge.add(&case(LINE), &captured);
        let report = judge.finish();
        assert_eq!((report.different, report.known), (different, excused), "{report}");
        assert_eq!(report.rows[0].different, different, "{report}");
    }
}

/// A case that is right when it is repeated shows that earlier work matters; one that is wrong
/// again does not.
#[test]
fn a_case_that_passes_alone_is_said() {
    let lost = |captured: &mut Captured| captured.vertices.truncate(3);
    for (alone, passes) in [(judged(LINE, any(), |_| {}), true), (judged(LINE, any(), lost), false)]
    {
        let report = judged(LINE, any(), lost).with_alone(&alone);
        assert_eq!(report.passes_alone, passes, "{alone}");
    }
}

#[test]
fn a_moved_point_is_seen_with_its_distance() {
    let moved = |captured: &mut Captured| {
        let vertex = captured.vertices[7];
        let to = float(3 + (f32::from_bits(vertex[0]) * 65536.0) as u32);
        for other in captured.vertices.iter_mut().filter(|other| **other == vertex) {
            other[0] = to;
        }
    };
    let report = judged(LINE, any(), moved);
    assert_eq!(
        (report.different, report.rows[0].coordinates, report.rows[0].max_units),
        (1, 1, 3),
        "{report}"
    );
    let first = report.unexplained.first.expect("no freedom moves a point");
    assert_eq!((first.line.as_str(), first.stage.as_str()), (LINE, "location"));
    assert_eq!(
        (report.stages["location"], report.rows[0].different),
        (1, 1),
        "counted: {}",
        first.difference
    );
    assert!(report.first_different.is_some_and(|first| first.line == LINE), "and named");
    assert!(first.command.starts_with("tess patch quad"), "{}", first.command);
}

#[test]
fn a_coordinate_between_two_numbers_is_seen() {
    let report = judged(LINE, any(), |captured| captured.vertices[3][1] += 1);
    assert_eq!((report.rows[0].coordinates, report.rows[0].max_units), (1, 1), "{report}");
    let first = report.unexplained.first.expect("it is no freedom");
    assert!(first.difference.contains("not a multiple of 2^-16"), "{}", first.difference);
    assert_eq!(first.captured.output(), None, "nor can it be drawn");
}

#[test]
fn a_lost_triangle_is_seen() {
    let report = judged(LINE, any(), |captured| drop(captured.vertices.drain(6..9)));
    assert_eq!((report.different, report.rows[0].connectivity), (1, 1), "{report}");
    assert_eq!(report.unexplained.first.expect("it is no freedom").stage, "stitch");
}

#[test]
fn a_flipped_triangle_is_seen() {
    let report = mistaken(LINE, any(), "one triangle turns the other way: first");
    assert_eq!((report.different, report.rows[0].connectivity), (1, 1), "{report}");
    assert_eq!(report.unexplained.patches, 1, "one flipped triangle is no orientation: {report}");
}

/// Every mistake of the table that changes what is drawn of a patch is seen, whatever it is; what
/// is captured of the answer is its primitives.
#[test]
fn every_mistake_is_seen() {
    let mut seen = 0;
    for (line, mistake) in [LINE, DENORMAL, CULLED, ISOLINES]
        .into_iter()
        .flat_map(|line| mistakes::all().iter().map(move |mistake| (line, mistake)))
    {
        let case = case(line);
        let request = mistakes::requests([case]).next().expect("one");
        let right = case.patch().tessellate();
        let Some(wrong) = mistake.wrong_answer(&request, &right) else { continue };
        let is_place = |index: &u32| {
            let point = wrong.points.get(*index as usize);
            point.is_some_and(|point| point.u.to_bits().max(point.v.to_bits()) <= 0x1_0000)
        };
        if !wrong.indices.iter().all(is_place) {
            continue; // such an answer is not drawn
        }
        let wrong = drawn(&case, &wrong);
        let strength = Strength { order: ListOrder::Sequence, ..any() };
        let report = judged(line, strength, |own| *own = wrong.clone());
        let is_other = wrong != exact(&case);
        assert_eq!(report.different == 1, is_other, "{line}: {}: {report}", mistake.words());
        seen += u32::from(is_other);
    }
    assert!(seen > 300, "the table shows: {seen}");
}

#[test]
fn other_orders_are_told_apart() {
    let [turned, moved] = ["another vertex leads a triangle", "primitives have another order"];
    let report = mistaken(LINE, any(), turned);
    assert_eq!(
        (report.different, report.rows[0].leading),
        (0, 1),
        "another leading vertex: {report}"
    );
    let report = mistaken(LINE, any(), moved);
    assert_eq!((report.different, report.rows[0].order), (0, 1), "another order: {report}");
    for fault in [turned, moved] {
        let strength = Strength { order: ListOrder::Sequence, ..any() };
        assert_eq!(mistaken(LINE, strength, fault).different, 1, "in sequence they differ");
    }
}

#[test]
fn a_patch_that_should_be_culled_is_seen() {
    let report = mistaken(CULLED, any(), "a discarded patch has a primitive");
    assert_eq!((report.rows[0].culling, report.unexplained.patches), (1, 1), "{report}");
}

#[test]
fn flushed_denormals_are_explained_and_may_be_asked_for() {
    let flush = "an outer level that is a positive denormal discards";
    let report = mistaken(DENORMAL, any(), flush);
    assert_eq!((report.different, report.rows[0].culling), (1, 1), "they differ: {report}");
    assert_eq!(
        (&*report.explanations[0].way, report.unexplained.patches),
        ("flush", 0),
        "{report}"
    );
    assert_eq!(report.explanations.len(), 1, "no mistake is needed: {report}");
    let report = mistaken(DENORMAL, Strength { denormals: Denormals::Flush, ..any() }, flush);
    assert_eq!(report.different, 0, "with the freedom they are equal: {report}");
    let empty = "a patch has no output";
    let report = mistaken(LINE, any(), empty);
    assert_eq!((explained(&report), report.unexplained.patches), (vec![empty], 1), "{report}");
}

/// A freedom that explains every odd patch is distinguished from one that explains only some.
#[test]
fn explanations_of_all_and_of_some() {
    let report = |lines: &[&str]| {
        let mut judge = Judge::new(info(), Method::Primitives, any());
        lines.iter().for_each(|line| judge.add(&case(line), &Captured::default()));
        judge.finish()
    };
    let all = report(&[DENORMAL, DENORMAL]);
    assert_eq!((all.explanations[0].patches, all.explanations[0].is_all), (2, true), "{all}");
    assert!(all.to_string().contains("explains all (2)"), "{all}");
    let some = report(&[DENORMAL, LINE]);
    assert_eq!((some.explanations[0].patches, some.explanations[0].is_all), (1, false), "{some}");
    assert!(some.to_string().contains("explains some (1)"), "{some}");
}

#[test]
fn another_conversion_is_explained() {
    // 3 + 2^-17 is halfway between two numbers; the even one is the model's.
    let line = LINE.replace("40500000", "40400020");
    let case = case(&line);
    let other = case
        .factors
        .map(|factor| if factor == 3.000_007_6 { f32::from_bits(0x4040_0040) } else { factor });
    let other = exact(&Case { factors: other, ..case });
    let report = judged(&line, any(), |captured| *captured = other);
    assert_eq!((report.different, &*report.explanations[0].way), (1, "conversion"), "{report}");
}

#[test]
fn orientations_are_said_in_one_line() {
    let reverse = "every triangle turns the other way";
    let exchange = "u and v are exchanged: order of vertices kept";
    let report = mistaken(LINE, any(), reverse);
    assert_eq!(explained(&report), [reverse], "{report}");
    assert!(
        report.to_string().contains("not allowed: every triangle turns the other way"),
        "{report}"
    );
    let report = mistaken(LINE, any(), exchange);
    assert_eq!(explained(&report), [exchange], "{report}");
}

#[test]
fn a_wrong_third_coordinate_is_seen() {
    let line = "case tri fractional_even triangle_ccw ruler 40a00000 40d00000 40e00000 40500000";
    let report = judged(line, any(), |captured| captured.vertices[2][2] ^= 0x80);
    assert_eq!(
        (report.different, report.rows[0].third, report.unexplained.patches),
        (1, 1, 1),
        "{report}"
    );
    let report = judged(LINE, any(), |captured| captured.vertices[2][2] = 1);
    assert_eq!((report.different, report.rows[0].third), (1, 1), "0 on quads: {report}");
}

/// Points by themselves show moved points and culled patches, in any order and number.
#[test]
fn points_alone_are_judged() {
    let case = case(LINE);
    let exact = exact(&case);
    let report = |captured: &Captured| {
        let mut judge = Judge::new(info(), Method::Points, any());
        judge.add(&case, captured);
        judge.finish()
    };
    let mut turned = exact.clone();
    turned.vertices.reverse();
    assert_eq!(report(&turned).different, 0, "any order");
    let mut moved = exact.clone();
    moved.vertices[0][1] = float(77);
    assert_eq!((report(&moved).different, report(&moved).rows[0].coordinates), (1, 1), "moved");
    assert_eq!(report(&Captured::default()).rows[0].culling, 1, "culled");
}

/// Each digest detects the changes that it is for.
#[test]
fn digests_see_order_and_elements() {
    let digests = |fault: &dyn Fn(&mut Captured)| {
        let row = judged(LINE, any(), fault).rows.remove(0);
        (row.sequence_digest, row.set_digest)
    };
    let right = digests(&|_| {});
    let order = digests(&|captured| captured.vertices.rotate_left(3));
    let leading = digests(&|captured| captured.vertices[..3].rotate_left(1));
    let lost = digests(&|captured| captured.vertices.truncate(3));
    assert!(order.0 != right.0 && order.1 == right.1, "another order");
    assert!(leading.0 != right.0 && leading.1 == right.1, "another leading vertex");
    assert!(lost.0 != right.0 && lost.1 != right.1, "fewer primitives");
}

//! The rules of the standards: what the model holds and breaks, and the fault that each rule alone finds.

use tess_core::fixed_point::ONE;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::rules::{Checker, Row, Rule, RulesReport, Specification, Verdict};
use tess_verify::{Case, GenLevel, Named, Selection};

fn case(line: &str) -> Case {
    line.parse().unwrap_or_else(|error| panic!("{line}: {error}"))
}

fn judge(
    specification: Specification,
    answers: impl IntoIterator<Item = (Case, Tessellation)>,
) -> RulesReport {
    let mut checker = Checker::new(specification);
    for (case, output) in answers {
        checker.add(&case, &output);
    }
    checker.report()
}

fn model(case: Case) -> (Case, Tessellation) {
    (case, case.patch().tessellate())
}

/// The names of the rules with a verdict.
fn rules(report: &RulesReport, verdict: Verdict) -> Vec<&'static str> {
    let rows = report.rows.iter().filter(|row| row.verdict() == verdict);
    rows.map(|row| row.rule.name()).collect()
}

fn row(report: &RulesReport, rule: Rule) -> &Row {
    report.rows.iter().find(|row| row.rule == rule).expect("a rule of the standard")
}

/// The systematic families with the standard split order.
fn population() -> impl Iterator<Item = Case> {
    let split = Some(tess_core::SplitOrder::Ruler);
    Selection { split, ..Selection::level(GenLevel::Rules, 1) }.cases()
}

/// The population exercises every rule. The model holds all of Direct3D's, and of Vulkan's all but those that
/// docs/rules.md names.
#[test]
fn the_model_and_the_standards() {
    let answers: Vec<_> = population().map(model).collect();
    let reports = [Specification::D3d11, Specification::Vulkan]
        .map(|specification| judge(specification, answers.iter().cloned()));
    for report in &reports {
        assert_eq!(rules(report, Verdict::NotExercised), [""; 0], "{report}");
    }
    assert_eq!(rules(&reports[0], Verdict::Broken), [""; 0], "{}", reports[0]);
    let broken = [
        "edge-level",
        "symmetric",
        "every-edge",
        "transition",
        "segments",
        "orientation",
        "isolines",
        "points-once",
    ];
    assert_eq!(rules(&reports[1], Verdict::Broken), broken, "{}", reports[1]);
    for (report, expected) in reports.iter().zip([D3D11_JUDGED, VULKAN_JUDGED]) {
        let found = report.rows.iter().map(|row| (row.rule.name(), row.judged, row.broken));
        assert_eq!(found.collect::<Vec<_>>(), expected, "{report}");
        assert_eq!(report.patches, 12_150, "{report}");
    }
}

/// Of the population's 12 150 patches, how many each rule judges, alone or beside an earlier one, and how many break it.
const D3D11_JUDGED: &[(&str, u64, u64)] = &[
    ("same", 2424, 0),
    ("edge-level", 23_522, 0),
    ("symmetric", 9045, 0),
    ("every-edge", 105_710, 0),
    ("winding", 540, 0),
    ("range", 9720, 0),
    ("discard", 12_150, 0),
    ("cover", 6480, 0),
    ("isolines", 1890, 0),
    ("points-same", 2430, 0),
    ("counts", 9720, 0),
];
const VULKAN_JUDGED: &[(&str, u64, u64)] = &[
    ("same", 2424, 0),
    ("edge-level", 23_810, 142),
    ("symmetric", 9127, 11),
    ("every-edge", 59_942, 261),
    ("winding", 540, 0),
    ("interior", 5071, 0),
    ("transition", 13_864, 274),
    ("range", 9720, 0),
    ("discard", 12_150, 0),
    ("segments", 9127, 1029),
    ("spacing", 8758, 0),
    ("monotone", 24_296, 0),
    ("cover", 6480, 0),
    ("orientation", 6480, 169),
    ("isolines", 1890, 18),
    ("points-once", 783, 58),
    ("points-same", 2430, 0),
];

/// A patch's output after a fault.
type Fault = fn(&mut Tessellation);

/// Judges what a device gives for patches, of which the last has a fault: the rule is the only one to find it,
/// names the patches, and holds without it.
fn found_by_alone(specification: Specification, rule: Rule, lines: &[&str], fault: Fault) {
    let mut answers: Vec<_> = lines.iter().map(|line| model(case(line))).collect();
    let report = judge(specification, answers.iter().cloned());
    assert_eq!(rules(&report, Verdict::Broken), [""; 0], "{}: {report}", rule.name());
    assert_ne!(row(&report, rule).judged, 0, "{} judges it", rule.name());
    let (faulty, output) = answers.last_mut().expect("a patch");
    let right = output.clone();
    fault(output);
    assert_ne!(*output, right, "a fault is planted");
    let faulty = *faulty;
    let report = judge(specification, answers);
    assert_eq!(rules(&report, Verdict::Broken), [rule.name()], "{report}");
    let example = row(&report, rule).smallest.clone().expect("broken");
    assert_eq!(example.cases.last(), Some(&faulty), "{report}");
    let shown = format!("\n  {}\n  {}", example.what, example.cases[0]);
    assert!(report.to_string().contains(&shown), "the example is shown: {report}");
}

/// Moves every point at a place.
fn move_point(output: &mut Tessellation, from: [u32; 2], to: [u32; 2]) {
    let [from, to] = [from, to].map(|[u, v]| DomainPoint::from_bits(u, v));
    output.points.iter_mut().filter(|point| **point == from).for_each(|point| *point = to);
}

/// Moves the points at a quarter and at three quarters of edge u0 or v0 towards the middle.
fn squeeze(output: &mut Tessellation, axis: usize, by: u32) {
    let at = |x| if axis == 0 { [x, 0] } else { [0, x] };
    move_point(output, at(0x4000), at(0x4000 + by));
    move_point(output, at(0xC000), at(0xC000 - by));
}

/// Exchanges the diagonal of the first convex pair of triangles that is wanted by the numbers of its
/// vertices with u = 0 and of those on the outline.
fn flip(output: &mut Tessellation, wanted: [usize; 2]) {
    let triangles = output.indices.as_chunks::<3>().0.to_vec();
    for (i, one) in triangles.iter().enumerate() {
        for (j, two) in triangles.iter().enumerate().skip(i + 1) {
            for turn in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|k| one[(k + turn) % 3]);
                let shared = two.iter().filter(|d| [b, c].contains(d)).count() == 2;
                let Some(&d) = two.iter().find(|d| ![b, c].contains(d)).filter(|_| shared) else {
                    continue;
                };
                let quad = [a, b, d, c].map(|k| output.points[k as usize]);
                let left = quad.iter().filter(|point| point.u.to_bits() == 0).count();
                let outline = quad.iter().filter(|point| is_on_outline(**point)).count();
                if is_convex(quad) && [left, outline] == wanted {
                    output.indices[3 * i..3 * i + 3].copy_from_slice(&[a, b, d]);
                    output.indices[3 * j..3 * j + 3].copy_from_slice(&[a, d, c]);
                    return;
                }
            }
        }
    }
}

fn is_on_outline(point: DomainPoint) -> bool {
    let [u, v] = [point.u.to_bits(), point.v.to_bits()];
    u == 0 || v == 0 || u == ONE || v == ONE
}

fn is_convex(quad: [DomainPoint; 4]) -> bool {
    let bits = |k: usize| {
        let point = quad[k % 4];
        [i64::from(point.u.to_bits()), i64::from(point.v.to_bits())]
    };
    (0..4).all(|k| {
        let [[au, av], [bu, bv], [cu, cv]] = [k, k + 1, k + 2].map(bits);
        (bu - au) * (cv - av) - (cu - au) * (bv - av) > 0
    })
}

const VULKAN: Specification = Specification::Vulkan;
/// Outer levels 4, 5, 3 and inner level 5; outer levels 4, 6, 7 and inner level 6; 4, 4, 3; 5.
const TRI: &str = "case tri integer triangle_cw ruler 40800000 40a00000 40400000 40a00000";
const OTHER_TRI: &str = "case tri integer triangle_cw ruler 40800000 40c00000 40e00000 40c00000";
const EQUAL_TRI: &str = "case tri integer triangle_cw ruler 40800000 40800000 40400000 40a00000";
/// Outer levels 4, 5, 3, 2 or 4, 6, 7, 1 and inner levels 5, 6.
const QUAD: &str =
    "case quad integer triangle_cw ruler 40800000 40a00000 40400000 40000000 40a00000 40c00000";
const OTHER_QUAD: &str =
    "case quad integer triangle_cw ruler 40800000 40c00000 40e00000 3f800000 40a00000 40c00000";
const POINTS: &str = "case tri integer point ruler 40800000 40a00000 40400000 40a00000";
/// 3 lines of 4 segments, and none.
const LINES: &str = "case isoline integer line ruler 40400000 40800000";

/// Invariance rules 1 to 7.
#[test]
fn faults_of_invariance() {
    found_by_alone(VULKAN, Rule::Same, &[TRI, TRI], |output| output.indices.rotate_left(3));
    found_by_alone(VULKAN, Rule::EdgeLevel, &[TRI, OTHER_TRI], |output| squeeze(output, 1, 4));
    found_by_alone(VULKAN, Rule::Symmetric, &[TRI], |output| {
        move_point(output, [0, 0x4000], [0, 0x4004]);
    });
    found_by_alone(VULKAN, Rule::EveryEdge, &[EQUAL_TRI], |output| squeeze(output, 0, 4));
    let ones = "case quad integer triangle_ccw ruler".to_owned() + &" 3f800000".repeat(6);
    let clockwise = ones.replace("ccw", "cw");
    found_by_alone(VULKAN, Rule::Winding, &[&clockwise, &ones], |output| {
        output.indices = vec![0, 2, 1, 0, 3, 2];
    });
    found_by_alone(VULKAN, Rule::Interior, &[QUAD, OTHER_QUAD], |output| flip(output, [0, 0]));
    found_by_alone(VULKAN, Rule::Transition, &[QUAD, OTHER_QUAD], |output| flip(output, [2, 2]));
}

/// Rules about one patch's vertices and edges.
#[test]
fn faults_of_vertices() {
    found_by_alone(VULKAN, Rule::Range, &[POINTS], |output| {
        output.points[15] = DomainPoint::from_bits(0xFFFF, 0xFFFF);
    });
    found_by_alone(VULKAN, Rule::Range, &[TRI], |output| output.indices[5] = 99);
    let none = LINES.replace("40400000", "80000000");
    found_by_alone(VULKAN, Rule::Discard, &[&none], |output| {
        *output = case(&LINES.replace("40400000", "3f800000")).patch().tessellate();
    });
    found_by_alone(VULKAN, Rule::Discard, &[TRI], |output| *output = Tessellation::default());
    found_by_alone(VULKAN, Rule::Segments, &[LINES], |output| {
        *output = case(&LINES.replace("40800000", "40a00000")).patch().tessellate();
    });
    found_by_alone(VULKAN, Rule::Segments, &[LINES], |output| {
        *output = case(&LINES.replace("40400000", "40800000")).patch().tessellate();
    });
    found_by_alone(VULKAN, Rule::Spacing, &[TRI], |output| squeeze(output, 1, 40));
    let [low, high] = ["40600000", "40900000"]
        .map(|level| format!("case isoline fractional_odd line ruler 3f800000 {level}"));
    found_by_alone(VULKAN, Rule::Monotone, &[&low, &high], |output| {
        // As much as 3.0625 has, whose shorter segments are nearly gone.
        let line = "case isoline fractional_odd line ruler 3f800000 40440000";
        *output = case(line).patch().tessellate();
    });
    found_by_alone(VULKAN, Rule::PointsOnce, &[POINTS], |output| output.indices.push(3));
    found_by_alone(VULKAN, Rule::PointsSame, &[TRI, POINTS], |output| {
        output.points[15] = DomainPoint::from_bits(0x5555, 0x5554);
    });
}

/// Rules about one patch's primitives.
#[test]
fn faults_of_primitives() {
    let last = |output: &mut Tessellation| output.indices.truncate(output.indices.len() - 3);
    found_by_alone(VULKAN, Rule::Cover, &[QUAD], last);
    found_by_alone(VULKAN, Rule::Cover, &[QUAD], |output| output.indices.extend([20, 21, 22]));
    found_by_alone(VULKAN, Rule::Orientation, &[QUAD], |output| {
        let inside = output.points.iter().position(|point| !is_on_outline(*point));
        output.points[inside.expect("a point inside")] = DomainPoint::from_bits(0x8000, 0xF000);
    });
    found_by_alone(VULKAN, Rule::Isolines, &[LINES], |output| output.indices.extend([0, 1]));
    found_by_alone(VULKAN, Rule::Isolines, &[LINES], |output| output.indices[1] = 2);
    found_by_alone(Specification::D3d11, Rule::Counts, &[POINTS], |output| {
        _ = output.indices.pop()
    });
}

/// What is known of the model, each by the rule that shows it (specification, sections 11 and 12).
#[test]
fn findings_about_the_model() {
    let broken = |lines: &[&str]| {
        let report = judge(VULKAN, lines.iter().map(|line| model(case(line))));
        rules(&report, Verdict::Broken)
    };
    // The conversion to 16 fraction bits comes before the ceiling: 3.00000024 has 3 segments, not 5.
    let above_3 = "case isoline fractional_odd line ruler 3f800000 40400001";
    assert_eq!(broken(&[above_3]), ["segments"], "just above 3");
    // Ring corner (0, 1): an inner level of 1 + 3/65536 puts vertices of the inside on the outline.
    let [inner, plain] = ["3f800180", "40400000"].map(|inner| {
        format!("case tri fractional_odd triangle_cw ruler 40a00000 40a00000 40a00000 {inner}")
    });
    assert_eq!(broken(&[&plain]), [""; 0], "an inner level of 3");
    let outline = broken(&[&plain, &inner]);
    assert!(outline.contains(&"edge-level"), "{outline:?}");
    // Level 1 + 2/65536: the new points of the edge lie on its corners. From 1 + 3/65536 on they do not.
    let corner = "case quad fractional_odd triangle_cw ruler 3f800100 40a00000 40a00000 40a00000 40a00000 40a00000";
    assert_eq!(broken(&[corner]), ["segments"], "just above 1");
    let beyond = corner.replace("3f800100", "3f800180");
    assert_eq!(broken(&[&beyond]), [""; 0], "far enough above 1");
    // Locations that go backwards.
    let backwards = format!("case quad fractional_even triangle_cw ruler{}", " 41f00238".repeat(6));
    assert!(broken(&[&backwards]).contains(&"orientation"), "30.0010834");
    // Equal spacing: 12.26 units at n = 53 are within the tolerance.
    let equal = "case isoline integer line ruler 3f800000 42540000";
    assert_eq!(broken(&[equal]), [""; 0], "53");
}

/// Just above 1: how far the inside reaches the outline, and an edge's points its corners (specification,
/// section 11).
#[test]
fn where_rounding_ends() {
    let odd = |domain: &str, levels: &str| {
        let line = format!("case {domain} fractional_odd triangle_cw ruler {levels}");
        case(&line).patch().tessellate().points
    };
    let above_1 =
        |k: u32| format!("{:08x}", tess_verify::generate::from_fixed(0x1_0000 + k).to_bits());
    let is_on_tri = |point: &DomainPoint| {
        let [u, v] = [point.u.to_bits(), point.v.to_bits()];
        u == 0 || v == 0 || u + v == ONE
    };
    let fives = |n: usize| " 40a00000".repeat(n);
    for k in 1..=12 {
        let level = above_1(k);
        let tri = odd("tri", &format!("{} {level}", fives(3)));
        assert_eq!(tri[15..].iter().any(is_on_tri), k <= 8, "tri, 1 + {k}/65536");
        let quad = odd("quad", &format!("{} {level} 40a00000", fives(4)));
        let touches = quad[20..].iter().any(|point| is_on_outline(*point));
        assert_eq!(touches, k <= 2, "quad, 1 + {k}/65536");
        let edge = odd("quad", &format!("{level}{}", fives(5)));
        let on_corners = edge[..3].windows(2).any(|pair| pair[0] == pair[1]);
        assert_eq!(on_corners, k <= 2, "outer, 1 + {k}/65536");
    }
    let corner = &odd("tri", &format!("{} 3f800180", fives(3)))[15..];
    assert!(corner.contains(&DomainPoint::from_bits(0, 1)), "{corner:?}");
}

/// The largest distance of a point from k/n under equal spacing: 12.26 units, at n = 53.
#[test]
fn equal_spacing_is_rounded() {
    let hundredths = |n: u16| {
        let detail = f32::from(n).to_bits();
        let line = format!("case isoline integer point ruler 3f800000 {detail:08x}");
        let points = case(&line).patch().tessellate().points;
        let off = |(k, point): (u64, &DomainPoint)| {
            (u64::from(point.u.to_bits()) * u64::from(n)).abs_diff(k * u64::from(ONE))
        };
        (0..).zip(&points).map(off).max().unwrap_or_default() * 100 / u64::from(n)
    };
    let largest = (1..=64).max_by_key(|n| hundredths(*n)).expect("levels");
    assert_eq!((largest, hundredths(largest)), (53, 1226), "n, and hundredths of a unit");
}

/// What dEQP demands of 1 - c holds of every binary32 c from 0 to 1: it is no rule of tessellators. Every exponent,
/// with both ends, the middle and random ones between.
#[test]
#[expect(clippy::float_cmp, reason = "exactly 1")]
fn one_minus_a_coordinate_cannot_fail() {
    let mut random = tess_verify::random::SplitMix64::new(1);
    for exponent in 0..127u32 {
        let some = (0..1000).map(|_| random.next_u32() & 0x7F_FFFF);
        for mantissa in
            [0, 1, 0x3F_FFFF, 0x40_0000, 0x40_0001, 0x7F_FFFE, 0x7F_FFFF].into_iter().chain(some)
        {
            let c = f32::from_bits(exponent << 23 | mantissa);
            assert_eq!(c + (1.0 - c), 1.0, "{c}");
        }
    }
    // Beyond 1 it can: the range is what the rule stands on.
    let beyond = f32::from_bits(0x4B80_0001);
    assert_ne!(beyond + (1.0 - beyond), 1.0, "{beyond}");
}

/// What is said of one output that breaks a rule.
fn said(line: &str, rule: Rule, fault: Fault) -> Option<String> {
    let (case, mut output) = model(case(line));
    fault(&mut output);
    let report = judge(VULKAN, [(case, output)]);
    row(&report, rule).smallest.as_ref().map(|example| example.what.clone())
}

/// Each coordinate alone, and the sum on triangles; the domain's corners belong to it.
#[test]
fn where_the_domain_ends() {
    let outside = |place: &str| Some(format!("vertex ({place}) lies outside the domain"));
    let moved: [(&str, Fault, Option<String>); 5] = [
        (
            QUAD,
            |output| output.points[0] = DomainPoint::from_bits(ONE + 1, 0),
            outside("10001, 00000"),
        ),
        (
            QUAD,
            |output| output.points[0] = DomainPoint::from_bits(0, ONE + 1),
            outside("00000, 10001"),
        ),
        (QUAD, |output| output.points[0] = DomainPoint::from_bits(ONE, ONE), None),
        (
            TRI,
            |output| output.points[0] = DomainPoint::from_bits(0x8001, 0x8000),
            outside("08001, 08000"),
        ),
        (TRI, |output| output.points[0] = DomainPoint::from_bits(0x8000, 0x8000), None),
    ];
    for (line, fault, expected) in moved {
        assert_eq!(said(line, Rule::Range, fault), expected, "{line}");
    }
}

/// A denormal level may discard or not; with a level that discards beside it, it may not.
#[test]
fn denormals_beside_levels_that_discard() {
    let judged = |first: &str| {
        let line = LINES.replace("40400000", first).replace("40800000", "00000001");
        let whole = case(LINES).patch().tessellate();
        let reports =
            [Tessellation::default(), whole].map(|output| judge(VULKAN, [(case(&line), output)]));
        reports.map(|report| row(&report, Rule::Discard).verdict())
    };
    assert_eq!(judged("40400000"), [Verdict::NotExercised; 2], "either");
    assert_eq!(judged("80000000"), [Verdict::Held, Verdict::Broken], "no primitive");
}

/// The words for what a level counts.
#[test]
fn lines_and_segments_are_called_so() {
    let four_lines: Fault =
        |output| *output = case(&LINES.replace("40400000", "40800000")).patch().tessellate();
    let said_of = |line, fault| said(line, Rule::Segments, fault);
    let isolines = "the patch has 4 isolines, its level 3 asks for 3";
    assert_eq!(said_of(LINES, four_lines).as_deref(), Some(isolines));
    let five_segments: Fault =
        |output| *output = case(&LINES.replace("40800000", "40a00000")).patch().tessellate();
    let segments = "line 0 has 5 segments, its level 4 asks for 4";
    assert_eq!(said_of(LINES, five_segments).as_deref(), Some(segments));
    let edge = said_of(QUAD, |output| {
        *output = case(&QUAD.replace("40800000", "40c00000")).patch().tessellate();
    });
    assert_eq!(edge.as_deref(), Some("edge u0 has 6 segments, its level 4 asks for 4"));
}

/// Moves the points of a line, which begin with `first`, to another v.
fn move_line(output: &mut Tessellation, first: usize, v: u32) {
    for point in &mut output.points[first..] {
        *point = DomainPoint::from_bits(point.u.to_bits(), v);
    }
}

/// What is said of a mesh, its lines and its points.
#[test]
fn faults_of_primitives_in_words() {
    let said = |line, rule, fault| said(line, rule, fault).unwrap_or_default();
    let ones = "case quad integer triangle_cw ruler".to_owned() + &" 3f800000".repeat(6);
    let turned = said(&ones, Rule::Orientation, |output| output.indices[3..6].reverse());
    assert_eq!(
        turned,
        "triangle 1 turns the other way: (00000, 10000) (10000, 10000) (10000, 00000)"
    );
    let hole = said(&ones, Rule::Cover, |output| output.indices.truncate(3));
    assert_eq!(
        hole,
        "the edge (00000, 10000) (10000, 00000) within the domain is not shared by two"
    );
    let twice = said(&ones, Rule::Cover, |output| output.indices.extend_from_within(..));
    assert_eq!(twice, "outer edge u0 is not walked once");
    let line = "case isoline integer line ruler 40000000 40000000";
    let across = said(line, Rule::Isolines, |output| output.indices[1] = 4);
    assert_eq!(across, "the segment (00000, 00000) (08000, 08000) changes v");
    let gap = said(line, Rule::Isolines, |output| output.indices.truncate(6));
    assert_eq!(gap, "the line at v = 08000 is not walked once from 0 to 1");
    let moved = said(line, Rule::Isolines, |output| move_line(output, 3, 0x8011));
    assert_eq!(moved, "line 1 of 2 lies at v = 08011");
    let near = said(line, Rule::Isolines, |output| move_line(output, 3, 0x8010));
    assert_eq!(near, "", "16 units are rounding");
    let point = ones.replace("triangle_cw", "point");
    let repeated = said(&point, Rule::PointsOnce, |output| output.indices.push(2));
    assert_eq!(repeated, "(10000, 10000) is a point twice");
}

/// What is said of an edge whose vertices are not where its level puts them: equal lengths, and two shorter ones.
#[test]
fn faults_of_edges_in_words() {
    let said = |line: &str, rule, fault| said(line, rule, fault).unwrap_or_default();
    let equal = "case isoline integer line ruler 3f800000 40800000";
    let at = |output: &mut Tessellation, k: usize, u: u32| {
        output.points[k] = DomainPoint::from_bits(u, output.points[k].v.to_bits());
    };
    let moved = said(equal, Rule::Spacing, |output| {
        output.points[1] = DomainPoint::from_bits(0x4011, 0);
    });
    assert_eq!(moved, "line 0: vertex 1 of 4 lies at 04011, more than 16 units from 1/4");
    let near = said(equal, Rule::Spacing, |output| {
        output.points[1] = DomainPoint::from_bits(0x3FF0, 0);
    });
    assert_eq!(near, "", "16 units are rounding");
    // Five segments; two shorter ones must lie symmetrically. 32 units are rounding.
    let fractional = "case isoline fractional_odd line ruler 3f800000 40800000";
    let unpaired =
        |a, b| format!("line 0: segments {a} and {b} are shorter, and are no mirrored pair");
    let number = |n| format!("line 0: {n} of 5 segments are shorter, not two");
    for (moved, expected) in [
        ([0x2000, 0x6000, 0xA000, 0xE000], String::new()),
        ([0x4000, 0x6000, 0xA000, 0xBFE0], String::new()),
        ([0x3FF5, 0x6016, 0xA00B, 0xC00B], unpaired(1, 3)),
        ([0x4000, 0x6000, 0xA000, 0xE000], unpaired(1, 4)),
        ([0x4000, 0x8000, 0xC000, 0xE000], unpaired(3, 4)),
        ([0x3800, 0x7000, 0x9000, 0xC800], number(1)),
        ([0x2000, 0x7000, 0x9000, 0xE000], number(3)),
        ([0x1000, 0x2000, 0x3000, 0x4000], number(4)),
    ] {
        let mut output = case(fractional).patch().tessellate();
        moved.into_iter().enumerate().for_each(|(k, u)| at(&mut output, k + 1, u));
        let report = judge(VULKAN, [(case(fractional), output)]);
        let what = row(&report, Rule::Spacing).smallest.as_ref().map(|example| &*example.what);
        assert_eq!(what.unwrap_or_default(), expected, "{moved:04x?}");
    }
}

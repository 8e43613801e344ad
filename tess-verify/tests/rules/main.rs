//! Tests of the rules of the standards: those that the model holds and breaks, and the fault that
//! only one rule finds, for each rule.

mod faults;
mod mistakes;
#[path = "../common/numbers.rs"]
mod numbers;
mod words;

use tess_core::fixed_point::ONE;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::generate::{GenLevel, Selection};
use tess_verify::rules::{Checker, Rule, RuleRow, RulesReport, Specification, Verdict};
use tess_verify::{Case, Named};

const VULKAN: Specification = Specification::Vulkan;
/// Outer levels 4, 5, 3 and inner level 5; outer levels 4, 6, 7 and inner level 6; outer levels
/// 4, 4, 3 and inner level 5.
const TRI: &str = "case tri integer triangle_cw ruler 40800000 40a00000 40400000 40a00000";
const OTHER_TRI: &str = "case tri integer triangle_cw ruler 40800000 40c00000 40e00000 40c00000";
const EQUAL_TRI: &str = "case tri integer triangle_cw ruler 40800000 40800000 40400000 40a00000";
/// Outer levels 4, 5, 3, 2 or 4, 6, 7, 1 and inner levels 5, 6.
const QUAD: &str =
    "case quad integer triangle_cw ruler 40800000 40a00000 40400000 40000000 40a00000 40c00000";
const OTHER_QUAD: &str =
    "case quad integer triangle_cw ruler 40800000 40c00000 40e00000 3f800000 40a00000 40c00000";
const POINTS: &str = "case tri integer point ruler 40800000 40a00000 40400000 40a00000";
/// 3 lines of 4 segments.
const LINES: &str = "case isoline integer line ruler 40400000 40800000";

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

fn row(report: &RulesReport, rule: Rule) -> &RuleRow {
    report.rows.iter().find(|row| row.rule == rule).expect("a rule of the standard")
}

/// The patches of `tess gen --rules --split ruler`, of which docs/rules.md has the counts.
fn population() -> impl Iterator<Item = Case> {
    let split = Some(tess_core::SplitOrder::Ruler);
    Selection { split, ..Selection::level(GenLevel::Rules, 1) }.cases()
}

/// A patch's output after a fault.
type Fault = fn(&mut Tessellation);

/// Moves every point that is at `from` to `to`.
fn move_point(output: &mut Tessellation, from: [u32; 2], to: [u32; 2]) {
    let [from, to] = [from, to].map(|[u, v]| DomainPoint::from_bits(u, v));
    output.points.iter_mut().filter(|point| **point == from).for_each(|point| *point = to);
}

fn is_on_outline(point: DomainPoint) -> bool {
    let [u, v] = [point.u.to_bits(), point.v.to_bits()];
    u == 0 || v == 0 || u == ONE || v == ONE
}

/// The population exercises every rule about every level. The model holds all of Direct3D's, and of
/// Vulkan's all but those that docs/rules.md names.
#[test]
#[ignore = "slow: every question under both standards"]
fn the_model_and_the_standards() {
    let answers: Vec<_> = population().map(model).collect();
    let reports = [Specification::D3d11, Specification::Vulkan]
        .map(|specification| judge(specification, answers.iter().cloned()));
    for report in &reports {
        assert_eq!(rules(report, Verdict::NotExercised), [""; 0], "{report}");
    }
    assert_eq!(rules(&reports[0], Verdict::Broken), [""; 0], "{}", reports[0]);
    let partly = [
        rules(&reports[0], Verdict::HeldAsFarAsAsked),
        rules(&reports[1], Verdict::HeldAsFarAsAsked),
    ];
    let none: Vec<&str> = Vec::new();
    assert_eq!(partly, [none.clone(), none], "{}{}", reports[0], reports[1]);
    let broken = [
        "edge-level",
        "symmetric",
        "every-edge",
        "transition",
        "segments",
        "inner-levels",
        "neighbours",
        "orientation",
        "isolines",
        "points-once",
    ];
    assert_eq!(rules(&reports[1], Verdict::Broken), broken, "{}", reports[1]);
    let found = [0, 1].map(|one| reports[one].rows.iter().map(cells).collect::<Vec<_>>());
    assert_eq!(found, [2, 3].map(documented), "{}{}", reports[0], reports[1]);
    assert_eq!(reports.map(|report| report.patches), [28_455; 2], "patches");
}

/// A rule's name, and how many judged patches break it.
fn cells(row: &RuleRow) -> [String; 2] {
    [row.rule.name().to_owned(), format!("{} of {}", row.broken, row.judged)]
}

/// The rules in a column of the table in docs/rules.md, in its order, each with the text of its
/// cell.
fn documented(column: usize) -> Vec<[String; 2]> {
    let page = include_str!("../../../docs/rules.md");
    let (_, table) = page.split_once("\n## Who holds what\n").expect("the section of the table");
    let rows = table.lines().skip_while(|line| !line.starts_with("| --- ")).skip(1);
    let rows = rows.take_while(|line| line.starts_with('|'));
    let cells = rows.map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    let own = cells.filter(|cells| cells[column] != "-");
    // Numbers of five digits contain a space, and the cells of broken rules are bold.
    own.map(|cells| {
        let words = cells[column].replace("**", "");
        let (broken, judged) = words.split_once(" of ").expect("two numbers");
        [cells[1].replace('`', ""), format!("{broken} of {}", judged.replace(' ', ""))]
    })
    .collect()
}

/// Direct3D's rules refer to sections of the specification by number and title. OpenGL's list of
/// invariance rules has Vulkan's numbers.
#[test]
fn sources_are_where_rules_stand() {
    let specification = include_str!("../../../docs/specification.md");
    for RuleRow { rule, .. } in Checker::new(Specification::D3d11).report().rows {
        let source = Specification::D3d11.source(rule).expect("a rule of Direct3D");
        let (number, title) = source.split_once(' ').expect("a number and a title");
        let last = number.split('.').next_back().expect("a number");
        let title = title.split(&[':', ','][..]).next().expect("a title");
        let heads = [format!("\n## {last}. {title}"), format!("\n{last}. *{title}*")];
        assert!(
            heads.iter().any(|head| specification.contains(head)),
            "{}: {heads:?}",
            rule.name()
        );
    }
    for RuleRow { rule, .. } in Checker::new(Specification::OpenGl).report().rows {
        let [gl, vulkan] = [Specification::OpenGl, VULKAN]
            .map(|standard| standard.source(rule).expect("a rule of both"));
        let is_invariance = vulkan.starts_with("Tessellation Invariance, rule ");
        let generation = "11.2.2 Tessellation Primitive Generation";
        assert_eq!(gl, if is_invariance { vulkan } else { generation }, "{}", rule.name());
    }
}

/// Rules judge primitives in any order, a triangle from any of its vertices, and no point that no
/// primitive has.
#[test]
fn order_and_unused_points_are_free() {
    for specification in [Specification::D3d11, VULKAN, Specification::OpenGl] {
        for line in [TRI, QUAD, LINES] {
            let (case, right) = model(case(line));
            let mut other = right.clone();
            let size = if line == LINES { 2 } else { 3 };
            let primitives = right.indices.chunks(size).rev().enumerate();
            other.indices = primitives
                .flat_map(|(number, vertices)| {
                    let mut turned = vertices.to_vec();
                    turned.rotate_left(if size == 3 { number % 3 } else { 0 });
                    turned
                })
                .collect();
            // On no triangle, and on no line, which ends below v = 1.
            other.points.push(DomainPoint::from_bits(ONE, ONE));
            let [of_model, of_other] = [right, other].map(|output| {
                let report = judge(specification, [(case, output)]);
                rules(&report, Verdict::Broken)
            });
            assert_eq!(of_other, of_model, "{}, {line}", specification.name());
        }
    }
}

/// A triangle two of whose vertices coincide covers nothing, and walks an edge both ways.
#[test]
fn a_triangle_without_area_covers_nothing() {
    for specification in [Specification::D3d11, VULKAN] {
        let (case, mut output) = model(case(TRI));
        // The last triangle is the innermost.
        let [a, b, _] = *output.indices.as_chunks::<3>().0.last().expect("triangles");
        output.indices.extend([a, a, b]);
        let report = judge(specification, [(case, output)]);
        let RuleRow { judged, broken, .. } = row(&report, Rule::Cover);
        assert_eq!((*judged, *broken), (1, 0), "{}: {report}", specification.name());
    }
}

/// Known faults of the model, each with the rule that shows it (specification, sections 11 and 12).
#[test]
fn findings_about_the_model() {
    let broken = |lines: &[&str]| {
        let report = judge(VULKAN, lines.iter().map(|line| model(case(line))));
        rules(&report, Verdict::Broken)
    };
    // The conversion to 16 fraction bits comes before the ceiling, so 3.00000024 has 3 segments,
    // not 5.
    let above_3 = "case isoline fractional_odd line ruler 3f800000 40400001";
    assert_eq!(broken(&[above_3]), ["segments"], "just above 3");
    // Ring corner (0, 1): an inner level of 1 + 3/65536 puts vertices of the inside on the outline.
    let [inner, plain] = ["3f800180", "40400000"].map(|inner| {
        format!("case tri fractional_odd triangle_cw ruler 40a00000 40a00000 40a00000 {inner}")
    });
    assert_eq!(broken(&[&plain]), [""; 0], "an inner level of 3");
    let outline = broken(&[&plain, &inner]);
    assert!(outline.contains(&"edge-level"), "{outline:?}");
    // Level 1 + 2/65536: the new points of the edge are on its corners. At 1 + 3/65536 and above
    // they are not.
    let corner = "case quad fractional_odd triangle_cw ruler 3f800100 40a00000 40a00000 40a00000 40a00000 40a00000";
    assert_eq!(broken(&[corner]), ["segments"], "just above 1");
    let beyond = corner.replace("3f800100", "3f800180");
    assert_eq!(broken(&[&beyond]), [""; 0], "far enough above 1");
    // Locations that run backwards.
    let backwards = format!("case quad fractional_even triangle_cw ruler{}", " 41f00238".repeat(6));
    assert!(broken(&[&backwards]).contains(&"orientation"), "30.0010834");
    // Equal spacing: 12.26 units at n = 53 are within the tolerance.
    let equal = "case isoline integer line ruler 3f800000 42540000";
    assert_eq!(broken(&[equal]), [""; 0], "53");
}

/// Levels just above 1: the highest ones at which the inside touches the outline, and an edge's
/// points coincide with its corners (specification, section 11).
#[test]
fn where_rounding_ends() {
    let odd = |domain: &str, levels: &str| {
        let line = format!("case {domain} fractional_odd triangle_cw ruler {levels}");
        case(&line).patch().tessellate().points
    };
    let above_1 =
        |k: u32| format!("{:08x}", DomainPoint::from_bits(0x1_0000 + k, 0).to_f32()[0].to_bits());
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

/// dEQP's condition on 1 - c holds for every binary32 c from 0 to 1, so it is not a rule about
/// tessellators. Tests every exponent, with both ends of its range, the middle and random values
/// between them.
#[test]
#[expect(clippy::float_cmp, reason = "exactly 1")]
fn one_minus_a_coordinate_cannot_fail() {
    let mut random = tess_verify::generate::SplitMix64::new(1);
    for exponent in 0..127u32 {
        let some = (0..1000).map(|_| random.next_u32() & 0x7F_FFFF);
        for mantissa in
            [0, 1, 0x3F_FFFF, 0x40_0000, 0x40_0001, 0x7F_FFFE, 0x7F_FFFF].into_iter().chain(some)
        {
            let c = f32::from_bits(exponent << 23 | mantissa);
            assert_eq!(c + (1.0 - c), 1.0, "{c}");
        }
    }
    // Above 1 it can fail: the condition depends on the range of the coordinates.
    let beyond = f32::from_bits(0x4B80_0001);
    assert_ne!(beyond + (1.0 - beyond), 1.0, "{beyond}");
}

//! Tests of the limits of each rule, and of the text for a case beyond them.

use super::*;

/// All levels 4.
const FOURS: &str =
    "case quad integer triangle_cw ruler 40800000 40800000 40800000 40800000 40800000 40800000";

/// The text for an output that breaks a rule.
fn said(line: &str, rule: Rule, fault: impl FnOnce(&mut Tessellation)) -> Option<String> {
    let (case, mut output) = model(case(line));
    fault(&mut output);
    let report = judge(VULKAN, [(case, output)]);
    row(&report, rule).smallest.as_ref().map(|example| example.what.clone())
}

/// Moves the points of a line, the first of which is number `first`, to another v.
fn move_line(output: &mut Tessellation, first: usize, v: u32) {
    for point in &mut output.points[first..] {
        *point = DomainPoint::from_bits(point.u.to_bits(), v);
    }
}

/// Each coordinate by itself, and the sum on triangles; the corners belong to the domain.
#[test]
fn where_the_domain_ends() {
    let outside = |place: &str| Some(format!("vertex ({place}) is outside the domain"));
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

/// A patch with a denormal level may be discarded or not; with another level that discards it, it
/// must be.
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

/// The text for what a level counts.
#[test]
fn lines_and_segments_are_called_so() {
    let four_lines: Fault =
        |output| *output = case(&LINES.replace("40400000", "40800000")).patch().tessellate();
    let said_of = |line, fault: Fault| said(line, Rule::Segments, fault);
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

/// The texts on a mesh, its lines and its points.
#[test]
fn faults_of_primitives_in_words() {
    let said = |line: &str, rule, fault: Fault| said(line, rule, fault).unwrap_or_default();
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
    assert_eq!(moved, "line 1 of 2 is at v = 08011");
    let near = said(line, Rule::Isolines, |output| move_line(output, 3, 0x8010));
    assert_eq!(near, "", "16 units are rounding");
    let point = ones.replace("triangle_cw", "point");
    let repeated = said(&point, Rule::PointsOnce, |output| output.indices.push(2));
    assert_eq!(repeated, "(10000, 10000) is a point twice");
}

/// The texts on an edge whose vertices are not where its level puts them: equal lengths, and two
/// shorter segments.
#[test]
fn faults_of_edges_in_words() {
    // All points after the first are moved to these places.
    let said_of = |line: &str, places: &[u32]| {
        let moved = said(line, Rule::Spacing, |output| {
            for (point, &u) in output.points[1..].iter_mut().zip(places) {
                *point = DomainPoint::from_bits(u, 0);
            }
        });
        moved.unwrap_or_default()
    };
    let equal = "case isoline integer line ruler 3f800000 40800000";
    let moved = said_of(equal, &[0x4011]);
    assert_eq!(moved, "line 0: vertex 1 of 4 is at 04011, more than 16 units from 1/4");
    assert_eq!(said_of(equal, &[0x3FF0]), "", "16 units are rounding");
    // Five segments; the two shorter ones must be symmetric. 32 units count as rounding.
    let fractional = "case isoline fractional_odd line ruler 3f800000 40800000";
    let unpaired =
        |a, b| format!("line 0: segments {a} and {b} are shorter, and are not a mirrored pair");
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
        assert_eq!(said_of(fractional, &moved), expected, "{moved:04x?}");
    }
}

/// Each end by itself, and a vertex without its mirror image, on every edge of a quad; on isolines,
/// on the edge where the lines begin.
#[test]
fn edges_are_symmetric_about_their_middles() {
    let ends = [[0, ONE], [0, 0], [ONE, 0], [ONE, ONE]];
    for (edge, name) in ["u0", "v0", "u1", "v1"].into_iter().enumerate() {
        let [from, to] = [ends[edge], ends[(edge + 1) % 4]];
        let along = |x: u32| {
            let at = |axis: usize| if to[axis] > from[axis] { x } else { ONE - x };
            [0, 1].map(|axis| if from[axis] == to[axis] { from[axis] } else { at(axis) })
        };
        let what = |from: u32, to: u32| {
            said(FOURS, Rule::Symmetric, |output| move_point(output, along(from), along(to)))
        };
        let lonely = format!("edge {name} has a vertex at 04004 and none at 0bffc");
        assert_eq!(what(0x4000, 0x4004), Some(lonely), "edge {name}");
        assert_eq!(what(0x8000, 0x8000), None, "the model's edge {name}");
    }
    let first = |output: &mut Tessellation| output.points[0] = DomainPoint::from_bits(1, ONE);
    let lacks = said(QUAD, Rule::Symmetric, first);
    assert_eq!(lacks.as_deref(), Some("edge u0 lacks an end"));
    let spread = "case isoline integer line ruler 40800000 40400000";
    let moved = said(spread, Rule::Symmetric, |output| move_line(output, 12, 0xC004));
    let other = "edge density has a vertex at 03ffc and none at 0c004";
    assert_eq!(moved.as_deref(), Some(other), "the last of four lines");
}

/// An edge may have the vertices of another edge of the same level in either direction.
#[test]
fn edges_may_be_mirrored() {
    let verdict = |edges: &[[u32; 2]]| {
        let (case, mut output) = model(case(FOURS));
        for &[axis, across] in edges {
            let at = |x: u32| if axis == 0 { [x, across] } else { [across, x] };
            move_point(&mut output, at(0x4000), at(0x4004));
        }
        row(&judge(VULKAN, [(case, output)]), Rule::EveryEdge).verdict()
    };
    // A clockwise walk goes along two edges in the direction of growing coordinates, and along two
    // in the opposite direction.
    assert_eq!(verdict(&[[0, 0], [0, ONE], [1, 0], [1, ONE]]), Verdict::Held, "mirrored");
    assert_eq!(verdict(&[[0, 0], [0, ONE], [1, 0]]), Verdict::Broken, "one is another");
}

/// From one level to the next, the shorter segments may shrink by at most 2 units.
#[test]
fn shorter_segments_may_shrink_by_rounding() {
    let line =
        |level: &str| case(&format!("case isoline fractional_odd line ruler 3f800000 {level}"));
    let low = line("40800000");
    let judged_at = |high: &str, shorter: u32| {
        let high = line(high);
        let mut output = high.patch().tessellate();
        let long = (ONE - 2 * shorter) / 3;
        for (k, u) in
            [long, long + shorter, ONE - long - shorter, ONE - long].into_iter().enumerate()
        {
            output.points[k + 1] = DomainPoint::from_bits(u, 0);
        }
        let report = judge(VULKAN, [model(low), (high, output)]);
        let row = row(&report, Rule::Monotone).clone();
        (row.judged, row.smallest.map(|example| example.what))
    };
    let places = low.patch().tessellate().points;
    let length = places[2].u.to_bits() - places[1].u.to_bits();
    let judged = |shorter| judged_at("40820000", shorter);
    assert_eq!(judged(length - 2), (1, None), "rounding");
    let what = format!("the shorter segments shrink from {length:05x} to {:05x}", length - 3);
    assert_eq!(judged(length - 3), (1, Some(what)));
    // From a level to one that is 1/8 above it, they must grow.
    let stays = format!("the shorter segments stay {length:05x} from a level to a higher one");
    assert_eq!(judged_at("40840000", length), (1, Some(stays)));
    assert_eq!(judged_at("40840000", length + 1), (1, None), "longer");
    assert_eq!(judged_at("40838000", length), (1, None), "nearer levels");
}

/// Of examples of equal size the first is kept; a smaller one replaces it.
#[test]
fn the_smallest_example_is_kept() {
    let broken = |line: &str| {
        let (case, mut output) = model(case(line));
        output.points[0] = DomainPoint::from_bits(ONE + 1, 0);
        (case, output)
    };
    let other = QUAD.replace("40a00000 40c00000", "40c00000 40a00000");
    let kept = |lines: &[&str]| {
        let report = judge(VULKAN, lines.iter().map(|line| broken(line)));
        row(&report, Rule::Range).smallest.as_ref().map(|example| example.cases.clone())
    };
    let size = |line: &str| case(line).patch().counts().indices;
    assert_eq!(size(QUAD), size(&other), "as many vertices");
    assert_eq!(kept(&[QUAD, &other]), Some(vec![case(QUAD)]), "the first");
    assert!(size(LINES) < size(QUAD), "fewer vertices");
    assert_eq!(kept(&[QUAD, LINES, &other]), Some(vec![case(LINES)]), "the smallest");
}

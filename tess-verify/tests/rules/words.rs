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
    let held = Verdict::HeldAsFarAsAsked;
    assert_eq!(judged("80000000"), [held, Verdict::Broken], "no primitive");
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
    assert_eq!(
        verdict(&[[0, 0], [0, ONE], [1, 0], [1, ONE]]),
        Verdict::HeldAsFarAsAsked,
        "mirrored"
    );
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

/// A device may put vertices of the inside on the outline where an inner level of at most 1 counts
/// as just above 1 (22.6, 22.7). That excuses nothing else.
#[test]
fn inner_levels_of_one_excuse_no_more_than_their_sentence() {
    // Three equal segments, an outline of 7 segments for level 4.5, an inside of a larger level,
    // and columns far from the outline.
    let odd = |domain: &str, levels: &[f32]| {
        let bits = levels.iter().map(|level| format!(" {:08x}", level.to_bits()));
        case(&format!("case {domain} fractional_odd triangle_cw ruler{}", bits.collect::<String>()))
    };
    for (asked, answered, rule) in [
        (odd("tri", &[3.0, 3.0, 3.0, 1.0]), odd("tri", &[3.0, 3.0, 3.0, 3.0]), "inner-spacing"),
        (odd("tri", &[3.0, 4.5, 3.0, 1.0]), odd("tri", &[3.0, 7.0, 3.0, 1.0]), "segments"),
        (odd("tri", &[3.0, 4.5, 3.0, 0.5]), odd("tri", &[3.0, 3.0, 3.0, 0.5]), "segments"),
        (
            odd("quad", &[4.5, 3.0, 3.0, 3.0, 1.0, 7.0]),
            odd("quad", &[7.0, 3.0, 3.0, 3.0, 1.0, 7.0]),
            "segments",
        ),
        (
            odd("quad", &[4.5, 3.0, 3.0, 3.0, 1.0, 1.0]),
            odd("quad", &[7.0, 3.0, 3.0, 3.0, 1.0, 1.0]),
            "segments",
        ),
        (
            odd("quad", &[3.0, 3.0, 3.0, 3.0, 1.0, 5.0]),
            odd("quad", &[3.0, 3.0, 3.0, 3.0, 3.0, 5.0]),
            "inner-spacing",
        ),
        (
            odd("quad", &[3.0, 3.0, 3.0, 3.0, 1.0, 5.0]),
            odd("quad", &[3.0, 3.0, 3.0, 3.0, 1.0, 7.0]),
            "inner-levels",
        ),
        (
            odd("quad", &[3.0, 3.0, 3.0, 3.0, 5.0, 1.0]),
            odd("quad", &[3.0, 3.0, 3.0, 3.0, 3.0, 1.0]),
            "inner-levels",
        ),
    ] {
        let model = judge(VULKAN, [model(asked)]);
        assert_eq!(rules(&model, Verdict::Broken), [""; 0], "{asked}: {model}");
        let wrong = judge(VULKAN, [(asked, answered.patch().tessellate())]);
        assert!(rules(&wrong, Verdict::Broken).contains(&rule), "{asked}: {rule}: {wrong}");
    }
    // A vertex of the outline far from its place, and 40/65536 from it.
    let asked = odd("quad", &[5.0, 3.0, 3.0, 3.0, 1.0, 1.0]);
    for to in [0x3000, 0x3333 + 40] {
        let (asked, mut output) = model(asked);
        move_point(&mut output, [0, 0x3333], [0, to]);
        let report = judge(VULKAN, [(asked, output)]);
        assert_eq!(rules(&report, Verdict::Broken), ["symmetric", "spacing"], "{to:05x}: {report}");
    }
}

/// An inner level that is NaN says nothing about one axis of a quad; the other is judged.
#[test]
fn nan_inside_excuses_one_axis() {
    let line = QUAD.replace("40a00000 40c00000", "7fc00000 40c00000");
    let five: Fault = |output| {
        *output =
            case(&QUAD.replace("40a00000 40c00000", "7fc00000 40a00000")).patch().tessellate();
    };
    let rows = "inner level 2 is 6 and asks for 6 rows; there are 5";
    assert_eq!(said(&line, Rule::InnerLevels, five).as_deref(), Some(rows));
    let three: Fault = |output| {
        *output =
            case(&QUAD.replace("40a00000 40c00000", "40400000 40c00000")).patch().tessellate();
    };
    assert_eq!(said(&line, Rule::InnerLevels, three), None, "no sentence says how many columns");
}

/// Rings of a triangle cannot be told apart just above a number of segments. Elsewhere, two rings
/// at one place are a fault.
#[test]
fn rings_may_be_close_only_just_above_a_number() {
    let tri = |level: f32| {
        let bits = level.to_bits();
        format!("case tri fractional_even triangle_cw ruler 40400000 40400000 40400000 {bits:08x}")
    };
    // The second ring of 6 segments, at the places of the first one.
    let close = |output: &mut Tessellation, by: u32| {
        let depth = |point: DomainPoint| {
            let [u, v] = [point.u.to_bits(), point.v.to_bits()];
            u.min(v).min(ONE - u - v)
        };
        let depths = output.points.iter().map(|point| depth(*point));
        let depths: std::collections::BTreeSet<u32> = depths.filter(|d| *d > 16).collect();
        let depths: Vec<u32> = depths.into_iter().collect();
        let first = depths[0];
        let second = *depths.iter().find(|d| **d > first + 32).expect("a second ring");
        for point in &mut output.points {
            let [u, v] = [point.u.to_bits(), point.v.to_bits()];
            if depth(*point).abs_diff(second) < 16 {
                let shift = second - first - by;
                let moved = |x: u32| if x.abs_diff(second) < 16 { x - shift } else { x };
                *point = DomainPoint::from_bits(moved(u), moved(v));
            }
        }
    };
    let whole = said(&tri(8.0), Rule::InnerSpacing, |output| close(output, 20));
    assert_eq!(whole.as_deref(), Some("rings 1 and 2 are equally far inside"), "8 segments");
    assert_eq!(said(&tri(8.0), Rule::InnerSpacing, |_| {}), None, "the model's 8 segments");
    let just_above = f32::from_bits(6f32.to_bits() + 0x40);
    let report = judge(VULKAN, [model(case(&tri(just_above)))]);
    assert_eq!(row(&report, Rule::InnerSpacing).judged, 0, "two rings coincide");
}

/// A level with two legal conversions may have either of two outputs in Direct3D, and no third.
#[test]
fn either_conversion_is_right_and_no_other() {
    const D3D11: Specification = Specification::D3d11;
    let with = |bits: u32| {
        let line = "case quad fractional_odd triangle_cw ruler LEVEL 40200000 40a00000 40500000 \
                    40900000 40d00000";
        case(&line.replace("LEVEL", &format!("{bits:08x}")))
    };
    // Halfway between two numbers of units, these numbers, and a number further on.
    let asked = with(0x4000_8120);
    let broken = |bits: u32| {
        let report = judge(D3D11, [(asked, with(bits).patch().tessellate())]);
        rules(&report, Verdict::Broken)
    };
    assert_eq!(broken(0x4000_8100), [""; 0], "down");
    assert_eq!(broken(0x4000_8140), [""; 0], "up");
    assert!(broken(0x4000_9000).contains(&"places"), "another number");
}

/// What was not asked is named: whole domains, their spacings and roles, single numbers.
#[test]
fn a_verdict_names_what_was_not_asked() {
    let report = judge(VULKAN, [model(case(TRI)), model(case(LINES))]);
    let text = report.to_string();
    let segments = row(&report, Rule::Segments);
    assert_eq!(segments.verdict(), Verdict::HeldAsFarAsAsked, "{text}");
    let missing = segments.asked.missing();
    assert_eq!(missing[..2], ["quad", "isoline fractional_odd"], "{missing:?}");
    let edge = "tri integer u0: 1 to 3, 5 to 64 segments, denormals";
    assert!(missing.iter().all(|text| !text.starts_with(edge)), "denormals need not be asked");
    let edge = "tri integer u0: 1 to 3, 5 to 64 segments, numbers below 1 and 59 classes more";
    assert!(missing.iter().any(|text| text == edge), "{missing:?}");
    assert!(text.contains("\n  not asked: quad; isoline fractional_odd; "), "{text}");
    assert!(text.ends_with(" not exercised\n") && text.contains(": 0 rules held, "), "{text}");
    let [asked, wanted] = segments.asked.levels();
    assert!(0 < asked && asked < wanted, "{asked} of {wanted}");
    // Edges of 4, 5 and 3 segments, and 5 inside.
    let pairs = "tri: 4029 pairs of an edge and the inside, such as 1 and 2 segments";
    let missing = row(&report, Rule::Cover).asked.missing();
    assert_eq!(missing.last().map(String::as_str), Some(pairs), "{missing:?}");
    assert!(segments.asked.missing().iter().all(|text| !text.contains("pairs")), "not about pairs");
}

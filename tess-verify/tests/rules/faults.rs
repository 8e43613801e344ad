//! Tests of the fault that only one rule finds, for each rule.

use super::*;

/// Judges a device's answers to patches, of which the last has a fault: the rule is the only one
/// that finds it, names the patches, and holds without the fault.
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

/// Moves the points at a quarter and at three quarters of edge u0 or v0 towards the middle.
fn squeeze(output: &mut Tessellation, axis: usize, by: u32) {
    let at = |x| if axis == 0 { [x, 0] } else { [0, x] };
    move_point(output, at(0x4000), at(0x4000 + by));
    move_point(output, at(0xC000), at(0xC000 - by));
}

/// Exchanges the diagonal of the first convex pair of triangles with the wanted numbers of
/// vertices: those with u = 0, and those on the outline.
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
                let is_cell = outline > 0 || is_rectangle(quad);
                if is_convex(quad) && is_cell && [left, outline] == wanted {
                    output.indices[3 * i..3 * i + 3].copy_from_slice(&[a, b, d]);
                    output.indices[3 * j..3 * j + 3].copy_from_slice(&[a, d, c]);
                    return;
                }
            }
        }
    }
}

/// Whether four points are the corners of a cell between columns and rows.
fn is_rectangle(quad: [DomainPoint; 4]) -> bool {
    let distinct = |of: fn(DomainPoint) -> u32| {
        quad.into_iter().map(of).collect::<std::collections::BTreeSet<_>>().len()
    };
    distinct(|point| point.u.to_bits()) == 2 && distinct(|point| point.v.to_bits()) == 2
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
        // The output for level 3.0625, whose shorter segments have nearly vanished.
        let line = "case isoline fractional_odd line ruler 3f800000 40440000";
        *output = case(line).patch().tessellate();
    });
    found_by_alone(VULKAN, Rule::PointsOnce, &[POINTS], |output| output.indices.push(3));
    found_by_alone(VULKAN, Rule::PointsSame, &[TRI, POINTS], |output| {
        let [u, v] = [output.points[15].u.to_bits(), output.points[15].v.to_bits()];
        output.points[15] = DomainPoint::from_bits(u + 1, v);
    });
}

/// Rules about the inside: columns and rows, rings, and what joins them.
#[test]
fn faults_of_the_inside() {
    let exchanged = QUAD.replace("40a00000 40c00000", "40c00000 40a00000");
    let answer: &dyn Fn(&str) -> Tessellation = &|line| case(line).patch().tessellate();
    for (line, other) in [
        (QUAD, exchanged.as_str()),
        (TRI, &TRI.replace("40400000 40a00000", "40400000 40800000")),
        (QUAD, &QUAD.replace("40a00000 40c00000", "3f800000 3f800000")),
    ] {
        let report = judge(VULKAN, [(case(line), answer(other))]);
        assert_eq!(rules(&report, Verdict::Broken), ["inner-levels"], "{report}");
    }
    // A row of vertices at another place, and a vertex of a ring at another place.
    found_by_alone(VULKAN, Rule::InnerSpacing, &[QUAD], |output| move_row(output, 40));
    found_by_alone(VULKAN, Rule::InnerSpacing, &[TRI], |output| {
        // After 12 vertices of the outline and 4 of the ring: the first vertex next to v = 0 that
        // is not a corner.
        let vertex = &mut output.points[16];
        *vertex = DomainPoint::from_bits(vertex.u.to_bits() + 40, vertex.v.to_bits());
    });
    // The shorter segments of one level at two places: next to the ends, or next to the middle.
    let line = "case isoline fractional_even line ruler 3f800000 40a80000";
    found_by_alone(VULKAN, Rule::EqualLevels, &[line, &line.replace(" 3f8", " 400")], |output| {
        let center = "case isoline fractional_even line center 40000000 40a80000";
        *output = case(center).patch().tessellate();
    });
    // A triangle that cuts off a corner of the outline.
    found_by_alone(VULKAN, Rule::Neighbours, &[QUAD], |output| flip(output, [2, 3]));
}

/// Moves the inside vertices that have the smallest v.
fn move_row(output: &mut Tessellation, by: u32) {
    let inside = output.points.iter().filter(|point| !is_on_outline(**point));
    let least = inside.map(|point| point.v).min();
    for point in output.points.iter_mut() {
        if !is_on_outline(*point) && Some(point.v) == least {
            *point = DomainPoint::from_bits(point.u.to_bits(), point.v.to_bits() + by);
        }
    }
}

/// Rules about one patch's primitives.
#[test]
fn faults_of_primitives() {
    let last = |output: &mut Tessellation| output.indices.truncate(output.indices.len() - 3);
    found_by_alone(VULKAN, Rule::Cover, &[QUAD], last);
    found_by_alone(VULKAN, Rule::Cover, &[QUAD], |output| output.indices.extend([20, 21, 22]));
    // Vertices of the inside may be on the outline here, so other rules do not ask where they are.
    let touching = "case quad fractional_odd triangle_cw ruler 40a00000 40a00000 40a00000 40a00000 \
                    3f800000 3f800000";
    found_by_alone(VULKAN, Rule::Orientation, &[touching], |output| {
        // The corner of the inside rectangle that is nearest to (0, 0), moved beyond the diagonal
        // of the rectangle's two triangles.
        let corner = output.points.len() - 3;
        output.points[corner] = DomainPoint::from_bits(0xF000, 0xF000);
    });
    found_by_alone(VULKAN, Rule::Isolines, &[LINES], |output| output.indices.extend([0, 1]));
    found_by_alone(VULKAN, Rule::Isolines, &[LINES], |output| output.indices[1] = 2);
}

/// Rules of Direct3D, which defines the place of every vertex.
#[test]
fn faults_of_exact_places() {
    const D3D11: Specification = Specification::D3d11;
    let report = judge(
        D3D11,
        [(case(QUAD), {
            let exchanged = QUAD.replace("40a00000 40c00000", "40c00000 40a00000");
            case(&exchanged).patch().tessellate()
        })],
    );
    let example = row(&report, Rule::InnerLevels).smallest.as_ref().map(|row| row.what.as_str());
    assert_eq!(example, Some("inner level 1 is 5 and asks for 5 columns; there are 6"), "{report}");
    // When all points are viewed as a line, no primitives are compared.
    let view = QUAD.replace("triangle_cw", "line");
    found_by_alone(D3D11, Rule::Counts, &[&view], |output| output.indices.extend([0, 1]));
    found_by_alone(D3D11, Rule::Places, &[&view], |output| squeeze(output, 1, 4));
    found_by_alone(D3D11, Rule::Primitives, &[QUAD], |output| flip(output, [0, 0]));
}

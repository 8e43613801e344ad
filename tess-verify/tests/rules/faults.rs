//! The fault that each rule alone finds.

use super::*;

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

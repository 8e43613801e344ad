//! Factor rules.

use crate::models::models;
use glam::Vec3;
use tess_core::{Config, OutputPrimitive, Partitioning, Patch, PatchFactors, QuadFactors};
use tess_surface::factors::{
    at_most, edge_beside_halves, edge_by_curvature, edge_by_distance, edge_by_flatness,
    edge_by_length, edge_by_screen_size, inside_quad, inside_triangle, quotient, root_quotient,
};
use tess_surface::pn::edge_points;
use tess_surface::{Bend, BezierPatch, Curve, Edge, FactorRule, Model, PnCorner, Surface};

const X_AXIS: Curve = Curve::Line([Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0)]);

#[test]
fn values() {
    let eye = Vec3::new(1.0, 0.0, 4.0);
    let distance = FactorRule::Distance { eye, scale: 20.0 };
    assert_eq!(distance.edge(&X_AXIS, 0.0), 5.0, "20 / 4");
    let screen = FactorRule::ScreenSize { eye, pixels_per_unit: 100.0, segment: 5.0 };
    assert_eq!(screen.edge(&X_AXIS, 0.0), 10.0, "2 units at distance 4: 50 pixels");
    // Second derivative 8 along one axis: n segments deviate by 8 / (8 n^2).
    let flat = FactorRule::Flatness { tolerance: 0.02 };
    assert_eq!(flat.edge(&X_AXIS, 8.0), 16.0, "the power of two from sqrt(8 / 0.08)");
}

#[test]
fn factors_stay_in_range() {
    let at_eye = FactorRule::Distance { eye: Vec3::X, scale: 20.0 };
    assert_eq!(at_eye.edge(&X_AXIS, 0.0), 64.0, "infinity");
    let point = Curve::Line([Vec3::X; 2]);
    let nothing = FactorRule::ScreenSize { eye: Vec3::X, pixels_per_unit: 1.0, segment: 1.0 };
    assert_eq!(nothing.edge(&point, 0.0), 1.0, "0 / 0");
    for (factor, expected) in [(f32::NAN, 1.0), (-1.0, 1.0), (0.0, 1.0), (65.0, 64.0), (2.5, 2.5)] {
        assert_eq!(FactorRule::Uniform(factor).edge(&X_AXIS, 0.0), expected, "{factor}");
    }
}

/// A rule sees the canonical curve, so the direction in which a patch walks it does not matter.
#[test]
fn direction_is_no_matter() {
    let curve = Curve::cubic(
        [[0.1, 0.2, 0.3], [0.7, 0.1, 0.4], [0.3, 0.9, 0.2], [0.5, 0.5, 0.6]].map(Vec3::from_array),
    );
    let rule = FactorRule::ScreenSize { eye: Vec3::ONE, pixels_per_unit: 77.7, segment: 3.3 };
    let [ours, theirs] = [curve, curve.reversed()].map(|curve| Edge::new(curve).curve);
    assert_eq!(rule.edge(&ours, 0.0).to_bits(), rule.edge(&theirs, 0.0).to_bits(), "one edge");
    assert_ne!(Edge::new(curve).direction, Edge::new(curve.reversed()).direction, "two directions");
}

/// A straight edge has one factor, computed from its ends or from its curve.
#[test]
fn straight_edges_are_curves() {
    let ends = [Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0)];
    let eye = Vec3::new(1.0, 0.0, 4.0);
    let distance = FactorRule::Distance { eye, scale: 20.0 };
    assert_eq!(edge_by_distance(ends, eye, 20.0), distance.edge(&X_AXIS, 0.0), "5");
    let screen = FactorRule::ScreenSize { eye, pixels_per_unit: 100.0, segment: 5.0 };
    assert_eq!(edge_by_screen_size(ends, eye, 100.0, 5.0), screen.edge(&X_AXIS, 0.0), "10");
    let flat = FactorRule::Flatness { tolerance: 0.02 };
    assert_eq!(edge_by_flatness(8.0, 0.02), flat.edge(&X_AXIS, 8.0), "16");
}

#[test]
fn a_length_has_as_many_pixels_at_any_distance() {
    for away in [0.0, 1.0, 1e6] {
        let ends = [Vec3::new(0.0, 0.0, away), Vec3::new(3.0, 4.0, away)];
        assert_eq!(edge_by_length(ends, 20.0, 10.0), 10.0, "5 units are 100 pixels");
        assert_eq!(edge_by_length(ends, 20.0, 0.5), 64.0, "200 segments are too many");
        assert_eq!(edge_by_length(ends, 1.0, 10.0), 1.0, "no less");
    }
}

#[test]
fn a_largest_factor_leaves_smaller_ones_and_culling() {
    for (factor, most, expected) in [
        (40.0, 16.0, 16.0),
        (16.0, 16.0, 16.0),
        (3.5, 16.0, 3.5),
        (0.0, 16.0, 0.0),
        (-1.0, 8.0, -1.0),
    ] {
        assert_eq!(at_most(factor, most), expected, "{factor}, {most}");
    }
    assert!(at_most(f32::NAN, 8.0).is_nan(), "it culls");
    assert_eq!(at_most(f32::INFINITY, 8.0), 8.0, "the largest");
}

#[test]
fn quotients_end_at_1_and_64() {
    for (dividend, divisor, expected, root) in [
        (9.0, 4.0, 2.25, 1.5),
        (64.0, 1.0, 64.0, 8.0),
        (65.0, 1.0, 64.0, 65.0f32.sqrt()),
        (4095.0, 1.0, 64.0, 4095.0f32.sqrt()),
        (4097.0, 1.0, 64.0, 64.0),
        (1.0, 0.0, 64.0, 64.0),
        (f32::INFINITY, 2.0, 64.0, 64.0),
        (0.0, 0.0, 1.0, 1.0),
        (1.0, 2.0, 1.0, 1.0),
        (3.0, -1.0, 1.0, 1.0),
        (-3.0, -1.0, 1.0, 1.0),
        (f32::NAN, 1.0, 1.0, 1.0),
        (1.0, f32::NAN, 1.0, 1.0),
    ] {
        assert_eq!(quotient(dividend, divisor), expected, "{dividend} / {divisor}");
        assert_eq!(root_quotient(dividend, divisor), root, "root of {dividend} / {divisor}");
    }
}

/// A low arch, whose second derivative is nearly constant: equal segments deviate by the tolerance,
/// not less.
#[test]
fn curvature_keeps_the_tolerance_and_no_more() {
    let corner = |x: f32, slope: f32| PnCorner {
        position: Vec3::new(x, 0.0, 0.0),
        normal: Vec3::new(-slope, 0.0, 1.0).normalize(),
    };
    let ends = [corner(-1.0, 0.1), corner(1.0, -0.1)];
    let [near_a, near_b] = edge_points(ends[0], ends[1]);
    let curve = Curve::cubic([ends[0].position, near_a, near_b, ends[1].position]);
    for tolerance in [1e-3, 1e-4, 3e-5] {
        let factor = edge_by_curvature(ends, tolerance);
        assert!((2.0..60.0).contains(&factor), "{factor} is in range");
        assert_eq!(edge_by_curvature([ends[1], ends[0]], tolerance), factor, "the other way");
        let step = 1.0 / factor;
        let deviation = |from: f32| {
            let [a, b] = [from, from + step].map(|t| curve.position(t));
            ((a + b) * 0.5).distance(curve.position(from + 0.5 * step))
        };
        let most = [0.0, 0.3, 0.5, 1.0 - step].map(deviation).into_iter().fold(0.0, f32::max);
        assert!((0.98..1.01).contains(&(most / tolerance)), "{most} for {tolerance}");
    }
    let [a, b] = [-1.0, 1.0].map(|x| corner(x, 0.0));
    assert_eq!(edge_by_curvature([a, b], 1e-4), 1.0, "a straight edge");
}

#[test]
fn insides_are_means() {
    assert_eq!(
        inside_quad([1.0, 10.0, 4.0, 20.0]),
        [15.0, 2.5],
        "of the edges that run the same way"
    );
    assert_eq!(inside_triangle([1.0, 2.0, 6.0]), 3.0, "of all three");
    // Three times this number is halfway between two floats, so a third of the sum is another
    // float.
    let awkward = f32::from_bits(1.5f32.to_bits() + 2);
    assert_ne!((awkward + awkward + awkward) / 3.0, awkward, "the plain mean");
    assert_eq!(inside_triangle([awkward; 3]), awkward, "equal edges");
    // The edges of this quad are 2, 3, 4 and 3 units long, 40 away.
    let at = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    let corners = [at(0.0, 0.0), at(3.0, 0.0), at(3.0, 4.0), at(0.0, 2.0)];
    let mesh = crate::models::mesh(&corners.map(|c| c.to_array()), &[&[0, 1, 2, 3]]);
    let model = Model::polygons(mesh, tess_surface::Style::Flat).unwrap();
    let rule = FactorRule::ScreenSize {
        eye: at(1.5, 1.5) + Vec3::Z * 4000.0,
        pixels_per_unit: 4e4,
        segment: 10.0,
    };
    let PatchFactors::Quad(quad) = rule.factors(&model, 0, Partitioning::FractionalOdd) else {
        panic!("a quad");
    };
    assert_eq!(quad.inside_u, 0.5 * (quad.v0 + quad.v1), "u: {quad:?}");
    assert_eq!(quad.inside_v, 0.5 * (quad.u0 + quad.u1), "v: {quad:?}");
    assert!((quad.inside_v - 3.0).abs() < 0.01 && quad.u0 < 2.1 && quad.u1 > 3.9, "{quad:?}");
    let PatchFactors::Quad(rounded) = rule.factors(&model, 0, Partitioning::Pow2) else {
        panic!("a quad");
    };
    assert_eq!((rounded.u0, rounded.inside_v), (2.0, 4.0), "the mean is taken first: {rounded:?}");
}

/// A quad that bends along one axis only: the other axis needs one segment, inside too.
#[test]
fn flatness_follows_each_axis() {
    let height = |i: usize| [0.0, 0.5, 0.5, 0.0][i];
    let point = |i: usize, j: usize| Vec3::new(i as f32 / 3.0, j as f32 / 3.0, 0.0);
    let along_u =
        std::array::from_fn(|j| std::array::from_fn(|i| point(i, j) + Vec3::Z * height(i)));
    let along_v =
        std::array::from_fn(|j| std::array::from_fn(|i| point(i, j) + Vec3::Z * height(j)));
    let rule = FactorRule::Flatness { tolerance: 0.01 };
    let factors = |points| {
        let model = Model::bezier(vec![BezierPatch::polynomial(points)]).unwrap();
        let PatchFactors::Quad(quad) = rule.factors(&model, 0, Partitioning::Integer) else {
            panic!("a quad");
        };
        [quad.u0, quad.v0, quad.u1, quad.v1, quad.inside_u, quad.inside_v]
    };
    // Second differences of 0.5, times 6, over 4 tolerances: the square of the segments is 75.
    assert_eq!(factors(along_u), [1.0, 16.0, 1.0, 16.0, 16.0, 1.0], "bent along u");
    assert_eq!(factors(along_v), [16.0, 1.0, 16.0, 1.0, 1.0, 16.0], "bent along v");
}

/// The control points of u v h over the unit square: no line of them bends, and the mixed
/// derivative is h.
#[test]
fn a_twist_alone_bends() {
    let points = |h: f32| {
        let at = |i: usize, j: usize| (i as f32 / 3.0, j as f32 / 3.0);
        let point = |(u, v): (f32, f32)| Vec3::new(u, v, u * v * h);
        std::array::from_fn(|j| std::array::from_fn(|i| point(at(i, j))))
    };
    for h in [1.0, 5.0] {
        let patch = BezierPatch::polynomial(points(h));
        let Bend { u, v } = Bend::of(&Surface::Bezier(patch));
        assert!((u - h).abs() < 1e-4 && (v - h).abs() < 1e-4, "{u} and {v} for {h}");
    }
}

#[test]
fn powers_of_two() {
    for (name, model) in &models() {
        let factors = FactorRule::Uniform(5.0).factors(model, 0, Partitioning::Pow2);
        assert!(factors.iter().all(|factor| factor == 8.0), "{name}: {factors:?}");
    }
}

/// The points on an edge of this factor, in units of 2^-16.
fn edge_points_of(factor: f32, partitioning: Partitioning) -> Vec<u32> {
    let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
    let whole = Patch::new(config, QuadFactors::from([factor; 6])).tessellate();
    let on_edge = whole.points.iter().filter(|point| point.v.to_bits() == 0);
    let mut points: Vec<u32> = on_edge.map(|point| point.u.to_bits()).collect();
    points.sort_unstable();
    points
}

/// The largest distance of a point of an edge from that of the two halves beside it, in units of
/// 2^-17; `None` if the numbers of points differ.
fn misfit(whole: f32, half: f32, partitioning: Partitioning) -> Option<u32> {
    let whole: Vec<u32> = edge_points_of(whole, partitioning).iter().map(|u| 2 * u).collect();
    let half = edge_points_of(half, partitioning);
    let second = half.iter().skip(1).map(|u| u + 65536);
    let halves: Vec<u32> = half.iter().copied().chain(second).collect();
    let distances = whole.iter().zip(&halves).map(|(a, b)| a.abs_diff(*b));
    (whole.len() == halves.len()).then(|| distances.max().unwrap_or(0))
}

#[test]
fn an_edge_meets_its_halves() {
    for partitioning in [Partitioning::Integer, Partitioning::Pow2] {
        for sixteenths in 0..=1040u16 {
            let factor = f32::from(sixteenths) / 16.0;
            let [whole, half] = edge_beside_halves(factor);
            assert!(whole >= factor.min(64.0), "{factor}: not fewer than asked for, {whole}");
            assert!(whole < 2.0 * factor.max(1.0) || whole == 2.0, "{factor}: {whole}");
            assert_eq!(misfit(whole, half, partitioning), Some(0), "{whole} and {half}");
        }
    }
    assert_eq!(edge_beside_halves(f32::NAN), [2.0, 1.0], "NaN counts as 1");
}

/// The reason for the rule: docs/porting.md has these numbers.
#[test]
fn other_edges_miss_their_halves() {
    let misfits = (1..=32u16).map(|half| {
        let half = f32::from(half);
        misfit(2.0 * half, half, Partitioning::Integer).expect("as many points")
    });
    let misfits: Vec<u32> = misfits.collect();
    let exact: Vec<usize> = (1..=32).filter(|half| misfits[half - 1] == 0).collect();
    assert_eq!(exact, [1, 2, 4, 8, 16, 32], "only powers of two meet exactly");
    assert_eq!(misfits.iter().max(), Some(&19), "others are up to 9.5/65536 off");
}

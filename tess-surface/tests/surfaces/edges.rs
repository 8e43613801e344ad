//! Edges are the same curve from both ends.

use glam::{Vec3, Vec4};
use tess_surface::pn::edge_normal;
use tess_surface::sides::{Place, corner_coordinates};
use tess_surface::{
    BezierPatch, Curve, Direction, Edge, Model, PnCorner, Sample, Sides, Surface, SurfacePatch,
};

/// Control points that read the same backwards, polynomial and rational; no coordinate is a short
/// binary number.
fn palindromes() -> [[Vec4; 4]; 2] {
    let [a, b] = [Vec4::new(0.1, 0.7, -0.3, 1.0), Vec4::new(1.3, 0.2, 0.9, 1.0)];
    [[a, b, b, a], [a * 0.7, b * 1.1, b * 1.1, a * 0.7]]
}

fn bits(position: Vec3) -> [u32; 3] {
    position.to_array().map(f32::to_bits)
}

/// Places along an edge, and for each the place at the same distance from the other end.
fn places() -> Vec<[f32; 2]> {
    (0..=1000u16).map(|i| f32::from(i) * 65.0 / 65536.0).map(|t| [t, 1.0 - t]).collect()
}

/// So close to a corner that the distance from the other one rounds to 1, the result is the corner
/// itself, whatever its weight.
#[test]
fn ends_of_weighted_edges_are_their_corners() {
    let points: [[Vec3; 4]; 4] = std::array::from_fn(|j| {
        std::array::from_fn(|i| Vec3::new(i as f32 + 1.0, j as f32 * 2.0 - 5.0, (i * j) as f32))
    });
    let weights = std::array::from_fn(|j| std::array::from_fn(|i| 2.0 + ((i + 2 * j) % 3) as f32));
    let patch = SurfacePatch::new(Surface::Bezier(BezierPatch::rational(points, weights)));
    let mirrored = SurfacePatch::new(Surface::Bezier(BezierPatch::rational(
        points.map(|[a, b, c, d]| [d, c, b, a]),
        weights.map(|[a, b, c, d]| [d, c, b, a]),
    )));
    const NEAR: f32 = 1e-9;
    for (patch, [left, right]) in [(&patch, [0, 3]), (&mirrored, [3, 0])] {
        let places = [[NEAR, 0.0], [NEAR, 1.0], [0.0, NEAR], [1.0, NEAR], [0.5, 0.0], [1.0, 0.25]];
        let mut samples = [Sample::default(); 6];
        patch.samples(&places, &mut samples);
        for (at, sample) in places.into_iter().zip(samples) {
            assert_eq!(bits(sample.position), bits(patch.sample(at).position), "{at:?}, in lanes");
        }
        let corners = [points[0][left], points[3][left], points[0][left], points[0][right]];
        for ((sample, corner), at) in samples.iter().zip(corners).zip(places) {
            assert!(sample.position.distance(corner) < 1e-6, "{at:?}: {sample:?} for {corner}");
        }
    }
}

/// Such a curve has no canonical direction, so neighbours may walk it either way. It is folded at
/// its middle.
#[test]
fn palindromic_curves_are_folded() {
    for points in palindromes() {
        let curve = Curve::Cubic(points);
        let edge = Edge::new(curve);
        assert_eq!(edge.direction, Direction::Symmetric, "{points:?}");
        let mut differ = 0;
        for [t, other] in places() {
            let [ours, theirs] = [t, other].map(|t| bits(edge.position(t)));
            assert_eq!(ours, theirs, "{points:?} at {t}");
            differ += usize::from(bits(curve.position(t)) != bits(curve.position(other)));
        }
        assert!(differ > 100, "unfolded, {differ} places differ");
    }
}

/// The same for the patches on both sides, one point at a time and in lanes.
#[test]
fn patches_agree_on_palindromic_edges() {
    for edge in palindromes() {
        let column = |at: f32| edge.map(|p| p + Vec4::new(at, 0.3 * at * p.x, 0.2 * at, 0.0) * p.w);
        // The edge u = 0 of both patches, which run along it in opposite directions: rows along v.
        let net = |across: f32| {
            let columns = [0.0, 1.0, 2.0, 3.0].map(|i| column(i * across));
            BezierPatch { points: std::array::from_fn(|j| columns.map(|column| column[j])) }
        };
        let mut other = net(-0.5);
        other.points.reverse();
        let patches = [net(0.4), other];
        let model = Model::bezier(patches.to_vec()).expect("a model");
        assert!(model.twin(tess_surface::HalfEdge { patch: 0, edge: 0 }).is_some(), "one edge");
        let [one, other] = patches.map(|patch| SurfacePatch::new(Surface::Bezier(patch)));
        for [t, back] in places() {
            let [ours, theirs] = [one.position([0.0, t]), other.position([0.0, back])];
            assert_eq!(bits(ours), bits(theirs), "{edge:?} at {t}");
        }
        let samples = |patch: &SurfacePatch, of: usize| {
            let points: Vec<_> = places().iter().map(|t| [0.0, t[of]]).collect();
            let mut samples = vec![Sample::default(); points.len()];
            patch.samples(&points, &mut samples);
            samples.iter().map(|sample| bits(sample.position)).collect::<Vec<_>>()
        };
        assert_eq!(samples(&one, 0), samples(&other, 1), "{edge:?} in lanes");
    }
}

/// The control polygon of a curve is at least as long as the curve, and as long as a line.
#[test]
fn curves_are_at_most_as_long_as_their_polygons() {
    let [a, b, c, d] =
        [[0.0; 3], [1.0, 2.0, 0.0], [3.0, -1.0, 0.5], [4.0, 0.0, 1.0]].map(Vec3::from_array);
    assert_eq!(Curve::Line([a, d]).length_bound(), a.distance(d), "a line");
    for curve in [Curve::cubic([a, b, c, d]), Curve::cubic([a, b, b, a])] {
        let places: Vec<Vec3> = (0..=64).map(|k| curve.position(k as f32 / 64.0)).collect();
        let length: f32 = places.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let bound = curve.length_bound();
        assert!((length..2.0 * length).contains(&bound), "{bound} for {length}");
    }
}

/// Corners are where edges meet, and an edge's middle normal is the same from both ends.
#[test]
fn corners_and_middle_normals_belong_to_edges() {
    for sides in [Sides::Triangle([(); 3]), Sides::Quad([(); 4])] {
        for (corner, [u, v]) in corner_coordinates(&sides).as_slice().iter().enumerate() {
            assert_eq!(Place::of(&sides, *u, *v), Place::Corner(corner), "{sides:?}");
        }
    }
    let a = PnCorner { position: Vec3::ZERO, normal: Vec3::Z };
    let b = PnCorner { position: Vec3::X, normal: Vec3::new(0.6, 0.0, 0.8) };
    let middle = edge_normal(a, b);
    assert_eq!(bits(middle), bits(edge_normal(b, a)), "from both ends");
    // The sum (0.6, 0, 1.8), reflected at the plane across the edge.
    assert!(middle.distance(Vec3::new(-0.6, 0.0, 1.8).normalize()) < 1e-6, "{middle}");
}

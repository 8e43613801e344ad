//! Normals and derivatives compared with binary64 evaluations in another form: Bernstein
//! polynomials and central differences.

use crate::models::{models, rational_ball};
use glam::{DVec3, Vec3, Vec4};
use tess_surface::{BezierPatch, Surface, SurfacePatch, Tangents, teapot};
use tess_verify::generate::SplitMix64;

fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// The point of a patch in binary64.
fn exact(patch: &BezierPatch, u: f64, v: f64) -> DVec3 {
    let (bu, bv) = (bernstein(u), bernstein(v));
    let mut sum = [0.0f64; 4];
    for (row, bv) in patch.points.iter().zip(bv) {
        for (point, bu) in row.iter().zip(bu) {
            let weighted = point.to_array().map(|x| f64::from(x) * bu * bv);
            sum = std::array::from_fn(|k| sum[k] + weighted[k]);
        }
    }
    DVec3::new(sum[0], sum[1], sum[2]) / sum[3]
}

/// Derivatives along u and v at a point that is at least `STEP` away from the border.
fn differences(patch: &BezierPatch, u: f64, v: f64) -> [DVec3; 2] {
    const STEP: f64 = 1e-5;
    let du = exact(patch, u + STEP, v) - exact(patch, u - STEP, v);
    let dv = exact(patch, u, v + STEP) - exact(patch, u, v - STEP);
    [du / (2.0 * STEP), dv / (2.0 * STEP)]
}

/// Domain points away from the border, some of them close to it.
fn inside() -> impl Iterator<Item = (f32, f32)> {
    let places = [1.0 / 1024.0, 0.1, 0.25, 0.5, 0.7, 0.9, 1023.0 / 1024.0];
    places.into_iter().flat_map(move |u| places.into_iter().map(move |v| (u, v)))
}

fn largest_error(normal: impl Fn(&BezierPatch, f32, f32) -> Vec3) -> f64 {
    let mut largest = 0.0f64;
    for patch in teapot::patches().iter().chain(&rational_ball()) {
        for (u, v) in inside() {
            let [du, dv] = differences(patch, f64::from(u), f64::from(v));
            let expected = du.cross(dv).normalize();
            largest = largest.max(expected.distance(normal(patch, u, v).as_dvec3()));
        }
    }
    largest
}

#[test]
fn normals_are_those_of_finite_differences() {
    let error = largest_error(BezierPatch::normal);
    assert!(error < 1e-3, "largest distance of unit normals: {error}");
    let error = largest_error(|patch, u, v| patch.normal(u, (v + 0.01).min(1.0)));
    assert!(error > 1e-2, "normals from a place nearby were not told apart: {error}");
}

#[test]
fn positions_and_tangents_are_exact() {
    for patch in teapot::patches().iter().chain(&rational_ball()) {
        for (u, v) in inside() {
            let frame = patch.frame(u, v);
            let position = exact(patch, f64::from(u), f64::from(v));
            let error = position.distance(frame.position.as_dvec3());
            assert!(error < 2e-6, "position at ({u}, {v}): {error}");
            let [du, dv] = differences(patch, f64::from(u), f64::from(v));
            let errors = [frame.tangents.du.as_dvec3() - du, frame.tangents.dv.as_dvec3() - dv];
            let error = errors[0].length().max(errors[1].length());
            assert!(error < 2e-5, "tangents at ({u}, {v}): {error}");
        }
    }
}

/// Edges collapsed to a point: the teapot's knob and bottom, the ball's poles.
#[test]
fn normals_at_poles_are_limits() {
    let teapot = teapot::patches();
    for t in [0.0, 0.2, 0.5, 1.0] {
        for patch in &teapot[20..24] {
            assert!(patch.normal(t, 0.0).distance(Vec3::Z) < 1e-5, "knob at {t}");
        }
        for patch in &teapot[28..] {
            assert!(patch.normal(t, 0.0).distance(-Vec3::Z) < 1e-5, "bottom at {t}");
        }
        for patch in rational_ball() {
            let pole = patch.frame(t, 1.0).position;
            assert!(pole.z.abs() == 1.0, "the pole at {t}: {pole}");
            assert!(patch.normal(t, 1.0).distance(pole) < 1e-5, "normal at the pole, {t}");
        }
    }
}

/// The normal of a patch, not of unit length, at a place that is moved inwards by `by` from each
/// border that it is on.
fn nearby(patch: &BezierPatch, [u, v]: [f32; 2], by: f64) -> DVec3 {
    let inwards = |x: f32| f64::from(x).clamp(by, 1.0 - by);
    let [du, dv] = differences(patch, inwards(u), inwards(v));
    du.cross(dv)
}

/// A rational patch whose control points and weights are small integers.
fn integers(random: &mut SplitMix64) -> ([[Vec3; 4]; 4], [[f32; 4]; 4]) {
    let mut integer = |low: f32, count| low + random.below(count) as f32;
    let mut row = || std::array::from_fn(|_| Vec3::from_array([(); 3].map(|()| integer(-8.0, 17))));
    let points = std::array::from_fn(|_| row());
    let mut row = || std::array::from_fn(|_| integer(1.0, 3));
    (points, std::array::from_fn(|_| row()))
}

/// Corners whose two edges start in one direction: the first derivatives span no plane, so the
/// second ones decide.
#[test]
fn normals_at_cusps_are_limits() {
    let mut random = SplitMix64::new(7);
    let mut compared = 0;
    for round in 0..400 {
        let (mut points, mut weights) = integers(&mut random);
        let (last_u, last_v) = (round % 2 == 1, round / 2 % 2 == 1);
        let (i, near_i) = if last_u { (3, 2) } else { (0, 1) };
        let (j, near_j) = if last_v { (3, 2) } else { (0, 1) };
        let way = Vec3::new(1.0 + random.below(3) as f32, 2.0, -1.0);
        points[j][near_i] = points[j][i] + way;
        points[near_j][i] = points[j][i] + way * 2.0;
        // Powers of two, so that both edges start in exactly one direction.
        weights[j][i] = if round % 8 < 4 { 1.0 } else { 2.0 };
        let patch = BezierPatch::rational(points, weights);
        let at = [f32::from(u8::from(last_u)), f32::from(u8::from(last_v))];
        let [near, nearer] = [2e-4, 1e-4].map(|by| nearby(&patch, at, by).normalize().as_vec3());
        if near.distance(nearer) > 1e-2 {
            continue; // it turns too quickly for places around it to tell
        }
        let error = patch.normal(at[0], at[1]).distance(nearer);
        assert!(error < 3e-2, "{error} from the limit at {at:?}: {patch:?}");
        compared += 1;
    }
    assert!(compared > 100, "{compared} were compared");
}

/// Edges that are collapsed as a whole, with weights: the normal there is the limit along the way
/// inwards.
#[test]
fn normals_at_collapsed_edges_are_limits() {
    let mut random = SplitMix64::new(8);
    let mut compared = 0;
    for round in 0..200 {
        let (mut points, weights) = integers(&mut random);
        let edge = round % 4;
        for k in 0..4 {
            let [j, i] = [[0, k], [3, k], [k, 0], [k, 3]][edge];
            points[j][i] = Vec3::new(1.0, -2.0, 3.0);
        }
        let patch = BezierPatch::rational(points, weights);
        let place = 0.25 + f32::from(u8::from(round % 8 < 4)) / 2.0;
        let [u, v] = [[place, 0.0], [place, 1.0], [0.0, place], [1.0, place]][edge];
        let expected = nearby(&patch, [u, v], 1e-4);
        if expected.length() < 1e-2 {
            continue; // too close to a second collapse
        }
        let error = expected.normalize().as_vec3().distance(patch.normal(u, v));
        assert!(error < 3e-2, "{error} from the limit at ({u}, {v}): {patch:?}");
        compared += 1;
    }
    assert!(compared > 100, "{compared} were compared");
}

/// A tip so flat that the second derivatives vanish too: its normal is that of a place slightly
/// further inside.
#[test]
fn normals_at_flat_tips_are_those_nearby() {
    let tip = [Vec3::ZERO; 4];
    // Two arcs around the axis, clockwise as seen from above, the outer one far below.
    let arc = |radius: f32, z: f32| {
        [[1.0, 0.0], [1.0, 0.6], [0.6, 1.0], [0.0, 1.0]]
            .map(|[x, y]: [f32; 2]| Vec3::new(y * radius, x * radius, z))
    };
    let rows = [tip, tip, arc(1.0, 0.0), arc(2.0, -6.0)];
    let [a, b, c, d] = rows;
    let columns =
        |rows: [[Vec3; 4]; 4]| std::array::from_fn(|j| std::array::from_fn(|i| rows[i][j]));
    for (points, [u, v], up) in [
        (rows, [0.5, 0.0], 1.0),
        ([d, c, b, a], [0.5, 1.0], -1.0),
        (columns(rows), [0.0, 0.5], -1.0),
        (columns([d, c, b, a]), [1.0, 0.5], 1.0),
    ] {
        let patch = BezierPatch::polynomial(points);
        let (tip, middle) = (patch.normal(u, v), patch.normal(0.5, 0.5));
        assert!(tip.distance(Vec3::Z * up) < 0.2, "at ({u}, {v}): {tip}");
        assert!(middle.distance(Vec3::Z * up) > 0.5, "elsewhere it is another: {middle}");
    }
}

#[test]
fn rational_quarters_make_a_ball() {
    for patch in rational_ball() {
        for (u, v) in inside() {
            let position = patch.frame(u, v).position;
            assert!((position.length() - 1.0).abs() < 1e-6, "radius at ({u}, {v}): {position}");
            let normal = patch.normal(u, v);
            assert!(normal.distance(position) < 1e-3, "at ({u}, {v}): {normal} for {position}");
        }
    }
    let mut dented = rational_ball()[0];
    dented.points[1][1] += Vec4::new(0.1, 0.0, 0.0, 0.0);
    let radius = dented.frame(0.4, 0.4).position.length();
    assert!((radius - 1.0).abs() > 1e-3, "a moved control point shows: {radius}");
}

#[test]
fn a_polynomial_patch_is_a_rational_one_of_weights_one() {
    for patch in teapot::patches() {
        let points = patch.points.map(|row| row.map(Vec4::truncate));
        let rational = BezierPatch::rational(points, [[1.0; 4]; 4]);
        let heavy = BezierPatch::rational(points, [[3.0; 4]; 4]);
        for (u, v) in inside() {
            assert_eq!(patch.frame(u, v), rational.frame(u, v), "equal bits at ({u}, {v})");
            let moved = heavy.frame(u, v).position.distance(patch.frame(u, v).position);
            assert!(moved < 2e-6, "one common weight changes nothing: {moved}");
        }
    }
}

/// Every normal of every model is a unit vector, also at corners and edges.
#[test]
fn normals_are_unit_vectors_everywhere() {
    let places = [0.0, 0.25, 0.5, 1.0];
    for (name, model) in &models() {
        for number in 0..model.len() {
            let patch: SurfacePatch = model.patch(number);
            let is_triangle = patch.edges().as_slice().len() == 3;
            for [u, v] in places.into_iter().flat_map(|u| places.map(|v| [u, v])) {
                if is_triangle && u + v > 1.0 {
                    continue;
                }
                let normal = patch.sample([u, v]).normal;
                assert!(
                    (normal.length() - 1.0).abs() < 1e-5,
                    "{name} {number} ({u}, {v}): {normal}"
                );
            }
        }
    }
    let flat = SurfacePatch::new(Surface::FlatTriangle([Vec3::X, Vec3::Y, Vec3::ZERO]));
    assert_eq!(flat.sample([0.25, 0.5]).normal, Vec3::Z, "counter-clockwise is up");
}

#[test]
fn nearly_parallel_tangents_have_no_normal() {
    for (rise, expected) in [(0.0, None), (0.5, None), (1.0, None), (2.0, Some(Vec3::Z))] {
        let tangents = Tangents { du: Vec3::X, dv: Vec3::new(3.0, 3.0 * rise / 32768.0, 0.0) };
        assert_eq!(tangents.normal(), expected, "a sine of {rise} times 2^-15");
    }
}

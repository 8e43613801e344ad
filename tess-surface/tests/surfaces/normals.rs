//! Normals and derivatives against binary64 evaluations written another way: Bernstein
//! polynomials and central differences.

use crate::models::{models, rational_ball};
use glam::{DVec3, Vec3, Vec4};
use tess_surface::{BezierPatch, Patch, Surface, teapot};

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

/// Derivatives by u and v at a point that is at least `STEP` away from the border.
fn differences(patch: &BezierPatch, u: f64, v: f64) -> [DVec3; 2] {
    const STEP: f64 = 1e-5;
    let du = exact(patch, u + STEP, v) - exact(patch, u - STEP, v);
    let dv = exact(patch, u, v + STEP) - exact(patch, u, v - STEP);
    [du / (2.0 * STEP), dv / (2.0 * STEP)]
}

/// Domain points away from the border, some of them quite near it.
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

/// Every normal of every model is a unit vector, corners and edges included.
#[test]
fn normals_are_unit_vectors_everywhere() {
    let places = [0.0, 0.25, 0.5, 1.0];
    for (name, model) in &models() {
        for number in 0..model.len() {
            let patch: Patch = model.patch(number);
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
    let flat = Patch::new(Surface::FlatTriangle([Vec3::X, Vec3::Y, Vec3::ZERO]));
    assert_eq!(flat.sample([0.25, 0.5]).normal, Vec3::Z, "counter-clockwise is up");
}

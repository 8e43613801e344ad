//! Tables of culling: balls just inside and just outside, by exact arithmetic.

use crate::factors::{number, point};
use crate::{Case, Expected, Table, args, one, vec};
use glam::{DMat4, DVec3, Mat4, Vec3};
use tess_surface::culling::{faces_away, is_outside};
use tess_verify::generate::SplitMix64;

/// Radii a little below and a little above the deciding one.
const RADII: [(f64, bool); 2] = [(0.999, true), (1.001, false)];

pub(crate) fn tables() -> Vec<Table> {
    vec![
        Table {
            name: "tess_is_outside",
            call: "vec4(f32(tess_is_outside(mat4x4(a[0], a[1], a[2], a[3]), a[4].xyz, a[4].w)), 0, 0, 0)",
            cases: frustums(),
        },
        Table {
            name: "tess_faces_away",
            call: "vec4(f32(tess_faces_away(a[0].xyz, a[0].w, a[1].xyz, a[1].w, a[2].xyz)), 0, 0, 0)",
            cases: backs(),
        },
    ]
}

const fn answer(yes: bool) -> Expected {
    Expected::Bits(one(if yes { 1.0 } else { 0.0 }))
}

/// A perspective projection with z from 0 to w that sees from `near` to `far`, an eighth wider than
/// high.
fn projection(near: f32, far: f32) -> Mat4 {
    let depth = far / (near - far);
    Mat4::from_cols_array_2d(&[
        [1.6, 0.0, 0.0, 0.0],
        [0.0, 1.8, 0.0, 0.0],
        [0.0, 0.0, depth, -1.0],
        [0.0, 0.0, near * depth, 0.0],
    ])
}

/// A camera that looks along `forward`, which is -z in its own space.
fn camera(eye: Vec3, forward: Vec3) -> Mat4 {
    let z = -forward.normalize();
    let x = Vec3::Y.cross(z).normalize();
    Mat4::from_cols(x.extend(0.0), z.cross(x).extend(0.0), z.extend(0.0), eye.extend(1.0))
}

/// The six planes, inside positive, of length 1.
fn planes(clip_from_world: &Mat4) -> [(DVec3, f64); 6] {
    let m: DMat4 = clip_from_world.as_dmat4();
    let [x, y, z, w] = [0, 1, 2, 3].map(|row| m.row(row));
    [w + x, w - x, w + y, w - y, z, w - z].map(|plane| {
        let length = plane.truncate().length();
        (plane.truncate() / length, plane.w / length)
    })
}

#[expect(clippy::cast_possible_truncation, reason = "the margin is a thousandth")]
fn frustums() -> Vec<Case> {
    let mut random = SplitMix64::new(11);
    let mut all = Vec::new();
    for _ in 0..12 {
        let eye = point(&mut random, 3.0);
        let world_from_view = camera(eye, point(&mut random, 1.0));
        let view = world_from_view.inverse();
        // A scale of the whole matrix makes all planes longer, and changes no answer.
        let scale = number(&mut random, 0.2, 5.0);
        let clip_from_world = projection(0.5, 30.0) * scale * view;
        let planes = planes(&clip_from_world);
        let inside = world_from_view.transform_point3(Vec3::new(0.0, 0.0, -10.0)).as_dvec3();
        for (normal, offset) in planes {
            let away = f64::from(number(&mut random, 0.1, 0.8));
            let center = (inside - normal * (normal.dot(inside) + offset + away)).as_vec3();
            let distances = planes.map(|(n, d)| n.dot(center.as_dvec3()) + d);
            let farthest = distances.into_iter().fold(f64::MAX, f64::min);
            assert!((farthest + away).abs() < 1e-4, "this plane decides: {distances:?}");
            for (times, expected) in RADII {
                let radius = (-farthest * times) as f32;
                let by_cpu = is_outside(&clip_from_world, center, radius);
                assert_eq!(by_cpu, expected, "{clip_from_world}, {center}, {radius}");
                let [a, b, c, d] = clip_from_world.to_cols_array_2d();
                let args = [a, b, c, d, vec(center, radius)];
                all.push(Case { args, expected: answer(expected) });
            }
        }
        let [a, b, c, d] = clip_from_world.to_cols_array_2d();
        let args = [a, b, c, d, vec(inside.as_vec3(), 0.0)];
        all.push(Case { args, expected: answer(false) });
    }
    all
}

#[expect(clippy::cast_possible_truncation, reason = "the margin is a thousandth")]
fn backs() -> Vec<Case> {
    let mut random = SplitMix64::new(12);
    let mut all = Vec::new();
    while all.len() < 200 {
        let [center, eye] = [(); 2].map(|()| point(&mut random, 3.0));
        let axis = point(&mut random, 1.0).normalize();
        let sine = number(&mut random, 0.0, 0.7);
        let seen = center.as_dvec3() - eye.as_dvec3();
        let largest = seen.dot(axis.as_dvec3()) - f64::from(sine) * seen.length();
        let given = |radius| args(&[vec(center, radius), vec(axis, sine), vec(eye, 0.0)]);
        if largest < 0.1 {
            assert!(!faces_away(center, 0.1, axis, sine, eye), "some front shows");
            all.push(Case { args: given(0.1), expected: answer(false) });
            continue;
        }
        for (times, expected) in RADII {
            let radius = (largest * times) as f32;
            assert_eq!(faces_away(center, radius, axis, sine, eye), expected, "{radius}");
            all.push(Case { args: given(radius), expected: answer(expected) });
        }
    }
    all
}

//! The culling tests, at their bounds; `tess-wgpu` compares the same functions in WGSL with these.

use glam::{Mat4, Vec3, Vec4};
use tess_surface::culling::{faces_away, is_behind, is_outside};

/// Balls of radius 2 below the plane z = 0, whose normal has length 2.
#[test]
fn a_ball_that_touches_a_plane_is_not_behind_it() {
    let plane = Vec4::new(0.0, 0.0, 2.0, 0.0);
    for (z, expected) in [(-1.5, false), (-2.0, false), ((-2.0f32).next_down(), true), (-2.5, true)]
    {
        let center = Vec3::new(7.0, -3.0, z);
        assert_eq!(is_behind(plane, center, 2.0), expected, "centre at {z}");
    }
}

/// This projection shows x in -2..=2, y in -3..=3, z in 0..=4. A ball of radius 0.5 that touches a
/// plane from outside is not outside, but one a step further away is.
#[test]
fn a_ball_is_outside_behind_any_of_six_planes() {
    let view = Mat4::from_scale(Vec3::new(0.5, 1.0 / 3.0, 0.25));
    let inside = Vec3::new(0.25, -0.5, 2.0);
    assert!(!is_outside(&view, inside, 0.5), "a ball within the view");
    for (axis, touching) in [(0, -2.5), (0, 2.5), (1, -3.5), (1, 3.5), (2, -0.5), (2, 4.5_f32)] {
        let ball = |coordinate: f32| {
            let mut center = inside;
            center[axis] = coordinate;
            is_outside(&view, center, 0.5)
        };
        assert!(!ball(touching * 0.999), "axis {axis}: it touches the plane at {touching}");
        assert!(ball(touching * 1.001), "axis {axis}: behind the plane at {touching}");
    }
}

/// An eye on the ray along which the outermost normal is seen edge-on still sees it.
#[test]
fn a_surface_seen_edge_on_does_not_face_away() {
    for (distance, expected) in [(3.0, false), (4.0, false), (4.5, true)] {
        let center = Vec3::new(0.0, 0.0, distance);
        // Half of the distance is for the angle, 2 for the ball.
        assert_eq!(faces_away(center, 2.0, Vec3::Z, 0.5, Vec3::ZERO), expected, "{distance} away");
    }
}

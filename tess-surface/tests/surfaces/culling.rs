//! The tests that cull, at their bounds; `tess-wgpu` compares the same functions in WGSL with these.

use glam::{Vec3, Vec4};
use tess_surface::culling::{faces_away, is_behind};

/// Balls of radius 2 below the plane z = 0, whose normal has the length 2.
#[test]
fn a_ball_that_touches_a_plane_is_not_behind_it() {
    let plane = Vec4::new(0.0, 0.0, 2.0, 0.0);
    for (z, expected) in [(-1.5, false), (-2.0, false), ((-2.0f32).next_down(), true), (-2.5, true)]
    {
        let center = Vec3::new(7.0, -3.0, z);
        assert_eq!(is_behind(plane, center, 2.0), expected, "centre at {z}");
    }
}

/// An eye on the ray along which the outermost normal is seen from the side still sees it.
#[test]
fn a_surface_seen_edge_on_does_not_face_away() {
    for (distance, expected) in [(3.0, false), (4.0, false), (4.5, true)] {
        let center = Vec3::new(0.0, 0.0, distance);
        // Half of the distance for the angle, 2 for the ball.
        assert_eq!(faces_away(center, 2.0, Vec3::Z, 0.5, Vec3::ZERO), expected, "{distance} away");
    }
}

//! The view of a surface, and its factors and culling on the CPU: `tess_edge` and `tess_is_outside` of the WGSL in Rust.

use crate::detail::LevelOfDetail;
use bevy::math::{Affine3A, Mat4, Vec3};
use bevy::transform::components::GlobalTransform;
use tess_surface::{culling, factors, glam};

/// View and size of a camera's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub(crate) clip_from_world: Mat4,
    pub(crate) eye: Vec3,
    /// Pixels of a length of 1 at distance 1; with an orthographic projection at any distance.
    pub(crate) pixels_per_unit: f32,
    pub(crate) is_orthographic: bool,
}

impl View {
    /// The view of a camera whose picture is `height` pixels high.
    pub(crate) fn new(
        world_from_view: &GlobalTransform,
        clip_from_view: Mat4,
        height: u32,
    ) -> Self {
        let view_from_world = world_from_view.affine().inverse();
        Self {
            clip_from_world: clip_from_view * Mat4::from(view_from_world),
            eye: world_from_view.translation(),
            pixels_per_unit: 0.5 * height as f32 * clip_from_view.y_axis.y.abs(),
            is_orthographic: clip_from_view.w_axis.w == 1.0,
        }
    }
}

/// A camera, and the entity that it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    pub(crate) view: View,
    pub(crate) world_from_local: Affine3A,
    pub(crate) rule: LevelOfDetail,
}

impl Eye {
    /// A place of the entity in world space.
    #[must_use]
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        self.world_from_local.transform_point3(local)
    }

    /// The factor of an edge between two places in world space, by the entity's level of detail: 1 to 64, and 1
    /// for NaN. The same in both directions.
    #[must_use]
    pub fn edge(&self, a: Vec3, b: Vec3) -> f32 {
        let View { eye, pixels_per_unit, is_orthographic, .. } = self.view;
        let (ends, eye) = ([a, b].map(of_surface), of_surface(eye));
        match self.rule {
            LevelOfDetail::Uniform(factor) => factors::in_range(factor),
            LevelOfDetail::Pixels(pixels) if is_orthographic => {
                factors::quotient(a.distance(b) * pixels_per_unit, pixels)
            }
            LevelOfDetail::Pixels(pixels) => {
                factors::edge_by_screen_size(ends, eye, pixels_per_unit, pixels)
            }
            LevelOfDetail::Distance(scale) => factors::edge_by_distance(ends, eye, scale),
        }
    }

    /// Whether a ball in world space is outside the camera's picture.
    #[must_use]
    pub fn is_outside(&self, center: Vec3, radius: f32) -> bool {
        let columns = self.view.clip_from_world.to_cols_array();
        let clip_from_world = glam::Mat4::from_cols_array(&columns);
        culling::is_outside(&clip_from_world, of_surface(center), radius)
    }
}

/// The vector in the version of glam that tess-surface has.
fn of_surface(v: Vec3) -> glam::Vec3 {
    glam::Vec3::from_array(v.to_array())
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy::camera::{CameraProjection, PerspectiveProjection};
    use bevy::math::Quat;

    /// Looks along -z from (0, 0, 10), 90 degrees high, 400 pixels.
    fn eye(rule: LevelOfDetail) -> Eye {
        let camera = GlobalTransform::from(Affine3A::from_rotation_translation(
            Quat::IDENTITY,
            Vec3::new(0.0, 0.0, 10.0),
        ));
        let fov = core::f32::consts::FRAC_PI_2;
        let projection = PerspectiveProjection { fov, aspect_ratio: 1.0, ..Default::default() };
        let clip_from_view = projection.get_clip_from_view();
        let view = View::new(&camera, clip_from_view, 400);
        Eye { view, world_from_local: Affine3A::IDENTITY, rule }
    }

    #[test]
    fn edges_have_segments_of_so_many_pixels() {
        let eye = eye(LevelOfDetail::Pixels(5.0));
        // A length of 1 at distance 10 has 20 pixels.
        let (a, b) = (Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
        assert!((eye.edge(a, b) - 8.0).abs() < 1e-4, "{}", eye.edge(a, b));
        assert_eq!(eye.edge(a, b).to_bits(), eye.edge(b, a).to_bits(), "both directions");
        let far = Vec3::new(1e6, 0.0, 0.0);
        assert_eq!(eye.edge(far, far).to_bits(), 1.0_f32.to_bits(), "at least 1");
    }

    #[test]
    fn balls_beside_the_picture_are_outside() {
        let eye = eye(LevelOfDetail::default());
        assert!(!eye.is_outside(Vec3::ZERO, 1.0), "in front");
        assert!(eye.is_outside(Vec3::new(0.0, 0.0, 20.0), 1.0), "behind");
        assert!(eye.is_outside(Vec3::new(30.0, 0.0, 0.0), 1.0), "to the right");
        assert!(!eye.is_outside(Vec3::new(30.0, 0.0, 0.0), 25.0), "it reaches into the picture");
    }
}

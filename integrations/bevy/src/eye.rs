//! The view of a surface on the CPU, with the WGSL's `tess_edge` and `tess_is_unseen` in Rust.

use crate::detail::LevelOfDetail;
use bevy::ecs::prelude::*;
use bevy::light::{DirectionalLight, PointLight, SpotLight};
use bevy::math::{Affine3A, Mat4, Vec3, Vec4, Vec4Swizzles};
use bevy::transform::components::GlobalTransform;
use tess_surface::{culling, factors, glam};

/// The lights that cast shadows. Patches between them and the picture are not culled.
#[derive(Clone, Debug, Default, Resource)]
pub(crate) struct Casting {
    /// Directions towards the directional lights.
    toward: Vec<Vec3>,
    /// Whether there are point lights or spot lights.
    is_near: bool,
}

pub(crate) fn find_casting(
    mut casting: ResMut<Casting>,
    suns: Query<(&DirectionalLight, &GlobalTransform)>,
    points: Query<&PointLight>,
    spots: Query<&SpotLight>,
) {
    let suns = suns.iter().filter(|(sun, _)| sun.shadow_maps_enabled);
    casting.toward = suns.map(|(_, transform)| transform.back().into()).collect();
    casting.is_near = points.iter().any(|light| light.shadow_maps_enabled)
        || spots.iter().any(|light| light.shadow_maps_enabled);
}

impl Casting {
    /// The planes of a camera's picture, without those beyond which a shadow caster can be.
    fn planes(&self, clip_from_world: Mat4) -> [Vec4; 6] {
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_world.row(row));
        [w + x, w - x, w + y, w - y, z, w - z].map(|plane| {
            let is_beyond = |toward: &Vec3| plane.xyz().dot(*toward) < 0.0;
            if self.is_near || self.toward.iter().any(is_beyond) { Vec4::W } else { plane }
        })
    }
}

/// View and size of a camera's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub(crate) clip_from_world: Mat4,
    pub(crate) eye: Vec3,
    /// The size in pixels of a length of 1 at distance 1; with an orthographic projection, at any
    /// distance.
    pub(crate) pixels_per_unit: f32,
    pub(crate) is_orthographic: bool,
    /// The planes of [`Casting::planes`].
    pub(crate) planes: [Vec4; 6],
}

impl View {
    /// The view of a camera whose picture is `height` pixels high.
    pub(crate) fn new(
        world_from_view: &GlobalTransform,
        clip_from_view: Mat4,
        height: u32,
        casting: &Casting,
    ) -> Self {
        let clip_from_world = clip_from_view * Mat4::from(world_from_view.affine().inverse());
        Self {
            clip_from_world,
            eye: world_from_view.translation(),
            pixels_per_unit: 0.5 * height as f32 * clip_from_view.y_axis.y.abs(),
            is_orthographic: clip_from_view.w_axis.w == 1.0,
            planes: casting.planes(clip_from_world),
        }
    }
}

/// A camera, and the entity that it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye<'a> {
    pub(crate) view: View,
    pub(crate) world_from_local: Affine3A,
    pub(crate) rule: LevelOfDetail,
    pub(crate) values: &'a [f32],
}

impl Eye<'_> {
    /// A value of the entity in this frame; 0 if it has fewer.
    #[must_use]
    pub fn value(&self, n: usize) -> f32 {
        self.values.get(n).copied().unwrap_or(0.0)
    }

    /// A place of the entity in world space.
    #[must_use]
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        self.world_from_local.transform_point3(local)
    }

    /// The factor of an edge between two places in world space, by the entity's level of detail: 1
    /// to 64, and 1 for NaN. The same in both directions.
    #[must_use]
    pub fn edge(&self, a: Vec3, b: Vec3) -> f32 {
        let View { eye, pixels_per_unit, is_orthographic, .. } = self.view;
        let (ends, eye) = ([a, b].map(of_surface), of_surface(eye));
        match self.rule {
            LevelOfDetail::Uniform(factor) => factors::clamp_factor(factor),
            LevelOfDetail::Pixels(pixels) if is_orthographic => {
                factors::quotient(a.distance(b) * pixels_per_unit, pixels)
            }
            LevelOfDetail::Pixels(pixels) => {
                factors::edge_by_screen_size(ends, eye, pixels_per_unit, pixels)
            }
            LevelOfDetail::Distance(scale) => factors::edge_by_distance(ends, eye, scale),
        }
    }

    /// Whether the camera sees neither a ball in world space nor its shadow.
    #[must_use]
    pub fn is_unseen(&self, center: Vec3, radius: f32) -> bool {
        let plane_of = |plane: Vec4| glam::Vec4::from_array(plane.to_array());
        let center = of_surface(center);
        self.view.planes.iter().any(|&plane| culling::is_behind(plane_of(plane), center, radius))
    }
}

/// The vector in the version of glam that tess-surface uses.
fn of_surface(v: Vec3) -> glam::Vec3 {
    glam::Vec3::from_array(v.to_array())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use bevy::camera::{CameraProjection, PerspectiveProjection};
    use bevy::math::Quat;

    /// Looks along -z from (0, 0, 10), 90 degrees high, 400 pixels.
    pub(crate) fn eye(rule: LevelOfDetail, casting: &Casting) -> Eye<'static> {
        let camera = GlobalTransform::from(Affine3A::from_rotation_translation(
            Quat::IDENTITY,
            Vec3::new(0.0, 0.0, 10.0),
        ));
        let fov = core::f32::consts::FRAC_PI_2;
        let projection = PerspectiveProjection { fov, aspect_ratio: 1.0, ..Default::default() };
        let clip_from_view = projection.get_clip_from_view();
        let view = View::new(&camera, clip_from_view, 400, casting);
        Eye { view, world_from_local: Affine3A::IDENTITY, rule, values: &[] }
    }

    #[test]
    fn edges_have_segments_of_so_many_pixels() {
        let eye = eye(LevelOfDetail::Pixels(5.0), &Casting::default());
        // A length of 1 at distance 10 has 20 pixels.
        let (a, b) = (Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
        assert!((eye.edge(a, b) - 8.0).abs() < 1e-4, "{}", eye.edge(a, b));
        assert_eq!(eye.edge(a, b).to_bits(), eye.edge(b, a).to_bits(), "both directions");
        let far = Vec3::new(1e6, 0.0, 0.0);
        assert_eq!(eye.edge(far, far).to_bits(), 1.0_f32.to_bits(), "at least 1");
    }

    #[test]
    fn balls_beside_the_picture_are_unseen_but_for_their_shadows() {
        let (right, behind) = (Vec3::new(30.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 20.0));
        let unseen = |toward: &[Vec3], is_near| {
            let casting = Casting { toward: toward.to_vec(), is_near };
            let eye = eye(LevelOfDetail::default(), &casting);
            [Vec3::ZERO, right, -right, behind].map(|ball| eye.is_unseen(ball, 1.0))
        };
        assert_eq!(unseen(&[], false), [false, true, true, true], "without shadows");
        assert_eq!(unseen(&[Vec3::X], false), [false, false, true, true], "from the right");
        assert_eq!(unseen(&[Vec3::Z], false), [false; 4], "from behind");
        assert_eq!(unseen(&[Vec3::X, -Vec3::X], false), [false, false, false, true], "two");
        assert_eq!(unseen(&[Vec3::NEG_Z], false), [false, true, true, true], "from ahead");
        assert_eq!(unseen(&[], true), [false; 4], "from somewhere");
        let eye = eye(LevelOfDetail::default(), &Casting::default());
        assert!(!eye.is_unseen(right, 25.0), "it reaches into the picture");
    }
}

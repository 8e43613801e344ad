//! A camera.

use glam::{Mat4, Vec3};

/// The place, the direction and the width of a view.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    pub(crate) eye: Vec3,
    pub(crate) target: Vec3,
    /// The upward direction in the world.
    pub(crate) up: Vec3,
    /// 1 / tan(half of the vertical field of view).
    pub(crate) zoom: f32,
}

const NEAR: f32 = 0.05;
const FAR: f32 = 500.0;

impl Camera {
    /// The matrix from world to clip space, for a picture of this aspect ratio (width over height);
    /// z is 0 at the near plane and w at the far plane.
    pub(crate) fn clip_from_world(&self, aspect: f32) -> Mat4 {
        let forward = (self.target - self.eye).normalize_or(Vec3::Z);
        let right = forward.cross(self.up).normalize_or(Vec3::X);
        let row = |axis: Vec3| axis.extend(-axis.dot(self.eye));
        let depth = row(forward);
        let mut far = depth * (FAR / (FAR - NEAR));
        far.w -= NEAR * FAR / (FAR - NEAR);
        Mat4::from_rows(
            row(right) * (self.zoom / aspect),
            row(right.cross(forward)) * self.zoom,
            far,
            depth,
        )
    }
}

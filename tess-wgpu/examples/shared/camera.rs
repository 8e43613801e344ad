//! A camera.

use glam::{Mat4, Vec3};

/// Where somebody looks, and how wide.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    pub(crate) eye: Vec3,
    pub(crate) target: Vec3,
    /// Which way is up in the world.
    pub(crate) up: Vec3,
    /// 1 / tan(half of the vertical field of view).
    pub(crate) zoom: f32,
}

const NEAR: f32 = 0.05;
const FAR: f32 = 500.0;

impl Camera {
    /// World to clip space, for a picture of this width over height; z is 0 near and w far.
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

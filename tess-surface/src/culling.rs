//! Tests that cull a patch before it is tessellated. An invisible patch gets factors of 0.
//!
//! tess-gpu's `surfaces::CULLING` has the same functions in WGSL.

use glam::{Mat4, Vec3, Vec4, Vec4Swizzles};

/// Whether a ball is wholly on the negative side of a plane, the points p with `plane.xyz . p +
/// plane.w < 0`. `plane.xyz` may have any length except 0.
#[must_use]
pub fn is_behind(plane: Vec4, center: Vec3, radius: f32) -> bool {
    let normal = plane.xyz();
    normal.dot(center) + plane.w < -radius * normal.length()
}

/// Whether a ball is wholly outside one of the six planes of a projection with z from 0 to w, as in
/// Direct3D, Vulkan, Metal and WebGPU. The ball must contain the whole patch, including its
/// displacement.
///
/// A ball near a corner of the view can be outside the view without being outside any one plane;
/// the result is then false.
#[must_use]
pub fn is_outside(clip_from_world: &Mat4, center: Vec3, radius: f32) -> bool {
    let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_world.row(row));
    [w + x, w - x, w + y, w - y, z, w - z].into_iter().any(|plane| is_behind(plane, center, radius))
}

/// Whether all of a surface faces away from the eye. The surface is inside a ball, and its normals
/// are within an angle of less than 90 degrees of the unit vector `axis`; `sine` is the sine of
/// that angle.
#[must_use]
pub fn faces_away(center: Vec3, radius: f32, axis: Vec3, sine: f32, eye: Vec3) -> bool {
    let seen = center - eye;
    seen.dot(axis) > sine * crate::math::length(seen) + radius
}

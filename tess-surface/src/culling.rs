//! Tests that cull a patch before it is tessellated. A patch that nobody sees gets factors of 0.
//!
//! As WGSL, tess-gpu's `surfaces::CULLING` has the same functions.

use glam::{Mat4, Vec3, Vec4, Vec4Swizzles};

/// Whether a ball is wholly on the negative side of a plane: the points p with
/// `plane.xyz . p + plane.w < 0`. `plane.xyz` has any length but 0.
#[must_use]
pub fn is_behind(plane: Vec4, center: Vec3, radius: f32) -> bool {
    let normal = plane.xyz();
    normal.dot(center) + plane.w < -radius * normal.length()
}

/// Whether a ball is wholly outside one of the six planes of a projection with z from 0 to w, as in
/// Direct3D, Vulkan, Metal and WebGPU. The ball must hold the whole patch, its displacement
/// included.
///
/// A ball near a corner of the view can be outside without being outside one plane; the answer is
/// then no.
#[must_use]
pub fn is_outside(clip_from_world: &Mat4, center: Vec3, radius: f32) -> bool {
    let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_world.row(row));
    [w + x, w - x, w + y, w - y, z, w - z].into_iter().any(|plane| is_behind(plane, center, radius))
}

/// Whether all of a surface turns its back to the eye. The surface lies in a ball, and its normals
/// are within an angle of the unit vector `axis`, less than 90 degrees; `sine` is that angle's
/// sine.
#[must_use]
pub fn faces_away(center: Vec3, radius: f32, axis: Vec3, sine: f32, eye: Vec3) -> bool {
    let seen = center - eye;
    seen.dot(axis) > sine * crate::math::length(seen) + radius
}

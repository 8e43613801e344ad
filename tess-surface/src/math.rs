//! Small vector operations, with every rounding spelled out.

use crate::error::MAX_COORDINATE;
use crate::lanes::V3;
use glam::{Vec3, Vec4};

/// The point that a homogeneous point stands for; exact for weight 1.
pub(crate) fn project(point: Vec4) -> Vec3 {
    point.truncate() / point.w
}

/// The same point without negative zeros, so that equal points have equal bits.
pub(crate) fn plain_zero(point: Vec3) -> Vec3 {
    point + Vec3::ZERO
}

/// Integers that sort as the coordinates do and are equal where those are; -0 counts as 0.
pub(crate) fn order_key(point: Vec4) -> [i32; 4] {
    let total_order = |x: f32| {
        let bits = (x + 0.0).to_bits().cast_signed();
        bits ^ ((bits >> 31) & i32::MAX)
    };
    (point + Vec4::ZERO).to_array().map(total_order)
}

/// Whether no coordinate is beyond [`MAX_COORDINATE`]; NaN is.
pub(crate) fn is_in_range(coordinates: &[f32]) -> bool {
    coordinates.iter().all(|coordinate| coordinate.abs() <= MAX_COORDINATE)
}

/// The unit vector of `v`; `None` where the length is zero, overflows or is NaN.
pub(crate) fn unit(v: Vec3) -> Option<Vec3> {
    existing(V3::<f32>::from(v).unit())
}

/// A vector with its bits of existence, as [`V3::unit`] gives it.
pub(crate) fn existing((v, exists): (V3<f32>, f32)) -> Option<Vec3> {
    (exists.to_bits() != 0).then(|| v.to_vec3())
}

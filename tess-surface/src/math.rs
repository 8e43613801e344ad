//! Small vector operations with defined rounding.

use crate::error::MAX_COORDINATE;
use core::ops::{Add, Mul, Sub};
use glam::{Vec3, Vec4};

/// The point that a homogeneous point represents; exact for weight 1.
#[inline(always)]
pub(crate) fn project(point: Vec4) -> Vec3 {
    point.truncate() / point.w
}

/// The same point without negative zeros, so that equal points have equal bits.
#[inline(always)]
pub(crate) fn plain_zero(point: Vec3) -> Vec3 {
    point + Vec3::ZERO
}

/// Integers with the order of the coordinates, equal if the coordinates are equal; -0 counts as 0.
pub(crate) fn order_key(point: Vec4) -> [i32; 4] {
    let total_order = |x: f32| {
        let bits = (x + 0.0).to_bits().cast_signed();
        bits ^ ((bits >> 31) & i32::MAX)
    };
    (point + Vec4::ZERO).to_array().map(total_order)
}

/// Whether no coordinate is beyond [`MAX_COORDINATE`]. NaN counts as beyond.
pub(crate) fn is_in_range(coordinates: &[f32]) -> bool {
    coordinates.iter().all(|coordinate| coordinate.abs() <= MAX_COORDINATE)
}

/// The square root, correctly rounded.
#[inline(always)]
pub(crate) fn sqrt(x: f32) -> f32 {
    // The standard library's square root is one instruction, also in vectors.
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    libm::sqrtf(x)
}

/// The nearest integer, ties to even, like `libm::rintf`, but in operations that vectors have.
#[inline(always)]
pub(crate) fn round(x: f32) -> f32 {
    // Numbers of at least 2^23 are integers, so adding 2^23 to a smaller number rounds it to an
    // integer.
    const INTEGERS: f32 = 8_388_608.0;
    let nearest = ((x.abs() + INTEGERS) - INTEGERS).copysign(x);
    if x.abs() < INTEGERS { nearest } else { x }
}

/// The greatest integer that is not above `x`, like `libm::floorf`, but in operations that vectors
/// have.
#[inline(always)]
pub(crate) fn floor(x: f32) -> f32 {
    let nearest = round(x);
    nearest - if nearest > x { 1.0 } else { 0.0 }
}

/// The length of a vector.
#[inline(always)]
pub(crate) fn length(v: Vec3) -> f32 {
    sqrt(v.dot(v))
}

/// One of two vectors, without a branch.
#[inline(always)]
pub(crate) fn select(condition: bool, one: Vec3, other: Vec3) -> Vec3 {
    Vec3::new(
        if condition { one.x } else { other.x },
        if condition { one.y } else { other.y },
        if condition { one.z } else { other.z },
    )
}

/// The unit vector of `v`; `None` if `v` is zero, infinite or NaN.
pub(crate) fn unit(v: Vec3) -> Option<Vec3> {
    existing(unit_or_not(v))
}

/// A vector, if it exists.
pub(crate) fn existing((v, exists): (Vec3, bool)) -> Option<Vec3> {
    exists.then_some(v)
}

/// The unit vector of `v`, and whether there is one, without a branch.
#[inline(always)]
pub(crate) fn unit_or_not(v: Vec3) -> (Vec3, bool) {
    // Scaled first, so that the squares of tiny and huge vectors do not underflow or overflow.
    let largest = v.x.abs().max(v.y.abs().max(v.z.abs()));
    let scaled = v / largest;
    let reciprocal = 1.0 / sqrt(scaled.dot(scaled));
    (scaled * reciprocal, is_positive(largest) & is_positive(reciprocal))
}

/// The unit vector of du x dv, and whether there is one, without a branch. There is none if one of
/// the two is zero or they are parallel to within 2^-15.
#[inline(always)]
pub(crate) fn normal_or_not(du: Vec3, dv: Vec3) -> (Vec3, bool) {
    const PARALLEL: f32 = 1.0 / (1u32 << 30) as f32;
    let ((du, u_exists), (dv, v_exists)) = (unit_or_not(du), unit_or_not(dv));
    let cross = du.cross(dv);
    let (normal, exists) = unit_or_not(cross);
    let area = cross.dot(cross);
    (normal, exists & (area > PARALLEL) & (area < f32::INFINITY) & u_exists & v_exists)
}

/// Whether a number is above zero and finite.
#[inline(always)]
fn is_positive(x: f32) -> bool {
    (x > 0.0) & (x < f32::INFINITY)
}

/// Values that can be interpolated.
pub(crate) trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f32, Output = Self>
{
}

impl<V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f32, Output = V>> Vector for V {}

/// `a + (b - a) t`: exact at `t = 0`, and if `a` equals `b`.
#[inline(always)]
pub(crate) fn lerp<V: Vector>(a: V, b: V, t: f32) -> V {
    a + (b - a) * t
}

/// Point and derivative of a cubic at `t`, by repeated linear interpolation.
///
/// If all control points are equal, the result is that point exactly, because `a + (a - a) t` is
/// `a`.
#[inline(always)]
pub(crate) fn de_casteljau<V: Vector>([a, b, c, d]: [V; 4], t: f32) -> (V, V) {
    let (ab, bc, cd) = (lerp(a, b, t), lerp(b, c, t), lerp(c, d, t));
    let (abc, bcd) = (lerp(ab, bc, t), lerp(bc, cd, t));
    // The derivative is made from differences of control points, which keeps its relative precision
    // where the curve nearly stands still.
    let derivative = lerp(lerp(b - a, c - b, t), lerp(c - b, d - c, t), t) * 3.0;
    (lerp(abc, bcd, t), derivative)
}

/// A homogeneous point, (w x, w y, w z) and w, as four separate numbers. A [`Vec4`] would fill a
/// register of the processor, and loops over lanes could not be vectorized.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Homogeneous {
    pub(crate) xyz: Vec3,
    pub(crate) w: f32,
}

impl From<Vec4> for Homogeneous {
    #[inline(always)]
    fn from(v: Vec4) -> Self {
        Self { xyz: v.truncate(), w: v.w }
    }
}

impl Add for Homogeneous {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { xyz: self.xyz + other.xyz, w: self.w + other.w }
    }
}

impl Sub for Homogeneous {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { xyz: self.xyz - other.xyz, w: self.w - other.w }
    }
}

impl Mul<f32> for Homogeneous {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f32) -> Self {
        Self { xyz: self.xyz * factor, w: self.w * factor }
    }
}

#[cfg(test)]
mod tests {
    use super::{floor, round};

    #[test]
    fn roundings_are_those_of_libm() {
        let near = [0.0, 0.5, 1.0, 2.5, 8_388_607.5, 8_388_608.0, 16_777_216.0, f32::INFINITY];
        let near =
            near.map(f32::to_bits).into_iter().flat_map(|bits| bits.saturating_sub(2)..bits + 3);
        let spread = (0..=u32::MAX).step_by(65_521);
        for bits in near.chain(spread).flat_map(|bits| [bits, bits ^ 1 << 31]) {
            let x = f32::from_bits(bits);
            for (ours, theirs) in [(floor(x), libm::floorf(x)), (round(x), libm::rintf(x))] {
                let same = ours.to_bits() == theirs.to_bits() || (ours.is_nan() && theirs.is_nan());
                assert!(same, "{x:e}: {ours:e} {theirs:e}");
            }
        }
    }
}

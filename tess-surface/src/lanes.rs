//! Formulas for one point or for eight points side by side.
//!
//! A formula is written once, over [`Real`]: one number, or eight in the lanes of a vector. Every lane has
//! the bits that one number has, because both run the same additions, multiplications,
//! divisions and square roots, each correctly rounded. Nothing here fuses two of them.

use crate::frame::Tangents;
use core::ops::{Add, Div, Mul, Sub};
use glam::{Vec3, Vec4};
use wide::f32x8;

/// Points that are evaluated side by side.
pub(crate) const LANES: usize = 8;

/// One number, or one number for each of eight points.
pub(crate) trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + From<f32>
{
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    fn max(self, other: Self) -> Self;

    /// All bits set where this is above `low` and below `high`, else none; so for NaN.
    fn between(self, low: f32, high: f32) -> Self;

    /// The bits that both have.
    fn and(self, other: Self) -> Self;
}

impl Real for f32 {
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }

    fn abs(self) -> Self {
        Self::abs(self)
    }

    fn max(self, other: Self) -> Self {
        Self::max(self, other)
    }

    fn between(self, low: f32, high: f32) -> Self {
        Self::from_bits(if self > low && self < high { u32::MAX } else { 0 })
    }

    fn and(self, other: Self) -> Self {
        Self::from_bits(self.to_bits() & other.to_bits())
    }
}

impl Real for f32x8 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    /// Where one is NaN the other; a unit vector of either is none.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::max(self, other)
    }

    #[inline(always)]
    fn between(self, low: f32, high: f32) -> Self {
        self.simd_gt(Self::splat(low)) & self.simd_lt(Self::splat(high))
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self & other
    }
}

/// A vector in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct V3<T> {
    pub(crate) x: T,
    pub(crate) y: T,
    pub(crate) z: T,
}

/// A homogeneous point: (w x, w y, w z) and w.
#[derive(Clone, Copy, Debug)]
pub(crate) struct V4<T> {
    pub(crate) xyz: V3<T>,
    pub(crate) w: T,
}

impl<T: Real> From<Vec3> for V3<T> {
    #[inline(always)]
    fn from(v: Vec3) -> Self {
        Self { x: v.x.into(), y: v.y.into(), z: v.z.into() }
    }
}

impl<T: Real> From<Vec4> for V4<T> {
    #[inline(always)]
    fn from(v: Vec4) -> Self {
        Self { xyz: v.truncate().into(), w: v.w.into() }
    }
}

impl<T: Real> Add for V3<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<T: Real> Sub for V3<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<T: Real> Mul<T> for V3<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl<T: Real> Div<T> for V3<T> {
    type Output = Self;

    #[inline(always)]
    fn div(self, divisor: T) -> Self {
        Self { x: self.x / divisor, y: self.y / divisor, z: self.z / divisor }
    }
}

impl<T: Real> Add for V4<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { xyz: self.xyz + other.xyz, w: self.w + other.w }
    }
}

impl<T: Real> Sub for V4<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { xyz: self.xyz - other.xyz, w: self.w - other.w }
    }
}

impl<T: Real> Mul<T> for V4<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self { xyz: self.xyz * factor, w: self.w * factor }
    }
}

impl<T: Real> V3<T> {
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    /// The unit vector, and all bits set where there is one: where the length is not zero, does not
    /// overflow and is not NaN.
    #[inline(always)]
    pub(crate) fn unit(self) -> (Self, T) {
        // Scaled first, so that neither tiny nor huge vectors are lost in the squares.
        let largest = self.x.abs().max(self.y.abs().max(self.z.abs()));
        let scaled = self / largest;
        let reciprocal = T::from(1.0) / scaled.dot(scaled).sqrt();
        let exists =
            largest.between(0.0, f32::INFINITY).and(reciprocal.between(0.0, f32::INFINITY));
        (scaled * reciprocal, exists)
    }
}

/// Position and tangents, as [`Frame`](crate::Frame).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frames<T> {
    pub(crate) position: V3<T>,
    pub(crate) du: V3<T>,
    pub(crate) dv: V3<T>,
}

/// [`Tangents::normal`](crate::Tangents::normal), and all bits set where there is one.
#[inline(always)]
pub(crate) fn normal<T: Real>(du: V3<T>, dv: V3<T>) -> (V3<T>, T) {
    const PARALLEL: f32 = 1.0 / (1u32 << 30) as f32;
    let ((du, u_exists), (dv, v_exists)) = (du.unit(), dv.unit());
    let cross = du.cross(dv);
    let (normal, exists) = cross.unit();
    let spans = cross.dot(cross).between(PARALLEL, f32::INFINITY);
    (normal, exists.and(spans).and(u_exists).and(v_exists))
}

impl<T: Real> V3<T> {
    /// The vector without negative zeros.
    #[inline(always)]
    pub(crate) fn plain_zero(self) -> Self {
        self + Vec3::ZERO.into()
    }
}

impl Frames<f32> {
    pub(crate) const fn tangents(&self) -> Tangents {
        Tangents { du: self.du.to_vec3(), dv: self.dv.to_vec3() }
    }
}

impl Frames<f32x8> {
    /// The tangents, point by point.
    pub(crate) fn all_tangents(&self) -> [Tangents; LANES] {
        let (du, dv) = (self.du.to_array(), self.dv.to_array());
        core::array::from_fn(|lane| Tangents { du: du[lane], dv: dv[lane] })
    }
}

impl V3<f32> {
    pub(crate) const fn to_vec3(self) -> Vec3 {
        Vec3::new(self.x, self.y, self.z)
    }
}

impl V3<f32x8> {
    /// The vectors, point by point.
    #[inline(always)]
    pub(crate) fn to_array(self) -> [Vec3; LANES] {
        let (x, y, z) = (self.x.to_array(), self.y.to_array(), self.z.to_array());
        core::array::from_fn(|lane| Vec3::new(x[lane], y[lane], z[lane]))
    }
}

/// What can be interpolated.
pub(crate) trait Vector<T>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<T, Output = Self>
{
}

impl<T, V: Copy + Add<Output = V> + Sub<Output = V> + Mul<T, Output = V>> Vector<T> for V {}

/// `a + (b - a) t`: exact at `t = 0`, and where `a` equals `b`.
#[inline(always)]
pub(crate) fn lerp<T: Real, V: Vector<T>>(a: V, b: V, t: T) -> V {
    a + (b - a) * t
}

/// Point and derivative of a cubic at `t`, by repeated linear interpolation.
///
/// Equal control points give that very point, as `a + (a - a) t` is `a`.
#[inline(always)]
pub(crate) fn de_casteljau<T: Real, V: Vector<T>>([a, b, c, d]: [V; 4], t: T) -> (V, V) {
    let (ab, bc, cd) = (lerp(a, b, t), lerp(b, c, t), lerp(c, d, t));
    let (abc, bcd) = (lerp(ab, bc, t), lerp(bc, cd, t));
    // The derivative from differences of control points, which keeps its relative precision
    // where the curve nearly stands still.
    let derivative = lerp(lerp(b - a, c - b, t), lerp(c - b, d - c, t), t) * T::from(3.0);
    (lerp(abc, bcd, t), derivative)
}

//! Bicubic Bezier patches, polynomial and rational, with exact partial derivatives.
//!
//! G. Farin, *Curves and Surfaces for CAGD*, 5th edition, 2002: tensor product patches and their
//! derivatives (chapter 14), rational patches (chapter 16).

use crate::curve::Curve;
use crate::frame::{Frame, Frames, Tangents};
use crate::math::{Homogeneous, Vector, de_casteljau, lerp, plain_zero, project};
use glam::{Vec3, Vec4};

/// A bicubic patch over the unit square: `points[row][column]`, rows along v, columns along u.
///
/// Points are homogeneous, (w x, w y, w z, w) with w > 0. A polynomial patch has w = 1 everywhere;
/// it evaluates to the same bits as a rational patch with these weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BezierPatch {
    /// The control points.
    pub points: [[Vec4; 4]; 4],
}

/// The homogeneous point and its derivatives up to the second.
#[derive(Clone, Copy)]
struct Jet {
    s: Vec4,
    u: Vec4,
    v: Vec4,
    uu: Vec4,
    uv: Vec4,
    vv: Vec4,
}

/// The control points of a patch, in the form that evaluation uses.
#[derive(Debug)]
pub(crate) enum Net {
    Polynomial([[Vec3; 4]; 4]),
    Rational([[Homogeneous; 4]; 4]),
}

/// The control points of a patch whose weights are all 1.
impl Frames for [[Vec3; 4]; 4] {
    #[inline(always)]
    fn frame(&self, u: f32, v: f32) -> Frame {
        let (position, du, dv) = tensor(self, u, v);
        Frame { position: plain_zero(position), tangents: Tangents { du, dv } }
    }
}

/// The control points of any patch.
impl Frames for [[Homogeneous; 4]; 4] {
    #[inline(always)]
    fn frame(&self, u: f32, v: f32) -> Frame {
        let (s, su, sv) = tensor(self, u, v);
        let position = s.xyz / s.w;
        let du = (su.xyz - position * su.w) / s.w;
        let dv = (sv.xyz - position * sv.w) / s.w;
        Frame { position: plain_zero(position), tangents: Tangents { du, dv } }
    }
}

impl BezierPatch {
    /// The polynomial patch with these control points.
    #[must_use]
    pub fn polynomial(points: [[Vec3; 4]; 4]) -> Self {
        Self { points: points.map(|row| row.map(|point| point.extend(1.0))) }
    }

    /// The rational patch with these control points in space and their weights w > 0.
    #[must_use]
    pub fn rational(points: [[Vec3; 4]; 4], weights: [[f32; 4]; 4]) -> Self {
        let mut homogeneous = [[Vec4::ZERO; 4]; 4];
        for (row, (points, weights)) in homogeneous.iter_mut().zip(points.iter().zip(weights)) {
            for (out, (&point, weight)) in row.iter_mut().zip(points.iter().zip(weights)) {
                *out = (point * weight).extend(weight);
            }
        }
        Self { points: homogeneous }
    }

    /// The boundary curves u = 0, v = 0, u = 1, v = 1, each in the direction of its coordinate.
    #[must_use]
    pub fn boundary(&self) -> [Curve; 4] {
        let column = |i: usize| Curve::Cubic(self.points.map(|row| row[i]));
        let [first, _, _, last] = self.points;
        [column(0), Curve::Cubic(first), column(3), Curve::Cubic(last)]
    }

    /// Position and partial derivatives at (u, v) in the unit square.
    #[must_use]
    pub fn frame(&self, u: f32, v: f32) -> Frame {
        match self.net() {
            Net::Polynomial(net) => net.frame(u, v),
            Net::Rational(net) => net.frame(u, v),
        }
    }

    /// The control points, in the form that evaluation uses.
    pub(crate) fn net(&self) -> Net {
        if self.is_polynomial() {
            Net::Polynomial(self.points.map(|row| row.map(Vec4::truncate)))
        } else {
            Net::Rational(self.points.map(|row| row.map(Homogeneous::from)))
        }
    }

    /// Whether all weights are 1.
    fn is_polynomial(&self) -> bool {
        let weights = self.points.as_flattened().iter().map(|point| point.w.to_bits());
        weights.fold(0, |others, weight| others | (weight ^ 1.0f32.to_bits())) == 0
    }

    /// The unit normal, on the side from which the turn from u to v is counter-clockwise.
    ///
    /// Where the partial derivatives do not span a plane, for example at an edge that is collapsed
    /// to a point, it is the limit of the normals along a way from inside the patch.
    #[must_use]
    pub fn normal(&self, u: f32, v: f32) -> Vec3 {
        let tangents = self.frame(u, v).tangents;
        tangents.normal().or_else(|| self.limit_normal(u, v)).unwrap_or(Vec3::Z)
    }

    /// The first term of the normal's expansion along an inward direction that does not vanish.
    ///
    /// If N = Su x Sv is 0 at (u, v), the first-order term along (a, b), which points into the
    /// patch, is a (Suu x Sv + Su x Suv) + b (Suv x Sv + Su x Svv).
    pub(crate) fn limit_normal(&self, u: f32, v: f32) -> Option<Vec3> {
        let jet = self.jet(u, v);
        let inwards = |x: f32| if x < 0.5 { 1.0 } else { -1.0 };
        let first_order = jet.normal_derivative(inwards(u), inwards(v));
        crate::math::unit(first_order).or_else(|| {
            // That vanishes too: take the normal a little further inside.
            let nearer = |x: f32| x + (0.5 - x) / 64.0;
            self.frame(nearer(u), nearer(v)).tangents.normal()
        })
    }

    fn jet(&self, u: f32, v: f32) -> Jet {
        let second =
            |[a, b, c, d]: [Vec4; 4], t: f32| lerp((c - b) - (b - a), (d - c) - (c - b), t) * 6.0;
        let rows = self.points.map(|row| de_casteljau(row, u));
        let (values, slopes) = (rows.map(|(point, _)| point), rows.map(|(_, slope)| slope));
        let (s, sv) = de_casteljau(values, v);
        let (su, suv) = de_casteljau(slopes, v);
        let (suu, _) = de_casteljau(self.points.map(|row| second(row, u)), v);
        Jet { s, u: su, v: sv, uu: suu, uv: suv, vv: second(values, v) }
    }
}

impl Jet {
    /// The derivative of Su x Sv along (a, b), by the quotient rule because weights may vary.
    fn normal_derivative(&self, a: f32, b: f32) -> Vec3 {
        let position = project(self.s);
        let du = quotient(self.u, self.s, position);
        let dv = quotient(self.v, self.s, position);
        let w = self.s.w;
        let duu = (self.uu.truncate() - position * self.uu.w - du * (2.0 * self.u.w)) / w;
        let dvv = (self.vv.truncate() - position * self.vv.w - dv * (2.0 * self.v.w)) / w;
        let duv = (self.uv.truncate() - position * self.uv.w - du * self.v.w - dv * self.u.w) / w;
        (duu.cross(dv) + du.cross(duv)) * a + (duv.cross(dv) + du.cross(dvv)) * b
    }
}

/// Point and partial derivatives of a tensor product of cubics.
#[inline(always)]
fn tensor<V: Vector>([a, b, c, d]: &[[V; 4]; 4], u: f32, v: f32) -> (V, V, V) {
    let (a, da) = de_casteljau(*a, u);
    let (b, db) = de_casteljau(*b, u);
    let (c, dc) = de_casteljau(*c, u);
    let (d, dd) = de_casteljau(*d, u);
    let (s, sv) = de_casteljau([a, b, c, d], v);
    (s, de_casteljau([da, db, dc, dd], v).0, sv)
}

/// The derivative of a projected point: (A' - w' S) / w.
fn quotient(derivative: Vec4, s: Vec4, position: Vec3) -> Vec3 {
    (derivative.truncate() - position * derivative.w) / s.w
}

//! Cubic curves in homogeneous coordinates, and the direction in which they are evaluated.

use crate::math::{de_casteljau, order_key, plain_zero, project};
use glam::{Vec3, Vec4};

/// A boundary of a patch: a straight line or a cubic Bezier curve, rational or not.
///
/// A point of a polynomial curve has weight 1, and keeps it under every operation here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// The line from the first point to the second.
    Line([Vec3; 2]),
    /// The cubic with control points (w x, w y, w z, w), weights w > 0.
    Cubic([Vec4; 4]),
}

impl Curve {
    /// The polynomial cubic with these control points.
    #[must_use]
    pub fn cubic(points: [Vec3; 4]) -> Self {
        Self::Cubic(points.map(|point| point.extend(1.0)))
    }

    /// The same curve from its other end.
    #[must_use]
    pub fn reversed(self) -> Self {
        match self {
            Self::Line([a, b]) => Self::Line([b, a]),
            Self::Cubic([a, b, c, d]) => Self::Cubic([d, c, b, a]),
        }
    }

    /// The point at `t` in 0..=1. At the ends it is exactly the end control point.
    #[must_use]
    pub fn position(&self, t: f32) -> Vec3 {
        let point = match *self {
            Self::Line([a, b]) => at_end(t, a, b).unwrap_or_else(|| a + (b - a) * t),
            Self::Cubic([a, b, c, d]) => {
                project(at_end(t, a, d).unwrap_or_else(|| de_casteljau([a, b, c, d], t).0))
            }
        };
        plain_zero(point)
    }

    /// The length of the control polygon. The curve is at most as long.
    #[must_use]
    pub fn length_bound(&self) -> f32 {
        match *self {
            Self::Line([a, b]) => a.distance(b),
            Self::Cubic(points) => {
                let [a, b, c, d] = points.map(project);
                a.distance(b) + b.distance(c) + c.distance(d)
            }
        }
    }

    /// The common position of all control points; `None` if they differ.
    #[must_use]
    pub fn collapsed_to(&self) -> Option<Vec3> {
        let points = match *self {
            Self::Line([a, b]) => [a, a, b, b],
            Self::Cubic(points) => points.map(project),
        };
        points.iter().all(|&point| point == points[0]).then_some(points[0])
    }

    /// The bits of the control points, for comparing and sorting: -0 counts as 0.
    pub(crate) fn key(&self) -> [[i32; 4]; 4] {
        match *self {
            Self::Line([a, b]) => {
                [order_key(a.extend(0.0)), order_key(b.extend(0.0)), [0; 4], [0; 4]]
            }
            Self::Cubic(points) => points.map(order_key),
        }
    }
}

fn at_end<T>(t: f32, start: T, end: T) -> Option<T> {
    if t <= 0.0 {
        Some(start)
    } else if t >= 1.0 {
        Some(end)
    } else {
        None
    }
}

/// A patch's own direction along an edge, compared with the canonical one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The patch runs along the edge in canonical direction.
    Along,
    /// The patch runs against the canonical direction.
    Against,
    /// The curve is the same in both directions, so there is no canonical direction.
    Symmetric,
}

impl Direction {
    /// The canonical parameter for the patch's own parameter `t`. Exact for multiples of 2^-24.
    ///
    /// A symmetric curve is folded at its middle.
    #[must_use]
    #[inline(always)]
    pub fn canonical(self, t: f32) -> f32 {
        match self {
            Self::Along => t,
            Self::Against => 1.0 - t,
            Self::Symmetric => t.min(1.0 - t),
        }
    }
}

/// A boundary curve of a patch in canonical direction, which is the same from both sides.
///
/// The direction depends only on the control points. Patches that know nothing of each other, but
/// have equal control points forwards or backwards, therefore evaluate to equal bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The curve in canonical direction.
    pub curve: Curve,
    /// The patch's direction along it.
    pub direction: Direction,
}

impl Edge {
    /// The edge with this curve in the patch's direction.
    #[must_use]
    pub fn new(curve: Curve) -> Self {
        if let Some(point) = curve.collapsed_to() {
            let curve = Curve::Line([point, point]);
            return Self { curve, direction: Direction::Symmetric };
        }
        let reversed = curve.reversed();
        match curve.key().cmp(&reversed.key()) {
            core::cmp::Ordering::Less => Self { curve, direction: Direction::Along },
            core::cmp::Ordering::Equal => Self { curve, direction: Direction::Symmetric },
            core::cmp::Ordering::Greater => Self { curve: reversed, direction: Direction::Against },
        }
    }

    /// The point at the patch's own parameter `t` in 0..=1.
    #[must_use]
    pub fn position(&self, t: f32) -> Vec3 {
        self.curve.position(self.direction.canonical(t))
    }
}

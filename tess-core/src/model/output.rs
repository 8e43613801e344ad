//! The output of a patch: domain points and primitives (spec section 1).

use crate::model::fixed_point::coordinate_to_f32;
use fixed::types::U16F16;

/// A point of a patch's domain, each coordinate in 0..=1. On triangles w = 1 - u - v.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(C)]
pub struct DomainPoint {
    /// First coordinate.
    pub u: U16F16,
    /// Second coordinate.
    pub v: U16F16,
}

impl DomainPoint {
    /// A point from the bits of its 16.16 coordinates.
    #[must_use]
    pub const fn from_bits(u: u32, v: u32) -> Self {
        Self { u: U16F16::from_bits(u), v: U16F16::from_bits(v) }
    }

    /// The coordinates as binary32, exactly. Values of 256 or more, which are not coordinates, are
    /// rounded toward zero.
    #[must_use]
    pub const fn to_f32(self) -> [f32; 2] {
        [coordinate_to_f32(self.u), coordinate_to_f32(self.v)]
    }
}

/// One primitive: indices into the patch's domain points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Primitive {
    /// A point.
    Point([u32; 1]),
    /// A line segment.
    Line([u32; 2]),
    /// A triangle.
    Triangle([u32; 3]),
}

impl Primitive {
    /// How many indices the primitive has: 1, 2 or 3.
    #[must_use]
    pub const fn size(&self) -> u32 {
        match self {
            Self::Point(_) => 1,
            Self::Line(_) => 2,
            Self::Triangle(_) => 3,
        }
    }

    /// The 1, 2 or 3 indices.
    #[must_use]
    pub const fn indices(&self) -> &[u32] {
        match self {
            Self::Point(indices) => indices,
            Self::Line(indices) => indices,
            Self::Triangle(indices) => indices,
        }
    }
}

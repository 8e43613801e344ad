//! A point of a surface with its tangents.

use crate::math::{existing, normal_or_not};
use glam::Vec3;

/// The partial derivatives of a surface's position by the domain coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// The derivative by u.
    pub du: Vec3,
    /// The derivative by v. On triangles u is constant, so w decreases.
    pub dv: Vec3,
}

/// Formulas of position and tangents, without branches.
pub(crate) trait Frames {
    fn frame(&self, u: f32, v: f32) -> Frame;
}

/// A point of a surface with its tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The position.
    pub position: Vec3,
    /// The partial derivatives there.
    pub tangents: Tangents,
}

impl Tangents {
    /// The unit vector of du x dv; `None` if one of them is zero or they are parallel to within
    /// 2^-15.
    #[must_use]
    pub fn normal(&self) -> Option<Vec3> {
        existing(normal_or_not(self.du, self.dv))
    }
}

//! Bicubic Bezier patches.

use crate::eye::Eye;
use crate::shape::{CpuShape, Shape, ShapeVertex};
use bevy::camera::primitives::Aabb;
use bevy::math::Vec3;
use std::borrow::Cow;
use std::fmt;
use tess_core::{Domain, PatchFactors, QuadFactors};
use tess_surface::factors::inside_quad;
use tess_surface::glam;
use tess_surface::{BezierPatch, Surface, SurfacePatch};
use tess_wgpu::tess_gpu::surfaces;

/// The control points of a bicubic patch: rows along v, columns along u.
pub type Net = [[[f32; 3]; 4]; 4];

/// Bicubic Bezier patches. The cross product of the derivatives by u and by v points outwards.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPatches(Vec<Net>);

/// The reason why patches cannot be made.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BezierError {
    /// The list of patches is empty.
    Empty,
    /// A control point is NaN or infinite.
    NotFinite {
        /// The number of its patch.
        patch: usize,
    },
}

impl fmt::Display for BezierError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("there are no patches; give at least one"),
            Self::NotFinite { patch } => {
                write!(f, "patch {patch} has a control point that is NaN or infinite; replace it")
            }
        }
    }
}

impl std::error::Error for BezierError {}

impl BezierPatches {
    /// Makes patches of these control points. Patches that share the control points of an edge have
    /// no crack there.
    ///
    /// # Errors
    /// [`BezierError`] if there are no patches or a control point is not finite.
    pub fn new(nets: Vec<Net>) -> Result<Self, BezierError> {
        if nets.is_empty() {
            return Err(BezierError::Empty);
        }
        let is_finite = |net: &Net| net.as_flattened().as_flattened().iter().all(|x| x.is_finite());
        match nets.iter().position(|net| !is_finite(net)) {
            Some(patch) => Err(BezierError::NotFinite { patch }),
            None => Ok(Self(nets)),
        }
    }
}

impl Shape for BezierPatches {
    fn domain(&self) -> Domain {
        Domain::Quad
    }

    fn patches(&self) -> u32 {
        u32::try_from(self.0.len()).unwrap_or(u32::MAX)
    }

    /// The box of the control points.
    fn bounds(&self) -> Aabb {
        let points = self.0.as_flattened().as_flattened().iter().map(|&point| Vec3::from(point));
        let low = points.clone().fold(Vec3::MAX, Vec3::min);
        Aabb::from_min_max(low, points.fold(Vec3::MIN, Vec3::max))
    }

    fn surface(&self) -> Cow<'static, str> {
        let own = include_str!("../shaders/bezier_patches.wgsl");
        Cow::Owned([surfaces::BEZIER, own].join("\n"))
    }

    fn words(&self) -> Vec<u32> {
        let numbers = self.0.as_flattened().as_flattened().as_flattened();
        numbers.iter().map(|x| x.to_bits()).collect()
    }

    fn on_cpu(&self) -> Option<&dyn CpuShape> {
        Some(self)
    }
}

/// `bezier_patches.wgsl` in Rust.
impl CpuShape for BezierPatches {
    fn factors(&self, patch: u32, eye: &Eye) -> PatchFactors {
        let net = &self.0[patch as usize];
        let corners = [net[0][0], net[0][3], net[3][3], net[3][0]];
        let [a, b, c, d] = corners.map(|corner| eye.to_world(corner.into()));
        let edges = [eye.edge(a, d), eye.edge(a, b), eye.edge(b, c), eye.edge(d, c)];
        PatchFactors::Quad(quad_factors(edges))
    }

    fn vertices(&self, patch: u32, _: &Eye, points: &[[f32; 2]], vertices: &mut Vec<ShapeVertex>) {
        let net = self.0[patch as usize].map(|row| row.map(glam::Vec3::from));
        let patch = SurfacePatch::new(Surface::Bezier(BezierPatch::polynomial(net)));
        vertices.extend(points.iter().map(|&uv| {
            let sample = patch.sample(uv);
            ShapeVertex {
                position: sample.position.to_array(),
                normal: sample.normal.to_array(),
                uv,
                color: [1.0; 4],
            }
        }));
    }
}

/// The factors of a quad from those of its edges u = 0, v = 0, u = 1, v = 1, as `tess_quad_factors`
/// of the WGSL computes them.
#[must_use]
pub fn quad_factors(edges: [f32; 4]) -> QuadFactors {
    let ([u0, v0, u1, v1], [inside_u, inside_v]) = (edges, inside_quad(edges));
    QuadFactors { u0, v0, u1, v1, inside_u, inside_v }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LevelOfDetail;
    use crate::eye::{Casting, tests::eye};

    fn net() -> Net {
        let mut net = Net::default();
        for (number, point) in (0_u8..).zip(net.as_flattened_mut()) {
            let at = f32::from(number);
            *point = [at % 4.0 + 0.01 * at, (0.25 * at).floor(), (at * 7.0 % 5.0) - 2.0];
        }
        net
    }

    #[test]
    fn patches_agree_on_the_bits_of_their_edges() {
        // The second patch has the first's edge u = 1 as its edge v = 0.
        let first = net();
        let mut second = net();
        second[0] = first.map(|row| row[3]);
        let patches = BezierPatches::new(vec![first, second]).expect("they are finite");
        let along = |of: fn(f32) -> [f32; 2]| -> Vec<_> {
            (0..=64_u8).map(|i| of(f32::from(i) / 64.0)).collect()
        };
        let (mut one, mut other) = (Vec::new(), Vec::new());
        let eye = eye(LevelOfDetail::default(), &Casting::default());
        patches.vertices(0, &eye, &along(|t| [1.0, t]), &mut one);
        patches.vertices(1, &eye, &along(|t| [t, 0.0]), &mut other);
        let positions = |all: &[ShapeVertex]| all.iter().map(|v| v.position).collect::<Vec<_>>();
        assert_eq!(positions(&one), positions(&other), "the shared edge");
        patches.vertices(1, &eye, &along(|t| [t, 1.0 / 65536.0]), &mut one);
        assert_ne!(positions(&one[65..]), positions(&other), "the next points would be seen");
    }

    #[test]
    fn what_is_missing_is_named() {
        assert_eq!(BezierPatches::new(Vec::new()), Err(BezierError::Empty), "no patches");
        let mut broken = net();
        broken[1][2][0] = f32::NAN;
        let refused = BezierPatches::new(vec![net(), broken]);
        assert_eq!(refused, Err(BezierError::NotFinite { patch: 1 }), "the second");
    }
}

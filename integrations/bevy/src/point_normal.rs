//! Meshes of triangles with normals, which are drawn rounded.

use crate::eye::Eye;
use crate::shape::{CpuShape, Shape, ShapeVertex};
use bevy::camera::primitives::Aabb;
use bevy::math::Vec3;
use std::borrow::Cow;
use std::fmt;
use tess_core::{Domain, PatchFactors, TriangleFactors};
use tess_surface::factors::inside_triangle;
use tess_surface::glam;
use tess_surface::pn::edge_points;
use tess_surface::{PnCorner, PnTriangle, Surface, SurfacePatch};
use tess_wgpu::tess_gpu::surfaces;

/// A mesh whose triangles become point-normal triangles: curved, with smooth normals.
#[derive(Clone, Debug, PartialEq)]
pub struct PointNormalMesh {
    corners: Vec<[[f32; 3]; 2]>,
    triangles: Vec<[u32; 3]>,
}

/// The reason why a mesh cannot be made.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PointNormalError {
    /// The numbers of positions and normals differ.
    WrongNormals {
        /// The number of positions.
        positions: usize,
        /// The number of normals.
        normals: usize,
    },
    /// A triangle uses a corner that does not exist.
    NoSuchCorner {
        /// Number of the triangle.
        triangle: usize,
        /// Number of the corner.
        corner: u32,
        /// The number of corners.
        corners: usize,
    },
    /// A position or a normal is NaN or infinite.
    NotFinite {
        /// Number of the corner.
        corner: usize,
    },
    /// There are no triangles.
    Empty,
}

impl fmt::Display for PointNormalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongNormals { positions, normals } => {
                write!(
                    f,
                    "there are {positions} positions, but {normals} normals; give one normal for each position"
                )
            }
            Self::NoSuchCorner { triangle, corner, corners } => write!(
                f,
                "triangle {triangle} uses corner {corner}, but there are {corners}, numbered from 0"
            ),
            Self::NotFinite { corner } => {
                write!(f, "corner {corner} is not finite; replace NaN and infinities")
            }
            Self::Empty => f.write_str("there are no triangles; give at least one"),
        }
    }
}

impl std::error::Error for PointNormalError {}

impl PointNormalMesh {
    /// WGSL that reads such a mesh, for surfaces built on it: `pn_factors(number)` for a hull
    /// function and `pn_point(at, uv)`, position and normal in local space, for a domain function.
    #[must_use]
    pub fn functions() -> String {
        let own = include_str!("../shaders/point_normal.wgsl");
        [surfaces::BEZIER, surfaces::POINT_NORMAL, surfaces::PN_TRIANGLE, own].join("\n")
    }

    /// Makes a mesh of corners with unit normals, and of triangles that are counter-clockwise as
    /// seen from outside.
    ///
    /// # Errors
    /// [`PointNormalError`] if the corners, normals and triangles are not a mesh.
    pub fn new(
        positions: &[[f32; 3]],
        normals: &[[f32; 3]],
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, PointNormalError> {
        let (count, given) = (positions.len(), normals.len());
        if count != given {
            return Err(PointNormalError::WrongNormals { positions: count, normals: given });
        }
        if triangles.is_empty() {
            return Err(PointNormalError::Empty);
        }
        let corners: Vec<_> = positions.iter().zip(normals).map(|(&p, &n)| [p, n]).collect();
        let is_finite =
            |corner: &[[f32; 3]; 2]| corner.as_flattened().iter().all(|x| x.is_finite());
        if let Some(corner) = corners.iter().position(|corner| !is_finite(corner)) {
            return Err(PointNormalError::NotFinite { corner });
        }
        for (triangle, numbers) in triangles.iter().enumerate() {
            if let Some(&corner) = numbers.iter().find(|&&number| number as usize >= count) {
                return Err(PointNormalError::NoSuchCorner { triangle, corner, corners: count });
            }
        }
        Ok(Self { corners, triangles })
    }

    fn corner(&self, patch: u32, k: usize) -> PnCorner {
        let [position, normal] = self.corners[self.triangles[patch as usize][k] as usize];
        PnCorner { position: position.into(), normal: normal.into() }
    }

    /// The factors of a triangle by the entity's rule, as `pn_factors` of the WGSL computes them.
    #[must_use]
    pub fn factors_of(&self, patch: u32, eye: &Eye) -> TriangleFactors {
        let [a, b, c] = [0, 1, 2].map(|k| {
            let at = self.corner(patch, k).position.to_array();
            eye.to_world(Vec3::from(at))
        });
        let edges = [eye.edge(b, c), eye.edge(a, c), eye.edge(a, b)];
        let [u0, v0, w0] = edges;
        TriangleFactors { u0, v0, w0, inside: inside_triangle(edges) }
    }

    /// Positions and normals at domain points of a triangle, as `pn_point` of the WGSL computes
    /// them.
    #[must_use]
    pub fn points_of(&self, patch: u32, points: &[[f32; 2]]) -> Vec<[Vec3; 2]> {
        let corners = [0, 1, 2].map(|k| self.corner(patch, k));
        let [a, b, c] = corners;
        let edges = [edge_points(c, b), edge_points(c, a), edge_points(b, a)];
        let triangle = PnTriangle::new(corners, edges);
        let patch = SurfacePatch::new(Surface::PnTriangle(triangle));
        let of = |at: glam::Vec3| Vec3::from(at.to_array());
        let sample = |&uv: &[f32; 2]| {
            let sample = patch.sample(uv);
            [of(sample.position), of(sample.normal)]
        };
        points.iter().map(sample).collect()
    }
}

impl Shape for PointNormalMesh {
    fn domain(&self) -> Domain {
        Domain::Triangle
    }

    fn patches(&self) -> u32 {
        u32::try_from(self.triangles.len()).unwrap_or(u32::MAX)
    }

    /// The corners' box, with room for what the surface bulges.
    fn bounds(&self) -> Aabb {
        let corners = self.corners.iter().map(|[position, _]| Vec3::from(*position));
        let low = corners.clone().fold(Vec3::MAX, Vec3::min);
        let high = corners.fold(Vec3::MIN, Vec3::max);
        let more = Vec3::splat(0.1 * (high - low).length());
        Aabb::from_min_max(low - more, high + more)
    }

    fn surface(&self) -> Cow<'static, str> {
        Cow::Owned([&Self::functions(), include_str!("../shaders/rounded.wgsl")].join("\n"))
    }

    fn words(&self) -> Vec<u32> {
        let mut words = vec![u32::try_from(self.corners.len()).unwrap_or(u32::MAX)];
        words.extend(self.corners.as_flattened().as_flattened().iter().map(|x| x.to_bits()));
        words.extend(self.triangles.as_flattened());
        words
    }

    fn on_cpu(&self) -> Option<&dyn CpuShape> {
        Some(self)
    }
}

impl CpuShape for PointNormalMesh {
    fn factors(&self, patch: u32, eye: &Eye) -> PatchFactors {
        PatchFactors::Triangle(self.factors_of(patch, eye))
    }

    fn vertices(&self, patch: u32, _: &Eye, points: &[[f32; 2]], vertices: &mut Vec<ShapeVertex>) {
        let samples = self.points_of(patch, points);
        vertices.extend(points.iter().zip(samples).map(|(&uv, [position, normal])| ShapeVertex {
            position: position.to_array(),
            normal: normal.to_array(),
            uv,
            color: [1.0; 4],
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSITIONS: [[f32; 3]; 4] =
        [[0.1, 0.0, 0.0], [1.3, 0.2, 0.1], [0.2, 1.1, 0.3], [1.2, 1.0, -0.4]];
    const NORMALS: [[f32; 3]; 4] =
        [[-0.6, 0.0, 0.8], [0.6, 0.0, 0.8], [0.0, 0.6, 0.8], [0.0, 0.0, 1.0]];

    #[test]
    fn triangles_agree_on_the_bits_of_their_edges() {
        // They share the edge from corner 1 to corner 2.
        let triangles = vec![[0, 1, 2], [3, 2, 1]];
        let mesh = PointNormalMesh::new(&POSITIONS, &NORMALS, triangles).expect("it is whole");
        let part = |i: u8| f32::from(i) / 64.0;
        let along: Vec<_> = (0..=64).map(|i| [0.0, part(i)]).collect();
        let back: Vec<_> = (0..=64).rev().map(|i| [0.0, part(i)]).collect();
        let (one, other) = (mesh.points_of(0, &along), mesh.points_of(1, &back));
        assert_eq!(one, other, "positions and normals");
        assert_ne!(one, mesh.points_of(1, &along), "the other direction would be seen");
    }

    #[test]
    fn what_is_missing_is_named() {
        let of = |normals, triangles: &[[u32; 3]]| {
            PointNormalMesh::new(&POSITIONS, normals, triangles.to_vec()).err()
        };
        let wrong = PointNormalError::WrongNormals { positions: 4, normals: 3 };
        assert_eq!(of(&NORMALS[..3], &[[0, 1, 2]]), Some(wrong), "a normal is missing");
        assert_eq!(of(&NORMALS, &[]), Some(PointNormalError::Empty), "no triangles");
        let wrong = PointNormalError::NoSuchCorner { triangle: 1, corner: 4, corners: 4 };
        assert_eq!(of(&NORMALS, &[[0, 1, 2], [0, 1, 4]]), Some(wrong), "there is no fifth");
        let mut normals = NORMALS;
        normals[2][1] = f32::INFINITY;
        let wrong = PointNormalError::NotFinite { corner: 2 };
        assert_eq!(of(&normals, &[[0, 1, 2]]), Some(wrong), "the third");
    }
}

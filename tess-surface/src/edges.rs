//! The half-edges of meshes and of Bezier patches, which [`crate::topology`] pairs.

use crate::bezier::BezierPatch;
use crate::curve::{Direction, Edge};
use crate::mesh::PolygonMesh;
use crate::sides::{Sides, edge_corners, runs_onwards};
use crate::topology::{HalfEdge, HalfEdges};
use alloc::vec::Vec;
use glam::Vec3;

/// The edges of a mesh, with its coinciding positions identified.
pub(crate) struct MeshEdges<'a> {
    pub(crate) mesh: &'a PolygonMesh,
    /// For each position, the number of the first position with the same coordinates.
    pub(crate) vertices: &'a [u32],
}

impl MeshEdges<'_> {
    /// The vertices at the ends, in the direction of the edge's running coordinate.
    fn ends(&self, half: HalfEdge) -> [u32; 2] {
        let corners = &self.mesh.faces[half.patch].positions;
        let ends = edge_corners(corners)[half.edge];
        ends.map(|corner| self.vertices[corners.as_slice()[corner] as usize])
    }

    /// A number for each half-edge, which is equal only for sides of the same edge, and its slot.
    pub(crate) fn hashes(&self) -> Vec<(u64, u32)> {
        let edges = self.mesh.faces.iter().enumerate().flat_map(|(patch, face)| {
            (0..face.positions.as_slice().len()).map(move |edge| HalfEdge { patch, edge })
        });
        let key = |half| {
            let [a, b] = self.ends(half);
            (u64::from(a.min(b)) << 32) | u64::from(a.max(b))
        };
        let mut hashes = Vec::with_capacity(self.mesh.faces.len() * 4);
        hashes.extend(edges.map(|half| (key(half), half.slot())));
        hashes
    }
}

impl HalfEdges for MeshEdges<'_> {
    fn same(&self, _: HalfEdge, _: HalfEdge) -> bool {
        true
    }

    fn is_forward(&self, half: HalfEdge) -> bool {
        let onwards = runs_onwards(&self.mesh.faces[half.patch].positions, half.edge);
        self.ends(half).is_sorted() == onwards
    }

    fn normal(&self, half: HalfEdge) -> Vec3 {
        self.mesh.face_normal(&self.mesh.faces[half.patch])
    }
}

/// The edges of Bezier patches.
pub(crate) struct BezierEdges<'a>(pub(crate) &'a [BezierPatch]);

impl BezierEdges<'_> {
    fn edge(&self, half: HalfEdge) -> Edge {
        Edge::new(self.0[half.patch].boundary()[half.edge])
    }
}

impl HalfEdges for BezierEdges<'_> {
    fn same(&self, one: HalfEdge, other: HalfEdge) -> bool {
        self.edge(one).curve.key() == self.edge(other).curve.key()
    }

    fn is_forward(&self, half: HalfEdge) -> bool {
        let onwards = runs_onwards(&Sides::Quad([(); 4]), half.edge);
        (self.edge(half).direction == Direction::Along) == onwards
    }

    fn normal(&self, half: HalfEdge) -> Vec3 {
        let [u, v] = [[0.0, 0.5], [0.5, 0.0], [1.0, 0.5], [0.5, 1.0]][half.edge];
        self.0[half.patch].normal(u, v)
    }
}

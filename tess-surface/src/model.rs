//! Patches that know their neighbours.

use crate::bezier::BezierPatch;
use crate::crease::{Creases, Smoothed};
use crate::curve::Edge;
use crate::edges::{BezierEdges, MeshEdges};
use crate::error::{FaceError, MeshError};
use crate::math::{is_in_range, unit};
use crate::mesh::PolygonMesh;
use crate::patch::{Surface, SurfacePatch};
use crate::pn::{PnCorner, PnQuad, PnTriangle, edge_points};
use crate::sides::{Sides, edge_corners};
use crate::smooth::smooth_normals;
use crate::topology::{HalfEdge, Topology, check_count, hash, weld};
use alloc::vec::Vec;
use glam::Vec3;

/// The kind of surface that the faces of a polygon mesh become.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Style {
    /// Triangles are planes, quads are bilinear.
    Flat,
    /// Triangles and quads are rounded by their corners' normals ([`crate::pn`]).
    PointNormal,
}

/// Patches with adjacency, numbered from 0 in the order of the faces or Bezier patches that the
/// model was made from. Methods that take a number panic if there is no such patch, as slices do.
#[derive(Clone, Debug)]
pub struct Model {
    source: ModelSource,
    topology: Topology,
    creases: Vec<HalfEdge>,
}

#[derive(Clone, Debug)]
enum ModelSource {
    Polygons { mesh: PolygonMesh, vertices: Vec<u32>, normals: Vec<Vec3>, style: Style },
    Bezier(Vec<BezierPatch>),
}

impl Model {
    /// Makes a model from a polygon mesh. Normals are scaled to unit length. With
    /// [`Style::PointNormal`], faces without normals get smooth ones from the faces of the same
    /// sheet ([`PolygonMesh`]). Faces are neighbours if the corners of an edge have equal
    /// coordinates, whatever their indices.
    ///
    /// # Errors
    /// Those of [`PolygonMesh::check`].
    pub fn polygons(mesh: PolygonMesh, style: Style) -> Result<Self, MeshError> {
        Self::creased(mesh, style, &Creases::NONE)
    }

    /// As [`Model::polygons`], with hard edges between faces that have no normals.
    ///
    /// # Errors
    /// Those of [`PolygonMesh::check`].
    pub fn creased(
        mut mesh: PolygonMesh,
        style: Style,
        creases: &Creases<'_>,
    ) -> Result<Self, MeshError> {
        mesh.check()?;
        mesh.normalize();
        let vertices = weld(&mesh.positions);
        let topology = {
            let edges = MeshEdges { mesh: &mesh, vertices: &vertices };
            Topology::pair(mesh.faces.len(), edges.hashes(), &edges)
        };
        let lacks_normals = mesh.faces.iter().any(|face| face.normals.is_none());
        let Smoothed { normals, creases } = if lacks_normals && style == Style::PointNormal {
            smooth_normals(&mut mesh, &vertices, &topology, creases)
        } else {
            Smoothed { normals: Vec::new(), creases: Vec::new() }
        };
        let source = ModelSource::Polygons { mesh, vertices, normals, style };
        Ok(Self { source, topology, creases })
    }

    /// Makes a model from bicubic patches. Patches are neighbours if the control points of a
    /// boundary are equal.
    ///
    /// # Errors
    /// [`MeshError::Face`] for the first patch with a control point that is not finite or too large
    /// to be evaluated ([`FaceError::TooLarge`]), with a weight that is not greater than zero, or
    /// without area; [`MeshError::Empty`] or [`MeshError::TooMany`] for no patch or for 2^30 or
    /// more. A boundary that is collapsed to a point is not an error, but has no neighbours.
    pub fn bezier(patches: Vec<BezierPatch>) -> Result<Self, MeshError> {
        check_count(patches.len())?;
        let mut hashes = Vec::with_capacity(patches.len() * 4);
        for (number, patch) in patches.iter().enumerate() {
            check_patch(patch).map_err(|fault| MeshError::Face { face: number, fault })?;
            for (edge, curve) in patch.boundary().into_iter().enumerate() {
                if curve.collapsed_to().is_none() {
                    let bits = Edge::new(curve).curve.key();
                    let half = HalfEdge { patch: number, edge };
                    hashes.push((hash(bits.into_iter().flatten()), half.slot()));
                }
            }
        }
        let topology = Topology::pair(patches.len(), hashes, &BezierEdges(&patches));
        Ok(Self { source: ModelSource::Bezier(patches), topology, creases: Vec::new() })
    }

    /// The number of patches, at least 1.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a model is never empty")]
    pub const fn len(&self) -> usize {
        match &self.source {
            ModelSource::Polygons { mesh, .. } => mesh.faces.len(),
            ModelSource::Bezier(patches) => patches.len(),
        }
    }

    /// The other side of an edge; `None` for edges on the border of the model, on seams, collapsed
    /// edges and edges that do not exist.
    #[must_use]
    pub fn twin(&self, half: HalfEdge) -> Option<HalfEdge> {
        self.topology.twin(half)
    }

    /// One side of each edge whose more than two patches are neighbours in pairs, for example where
    /// two cubes touch along an edge; in ascending order.
    ///
    /// The same number of patches runs each way along such an edge, and each is the neighbour of
    /// one that runs the other way. Each surface that touches there is free of cracks, but they may
    /// be divided differently along the edge.
    #[must_use]
    pub fn crowded_edges(&self) -> &[HalfEdge] {
        &self.topology.crowded
    }

    /// All sides of each edge whose more than two patches have no single neighbour, for example
    /// where a fin meets a surface; each in ascending order.
    ///
    /// The patches there keep their own normals. They share the edge's curve and factor, so no
    /// crack opens.
    #[must_use]
    pub fn seams(&self) -> &[Vec<HalfEdge>] {
        &self.topology.seams
    }

    /// One side of each edge between faces without normals that is hard for its angle
    /// ([`Creases::least_cosine`]), in ascending order.
    #[must_use]
    pub fn creases(&self) -> &[HalfEdge] {
        &self.creases
    }

    /// The mesh, if the model was made from one. Faces at which several sheets meet may have been
    /// given normals.
    #[must_use]
    pub const fn mesh(&self) -> Option<&PolygonMesh> {
        match &self.source {
            ModelSource::Polygons { mesh, .. } => Some(mesh),
            ModelSource::Bezier(_) => None,
        }
    }

    pub(crate) const fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Whether patch `number` is a triangle or a quad, without its surface.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn sides(&self, number: usize) -> Sides<()> {
        match &self.source {
            ModelSource::Polygons { mesh, .. } => mesh.faces[number].positions.map(drop),
            ModelSource::Bezier(_) => Sides::Quad([(); 4]),
        }
    }

    /// Patch `number`, ready for evaluation.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn patch(&self, number: usize) -> SurfacePatch {
        match &self.source {
            ModelSource::Bezier(patches) => SurfacePatch::new(Surface::Bezier(patches[number])),
            ModelSource::Polygons { mesh, style, .. } => {
                let face = &mesh.faces[number];
                let surface = match style {
                    Style::Flat => match mesh.corners(face) {
                        Sides::Triangle(corners) => Surface::FlatTriangle(corners),
                        Sides::Quad(corners) => Surface::Bilinear(corners),
                    },
                    Style::PointNormal => self.point_normal(number),
                };
                let patch = SurfacePatch::new(surface);
                let Some(indices) = face.texcoords else { return patch };
                let texcoords = indices.map(|index| mesh.texcoords[index as usize]);
                patch.with_texcoords(texcoords).unwrap_or(patch) // the mesh was checked
            }
        }
    }

    /// The (least, greatest) corner of a box around all face corners, or around all control points
    /// of Bezier patches. It contains flat, bilinear and Bezier surfaces; point-normal surfaces
    /// bulge out of it.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let grow = |(low, high): (Vec3, Vec3), p: Vec3| (low.min(p), high.max(p));
        match &self.source {
            ModelSource::Polygons { mesh, .. } => {
                let corners = mesh.faces.iter().map(|face| mesh.corners(face));
                corners.fold(empty, |b, c| c.as_slice().iter().copied().fold(b, grow))
            }
            ModelSource::Bezier(patches) => {
                let points = patches.iter().flat_map(|patch| patch.points.as_flattened());
                points.map(|&point| crate::math::project(point)).fold(empty, grow)
            }
        }
    }

    /// The point-normal surface of a face, with edges that its neighbours share.
    fn point_normal(&self, number: usize) -> Surface {
        let corners = self.pn_corners(number);
        let ends = edge_corners(&corners);
        let edges = corners.map_numbered(|edge, _| {
            let [start, end] = ends[edge].map(|corner| corners.as_slice()[corner]);
            self.shared_edge_points(HalfEdge { patch: number, edge }, start, end)
        });
        match (corners, edges) {
            (Sides::Triangle(corners), Sides::Triangle(edges)) => {
                Surface::PnTriangle(PnTriangle::new(corners, edges))
            }
            (Sides::Quad(corners), Sides::Quad(edges)) => {
                Surface::PnQuad(PnQuad::new(corners, edges))
            }
            _ => unreachable!("one edge for each corner"),
        }
    }

    /// The means of the inner control points that the sides of an edge would have on their own.
    fn shared_edge_points(&self, half: HalfEdge, start: PnCorner, end: PnCorner) -> [Vec3; 2] {
        let own = edge_points(start, end);
        if let Some(twin) = self.twin(half) {
            let theirs = self.edge_points_beyond(twin, start);
            return [(own[0] + theirs[0]) * 0.5, (own[1] + theirs[1]) * 0.5];
        }
        let seam = self.topology.seam(half);
        if seam.is_empty() {
            return own;
        }
        // In the order of the seam, so that all sides get the same sum.
        let points = seam.iter().map(|&side| self.edge_points_beyond(side, start));
        let sum = points.fold([Vec3::ZERO; 2], |sum, [a, b]| [sum[0] + a, sum[1] + b]);
        #[expect(clippy::cast_precision_loss, reason = "a seam has far fewer than 2^24 sides")]
        let count = seam.len() as f32;
        sum.map(|points| points / count)
    }

    /// The inner control points that a side of an edge would have on its own, in the direction from
    /// `start`.
    fn edge_points_beyond(&self, half: HalfEdge, start: PnCorner) -> [Vec3; 2] {
        let corners = self.pn_corners(half.patch);
        let [a, b] = edge_corners(&corners)[half.edge].map(|corner| corners.as_slice()[corner]);
        if a.position == start.position { edge_points(a, b) } else { edge_points(b, a) }
    }

    fn pn_corners(&self, number: usize) -> Sides<PnCorner> {
        let ModelSource::Polygons { mesh, vertices, normals, .. } = &self.source else {
            unreachable!("only polygons have point-normal surfaces");
        };
        let face = &mesh.faces[number];
        face.positions.map_numbered(|corner, position| {
            let normal = match &face.normals {
                Some(given) => mesh.normals[given.as_slice()[corner] as usize],
                None => normals[vertices[position as usize] as usize],
            };
            PnCorner { position: mesh.positions[position as usize], normal }
        })
    }
}

fn check_patch(patch: &BezierPatch) -> Result<(), FaceError> {
    let points = patch.points.as_flattened();
    if points.iter().any(|point| !point.is_finite()) {
        return Err(FaceError::NotFinite("control point"));
    }
    if points.iter().any(|point| point.w <= 0.0) {
        return Err(FaceError::Weight);
    }
    let positions = points.iter().map(|&point| crate::math::project(point));
    // Tangents are differences of positions, times a quotient of weights.
    let weights = points.iter().map(|point| point.w);
    let (least, greatest) = weights.fold((f32::MAX, 0.0f32), |(l, g), w| (l.min(w), g.max(w)));
    let evaluable = positions.clone().all(|p| is_in_range((p * (greatest / least)).as_ref()));
    if !evaluable || !points.iter().all(|point| is_in_range(point.as_ref())) {
        return Err(FaceError::TooLarge("control point"));
    }
    let mut directions = positions.map(|point| point - crate::math::project(patch.points[0][0]));
    let first = directions.by_ref().find_map(unit).ok_or(FaceError::NoArea)?;
    let mut others = directions.filter_map(unit);
    let spans = others.any(|other| first.cross(other).length_squared() > 1e-12);
    if spans { Ok(()) } else { Err(FaceError::NoArea) }
}

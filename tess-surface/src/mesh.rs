//! Triangles and quads with indices, as a model file holds them.

use crate::error::{MeshError, MeshFault};
use crate::math::{is_in_range, unit};
use crate::sides::{Sides, edge_corners};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec3, Vec2, Vec3};

/// One face: its corners in counter-clockwise order, seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// The corners' indices into [`PolygonMesh::positions`].
    pub positions: Sides<u32>,
    /// The corners' indices into [`PolygonMesh::normals`]; without them the corners get smooth
    /// normals.
    pub normals: Option<Sides<u32>>,
    /// The corners' indices into [`PolygonMesh::texcoords`]; without them the corners get those of
    /// the unit square.
    pub texcoords: Option<Sides<u32>>,
}

/// Faces over shared positions, normals and texture coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// Positions, in the model's units, each coordinate within [`MAX_COORDINATE`] of 0.
    ///
    /// [`MAX_COORDINATE`]: crate::MAX_COORDINATE
    pub positions: Vec<Vec3>,
    /// Normals of any length but zero.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, (0, 0) at the lower left of the image.
    pub texcoords: Vec<Vec2>,
    /// The faces.
    pub faces: Vec<Face>,
}

impl PolygonMesh {
    /// Checks every face. Positions and normals that no face uses may be anything.
    ///
    /// # Errors
    /// The first face with a [`MeshFault`], save edges of more than two faces, which [`Model::polygons`]
    /// finds; a mesh with no face or with 2^30.
    ///
    /// [`Model::polygons`]: crate::Model::polygons
    pub fn check(&self) -> Result<(), MeshError> {
        crate::topology::check_count(self.faces.len())?;
        for (number, face) in self.faces.iter().enumerate() {
            self.check_face(face).map_err(|fault| MeshError::Face { face: number, fault })?;
        }
        Ok(())
    }

    /// Scales every normal to unit length. One of no direction, which no face may use, becomes 0.
    pub fn normalize(&mut self) {
        for normal in &mut self.normals {
            *normal = unit(*normal).unwrap_or(Vec3::ZERO);
        }
    }

    /// Checks one face, of this mesh or made for it.
    ///
    /// # Errors
    /// Its first [`MeshFault`].
    pub fn check_face(&self, face: &Face) -> Result<(), MeshFault> {
        let corners = face.positions.as_slice().len();
        let positions = gather(&self.positions, face.positions, corners, "position")?;
        for position in positions.as_slice() {
            check_vector("position", position.is_finite(), is_in_range(position.as_ref()))?;
        }
        if let Some(normals) = face.normals {
            let normals = gather(&self.normals, normals, corners, "normal")?;
            if normals.as_slice().iter().any(|&normal| unit(normal).is_none()) {
                return Err(MeshFault::NotFinite("normal"));
            }
        }
        if let Some(texcoords) = face.texcoords {
            let what = "texture coordinate";
            let texcoords = gather(&self.texcoords, texcoords, corners, what)?;
            for texcoord in texcoords.as_slice() {
                check_vector(what, texcoord.is_finite(), is_in_range(texcoord.as_ref()))?;
            }
        }
        check_area(&positions)
    }

    /// The positions of a face's corners.
    ///
    /// # Panics
    /// If an index of the face is out of range; [`PolygonMesh::check`] finds these.
    #[must_use]
    pub fn corners(&self, face: &Face) -> Sides<Vec3> {
        face.positions.map(|position| self.positions[position as usize])
    }

    /// One unit normal for each position: the sum of its faces' normals, each weighted by the angle
    /// there.
    ///
    /// G. Thürmer, C. A. Wüthrich, *Computing Vertex Normals from Polygonal Facets*, Journal of
    /// Graphics Tools 3(1), 1998. `vertices` maps positions to those that they coincide with.
    #[must_use]
    pub(crate) fn smooth_normals(&self, vertices: &[u32]) -> Vec<Vec3> {
        let mut sums = vec![Vec3::ZERO; self.positions.len()];
        for face in &self.faces {
            let corners = self.corners(face);
            for (corner, &position) in face.positions.as_slice().iter().enumerate() {
                sums[vertices[position as usize] as usize] += angle_weighted(&corners, corner);
            }
        }
        // Normals that cancel out leave none to choose; any unit vector is as good as another.
        sums.iter().map(|&sum| unit(sum).unwrap_or(Vec3::Z)).collect()
    }
}

fn check_vector(what: &'static str, is_finite: bool, is_in_range: bool) -> Result<(), MeshFault> {
    match (is_finite, is_in_range) {
        (false, _) => Err(MeshFault::NotFinite(what)),
        (true, false) => Err(MeshFault::TooLarge(what)),
        (true, true) => Ok(()),
    }
}

/// The values of a face's corners.
fn gather<T: Copy>(
    values: &[T],
    indices: Sides<u32>,
    corners: usize,
    what: &'static str,
) -> Result<Sides<T>, MeshFault> {
    let found = indices.as_slice().len();
    if found != corners {
        return Err(MeshFault::WrongCount { what, found, corners });
    }
    if indices.as_slice().iter().any(|&index| index as usize >= values.len()) {
        return Err(MeshFault::OutOfRange { what, count: values.len() });
    }
    Ok(indices.map(|index| values[index as usize]))
}

/// Refuses two neighbouring corners with one position, and an area that vanishes against the
/// product of the diagonals.
fn check_area(corners: &Sides<Vec3>) -> Result<(), MeshFault> {
    let points = corners.as_slice();
    if edge_corners(corners).iter().any(|&[a, b]| points[a] == points[b]) {
        return Err(MeshFault::RepeatedCorner);
    }
    let [a, b] = match corners {
        Sides::Triangle([a, b, c]) => [[a, b], [a, c]],
        Sides::Quad([a, b, c, d]) => [[a, c], [b, d]],
    }
    .map(|[from, to]| to.as_dvec3() - from.as_dvec3());
    // 2^-22: below it, the rounding of binary32 coordinates decides about the area.
    const LEAST_SINE: f64 = 1.0 / 4_194_304.0;
    if a.cross(b).length() <= LEAST_SINE * a.length() * b.length() {
        return Err(MeshFault::NoArea);
    }
    Ok(())
}

/// The unit normal at a corner times the angle between its edges.
fn angle_weighted(corners: &Sides<Vec3>, corner: usize) -> Vec3 {
    let points = corners.as_slice();
    let count = points.len();
    let here = points[corner].as_dvec3();
    let next = points[(corner + 1) % count].as_dvec3() - here;
    let previous = points[(corner + count - 1) % count].as_dvec3() - here;
    let cross: DVec3 = next.cross(previous);
    let angle = libm::atan2(cross.length(), next.dot(previous));
    (cross.normalize_or_zero() * angle).as_vec3()
}

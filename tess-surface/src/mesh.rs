//! Triangles and quads with indices, as in a model file.

use crate::error::{FaceError, MeshError};
use crate::math::{is_in_range, unit};
use crate::sides::{Sides, edge_corners};
use alloc::vec::Vec;
use glam::{DVec3, Vec2, Vec3};

/// One face, with its corners in counter-clockwise order as seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// The corners' indices into [`PolygonMesh::positions`].
    pub positions: Sides<u32>,
    /// The corners' indices into [`PolygonMesh::normals`]. With `None`, the corners get smooth
    /// normals.
    pub normals: Option<Sides<u32>>,
    /// The corners' indices into [`PolygonMesh::texcoords`]. With `None`, the corners' texture
    /// coordinates are their domain coordinates.
    pub texcoords: Option<Sides<u32>>,
}

/// Faces over shared positions, normals and texture coordinates.
///
/// A mesh may have a face twice, with its corners in both orders, once for each side; the two
/// belong to different sheets. Smooth normals are made for each sheet separately, from faces that
/// are neighbours, run the same way round, and are not folded onto each other.
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
    /// [`MeshError::Face`] for the first face with a [`FaceError`]; [`MeshError::Empty`] or
    /// [`MeshError::TooMany`] for a mesh with no face or with 2^30 or more.
    pub fn check(&self) -> Result<(), MeshError> {
        crate::topology::check_count(self.faces.len())?;
        for (number, face) in self.faces.iter().enumerate() {
            self.check_face(face).map_err(|fault| MeshError::Face { face: number, fault })?;
        }
        Ok(())
    }

    /// Scales every normal to unit length. A normal without a direction, which no face may use,
    /// becomes 0.
    pub fn normalize(&mut self) {
        for normal in &mut self.normals {
            *normal = unit(*normal).unwrap_or(Vec3::ZERO);
        }
    }

    /// Checks one face, which may be part of this mesh or made for it.
    ///
    /// # Errors
    /// The face's first [`FaceError`].
    pub fn check_face(&self, face: &Face) -> Result<(), FaceError> {
        let corners = face.positions.as_slice().len();
        let positions = gather(&self.positions, face.positions, corners, "position")?;
        for position in positions.as_slice() {
            check_vector("position", position.is_finite(), is_in_range(position.as_ref()))?;
        }
        if let Some(normals) = face.normals {
            let normals = gather(&self.normals, normals, corners, "normal")?;
            if normals.as_slice().iter().any(|&normal| unit(normal).is_none()) {
                return Err(FaceError::NotFinite("normal"));
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

    /// The unit normal of the plane through a face's corners, or of the nearest plane; zero if
    /// there is none.
    pub(crate) fn face_normal(&self, face: &Face) -> Vec3 {
        let [a, b] = diagonals(&self.corners(face));
        a.cross(b).normalize_or_zero().as_vec3()
    }
}

fn check_vector(what: &'static str, is_finite: bool, is_in_range: bool) -> Result<(), FaceError> {
    match (is_finite, is_in_range) {
        (false, _) => Err(FaceError::NotFinite(what)),
        (true, false) => Err(FaceError::TooLarge(what)),
        (true, true) => Ok(()),
    }
}

/// The values of a face's corners.
fn gather<T: Copy>(
    values: &[T],
    indices: Sides<u32>,
    corners: usize,
    what: &'static str,
) -> Result<Sides<T>, FaceError> {
    let found = indices.as_slice().len();
    if found != corners {
        return Err(FaceError::WrongCount { what, found, corners });
    }
    if indices.as_slice().iter().any(|&index| index as usize >= values.len()) {
        return Err(FaceError::OutOfRange { what, count: values.len() });
    }
    Ok(indices.map(|index| values[index as usize]))
}

/// Refuses two neighbouring corners with the same position, and an area that vanishes compared with
/// the product of the diagonals, or of a triangle's two longest edges.
fn check_area(corners: &Sides<Vec3>) -> Result<(), FaceError> {
    let points = corners.as_slice();
    if edge_corners(corners).iter().any(|&[a, b]| points[a] == points[b]) {
        return Err(FaceError::RepeatedCorner);
    }
    let [a, b] = match corners {
        Sides::Triangle(corners) => longest(corners),
        Sides::Quad(_) => diagonals(corners),
    };
    // 2^-22. Below it, the area is no more than the rounding of binary32 coordinates.
    const LEAST_SINE: f64 = 1.0 / 4_194_304.0;
    if a.cross(b).length() <= LEAST_SINE * a.length() * b.length() {
        return Err(FaceError::NoArea);
    }
    Ok(())
}

/// The two longest edges of a triangle, from their common corner, whichever corner is the first.
fn longest(corners: &[Vec3; 3]) -> [DVec3; 2] {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let from_each = [[b - a, c - a], [c - b, a - b], [a - c, b - c]];
    let opposite = |[to, other]: &[DVec3; 2]| (*other - *to).length_squared();
    let [mut least, rest @ ..] = from_each;
    for edges in rest {
        if opposite(&edges) < opposite(&least) {
            least = edges;
        }
    }
    least
}

/// Two vectors whose cross product is along the normal: the diagonals of a quad, two edges of a
/// triangle.
fn diagonals(corners: &Sides<Vec3>) -> [DVec3; 2] {
    match corners {
        Sides::Triangle([a, b, c]) => [[a, b], [a, c]],
        Sides::Quad([a, b, c, d]) => [[a, c], [b, d]],
    }
    .map(|[from, to]| to.as_dvec3() - from.as_dvec3())
}

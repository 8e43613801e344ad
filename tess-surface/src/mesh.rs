//! Triangles and quads with indices: what a model file holds, checked.

use crate::error::{Fault, MeshError};
use crate::math::unit;
use crate::sides::{Sides, edge_corners};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec3, Vec2, Vec3};

/// One face: corners counter-clockwise as seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Numbers of the corners' positions.
    pub positions: Sides<u32>,
    /// Numbers of their normals, if the file gives any.
    pub normals: Option<Sides<u32>>,
    /// Numbers of their texture coordinates, if the file gives any.
    pub texcoords: Option<Sides<u32>>,
}

/// Faces over shared positions, normals and texture coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// Positions, in the model's units.
    pub positions: Vec<Vec3>,
    /// Normals; made unit by [`PolygonMesh::check`].
    pub normals: Vec<Vec3>,
    /// Texture coordinates, (0, 0) at the lower left of the image.
    pub texcoords: Vec<Vec2>,
    /// The faces.
    pub faces: Vec<Face>,
}

impl PolygonMesh {
    /// Checks every face and makes the normals unit vectors.
    ///
    /// # Errors
    /// The first face with an index out of range, a number that is not finite, a repeated corner
    /// or no area; a mesh with more than 2^30 faces or none.
    pub fn check(&mut self) -> Result<(), MeshError> {
        crate::topology::check_count(self.faces.len())?;
        for (number, face) in self.faces.iter().enumerate() {
            self.check_face(face).map_err(|fault| MeshError::face(number, fault))?;
        }
        for normal in &mut self.normals {
            *normal = unit(*normal).unwrap_or(Vec3::ZERO); // unused ones may be anything
        }
        Ok(())
    }

    fn check_face(&self, face: &Face) -> Result<(), Fault> {
        let positions = gather(&self.positions, face.positions, "position")?;
        if !positions.as_slice().iter().all(|position| position.is_finite()) {
            return Err(Fault::NotFinite("position"));
        }
        if let Some(normals) = face.normals {
            let normals = gather(&self.normals, normals, "normal")?;
            if normals.as_slice().iter().any(|&normal| unit(normal).is_none()) {
                return Err(Fault::NotFinite("normal"));
            }
        }
        if let Some(texcoords) = face.texcoords {
            let texcoords = gather(&self.texcoords, texcoords, "texture coordinate")?;
            if !texcoords.as_slice().iter().all(|texcoord| texcoord.is_finite()) {
                return Err(Fault::NotFinite("texture coordinate"));
            }
        }
        check_area(&positions)
    }

    /// The positions of a face's corners; its indices must have been checked.
    #[must_use]
    pub fn corners(&self, face: &Face) -> Sides<Vec3> {
        face.positions.map(|position| self.positions[position as usize])
    }

    /// One normal per position: the sum of its faces' normals, each weighted by the angle there.
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

fn gather<T: Copy>(
    values: &[T],
    indices: Sides<u32>,
    what: &'static str,
) -> Result<Sides<T>, Fault> {
    let fault = Fault::OutOfRange { what, count: values.len() };
    let known = |index: &u32| (*index as usize) < values.len();
    if !indices.as_slice().iter().all(known) {
        return Err(fault);
    }
    Ok(indices.map(|index| values[index as usize]))
}

/// Two corners in one place, or an area that vanishes against the product of its diagonals.
fn check_area(corners: &Sides<Vec3>) -> Result<(), Fault> {
    let points = corners.as_slice();
    if edge_corners(corners).iter().any(|&[a, b]| points[a] == points[b]) {
        return Err(Fault::RepeatedCorner);
    }
    let [a, b] = match corners {
        Sides::Triangle([a, b, c]) => [[a, b], [a, c]],
        Sides::Quad([a, b, c, d]) => [[a, c], [b, d]],
    }
    .map(|[from, to]| to.as_dvec3() - from.as_dvec3());
    // 2^-22: below it, the rounding of binary32 coordinates decides about the area.
    const LEAST_SINE: f64 = 1.0 / 4_194_304.0;
    if a.cross(b).length() <= LEAST_SINE * a.length() * b.length() {
        return Err(Fault::NoArea);
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

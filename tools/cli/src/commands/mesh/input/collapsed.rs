//! Faces without area, such as those at the pole of a sphere.
//!
//! A triangle with corners in the same place is an edge. Without it, the faces on its two sides meet
//! at that edge, so it is dropped; a quad with one collapsed edge becomes a triangle. Faces whose
//! distinct corners lie on one line are dropped too, but the edges around them are then open.

use glam::Vec3;
use rayon::prelude::*;
use tess_surface::{Face, MeshFault, PolygonMesh, Sides};

/// The result of [`repair`].
#[derive(Debug, Default)]
pub(super) struct Collapsed {
    /// Dropped faces with corners in the same place.
    repeated: usize,
    /// Dropped faces with corners on one line.
    straight: usize,
    /// Quads that became triangles.
    narrowed: usize,
    /// The number that each face had before; empty if none is gone.
    originals: Vec<usize>,
}

impl Collapsed {
    /// The number that a face had before.
    pub(super) fn original(&self, face: usize) -> usize {
        self.originals.get(face).copied().unwrap_or(face)
    }

    /// The repairs, a sentence each.
    pub(super) fn notes(&self) -> Vec<String> {
        let Self { repeated, straight, narrowed, .. } = self;
        let mut notes = Vec::new();
        if repeated + narrowed > 0 {
            notes.push(format!(
                "corners in the same place: {repeated} faces without area are left out, {narrowed} \
                 quads become triangles"
            ));
        }
        if *straight > 0 {
            notes.push(format!(
                "corners on one line: {straight} faces without area are left out; cracks may open \
                 where they joined others"
            ));
        }
        notes
    }
}

/// Drops faces that have no area, and corners that coincide with the one before. Faces with another
/// fault stay as they are.
pub(super) fn repair(mesh: &mut PolygonMesh) -> Collapsed {
    let mut collapsed = Collapsed::default();
    let without_area = |face: &Face| {
        matches!(mesh.check_face(face), Err(MeshFault::RepeatedCorner | MeshFault::NoArea))
    };
    if !mesh.faces.par_iter().any(without_area) {
        return collapsed;
    }
    let mut kept = Vec::with_capacity(mesh.faces.len());
    for (number, face) in mesh.faces.iter().enumerate() {
        if let Some(face) = collapsed.repaired(mesh, *face) {
            collapsed.originals.push(number);
            kept.push(face);
        }
    }
    mesh.faces = kept;
    collapsed
}

impl Collapsed {
    /// The face without repeated corners; `None`, and counted, if it has no area.
    fn repaired(&mut self, mesh: &PolygonMesh, face: Face) -> Option<Face> {
        match mesh.check_face(&face) {
            Err(MeshFault::NoArea) => {
                self.straight += 1;
                None
            }
            Err(MeshFault::RepeatedCorner) => {
                let Some(narrow) = without_repeats(&mesh.positions, &face) else {
                    self.repeated += 1;
                    return None;
                };
                let narrow = self.repaired(mesh, narrow);
                self.narrowed += usize::from(narrow.is_some());
                narrow
            }
            _ => Some(face),
        }
    }
}

/// The triangle that a quad is without the corner that repeats the one before, if one does.
fn without_repeats(positions: &[Vec3], face: &Face) -> Option<Face> {
    let places = face.positions.map(|index| positions[index as usize]);
    let places = places.as_slice();
    let is_new = |&corner: &usize| {
        let before = if corner == 0 { places.len() - 1 } else { corner - 1 };
        places[corner] != places[before]
    };
    let kept: Vec<usize> = (0..places.len()).filter(is_new).collect();
    let &[a, b, c] = kept.as_slice() else { return None };
    let three = |sides: Sides<u32>| Sides::Triangle([a, b, c].map(|k| sides.as_slice()[k]));
    Some(Face {
        positions: three(face.positions),
        normals: face.normals.map(three),
        texcoords: face.texcoords.map(three),
    })
}

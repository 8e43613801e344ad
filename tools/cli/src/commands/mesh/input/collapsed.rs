//! Faces with corners in the same place, such as those at the pole of a sphere.
//!
//! Such a triangle is an edge. Without it, the faces on its two sides meet at that edge, so it is
//! dropped; a quad with one collapsed edge becomes a triangle. Faces whose distinct corners lie on
//! one line stay, and are refused later: without them, the faces around would no longer meet.

use glam::Vec3;
use tess_surface::{Face, PolygonMesh, Sides};

/// What [`repair`] did.
#[derive(Debug, Default)]
pub(super) struct Collapsed {
    /// How many faces are gone.
    dropped: usize,
    /// How many quads became triangles.
    narrowed: usize,
    /// The number that each face had before; empty if none is gone.
    originals: Vec<usize>,
}

impl Collapsed {
    /// The number that a face had before.
    pub(super) fn original(&self, face: usize) -> usize {
        self.originals.get(face).copied().unwrap_or(face)
    }

    /// A sentence about what was done, if anything was.
    pub(super) fn note(&self) -> Option<String> {
        let Self { dropped, narrowed, .. } = self;
        (dropped + narrowed > 0).then(|| {
            format!(
                "corners in the same place: {dropped} faces without area are left out, {narrowed} \
                 quads become triangles"
            )
        })
    }
}

/// Drops faces that have no area because corners coincide, and corners that coincide with the one
/// before. Faces with an index out of range stay as they are.
pub(super) fn repair(mesh: &mut PolygonMesh) -> Collapsed {
    let mut collapsed = Collapsed::default();
    let PolygonMesh { positions, faces, .. } = mesh;
    if faces.iter().all(|face| without_repeats(positions, face) == Some(*face)) {
        return collapsed;
    }
    let mut kept = Vec::with_capacity(faces.len());
    for (number, face) in faces.iter().enumerate() {
        match without_repeats(positions, face) {
            None => collapsed.dropped += 1,
            Some(after) => {
                collapsed.narrowed += usize::from(after != *face);
                collapsed.originals.push(number);
                kept.push(after);
            }
        }
    }
    *faces = kept;
    collapsed
}

/// The face without the corners that repeat the one before; `None` if nothing of it has an area.
fn without_repeats(positions: &[Vec3], face: &Face) -> Option<Face> {
    let places = face.positions.map(|index| positions.get(index as usize));
    let places = places.as_slice();
    let is_new = |&corner: &usize| {
        let before = if corner == 0 { places.len() - 1 } else { corner - 1 };
        places[corner].is_none() || places[corner] != places[before]
    };
    if (0..places.len()).all(|corner| is_new(&corner)) {
        let folded =
            matches!(places, [a, b, c, d] if a.is_some() && a == c || b.is_some() && b == d);
        return (!folded).then_some(*face);
    }
    let kept: Vec<usize> = (0..places.len()).filter(is_new).collect();
    let &[a, b, c] = kept.as_slice() else { return None };
    let three = |sides: Sides<u32>| Sides::Triangle([a, b, c].map(|k| sides.as_slice()[k]));
    Some(Face {
        positions: three(face.positions),
        normals: face.normals.map(three),
        texcoords: face.texcoords.map(three),
    })
}

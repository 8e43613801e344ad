//! Faces without area, such as those at the pole of a sphere.
//!
//! A triangle with two corners in the same place is an edge. If it is dropped, the faces on its two
//! sides meet at that edge. A quad with one collapsed edge becomes a triangle. Faces whose distinct
//! corners are on one line are dropped too, but the edges around them are then open.

use super::draft::Draft;
use super::tally::Tally;
use glam::Vec3;
use rayon::prelude::*;
use tess_surface::{Face, FaceError, PolygonMesh, Sides};

/// Drops faces that have no area, and corners that coincide with the one before. Faces with other
/// faults are left unchanged.
pub(super) fn repair(draft: &mut Draft) {
    let has_fault = |face: &Face| fault(&draft.mesh, face).is_some();
    if !draft.mesh.faces.par_iter().any(has_fault) {
        return;
    }
    let (mut repeated, mut straight, mut narrowed) =
        (Tally::default(), Tally::default(), Tally::default());
    draft.replace_faces(|mesh, face, place| {
        let (kept, tally) = match repaired(mesh, *face) {
            Repaired::Whole => return vec![*face],
            Repaired::Narrowed(face) => (vec![face], &mut narrowed),
            Repaired::Repeated => (Vec::new(), &mut repeated),
            Repaired::Straight => (Vec::new(), &mut straight),
        };
        tally.add(place);
        kept
    });
    let same = " with corners in the same place";
    draft.note(repeated.note("face", same, "left out, as they have no area"));
    draft.note(narrowed.note("quad", same, "made triangles"));
    let open = "left out, as they have no area; cracks may open where they joined others";
    draft.note(straight.note("face", " with all corners on one line", open));
}

/// The result of a repair of one face.
enum Repaired {
    /// The face needs no repair here.
    Whole,
    /// The face is a quad that becomes this triangle.
    Narrowed(Face),
    /// The face has no area, because corners are in the same place.
    Repeated,
    /// The face has no area, because its corners are on one line.
    Straight,
}

/// The fault of a face that is repaired here; its normals are ignored.
fn fault(mesh: &PolygonMesh, face: &Face) -> Option<FaceError> {
    let fault = mesh.check_face(&Face { normals: None, ..*face }).err();
    fault.filter(|fault| matches!(fault, FaceError::RepeatedCorner | FaceError::NoArea))
}

fn repaired(mesh: &PolygonMesh, face: Face) -> Repaired {
    match fault(mesh, &face) {
        None => Repaired::Whole,
        Some(FaceError::NoArea) => Repaired::Straight,
        Some(_) => match without_repeats(&mesh.positions, &face) {
            None => Repaired::Repeated,
            Some(narrow) => match repaired(mesh, narrow) {
                Repaired::Whole => Repaired::Narrowed(narrow),
                gone => gone,
            },
        },
    }
}

/// The triangle that remains of a quad if one of its corners repeats the corner before.
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

//! Repairs of single faces: concave quads are cut, and normals without a direction are dropped.

use super::draft::Draft;
use super::polygon::{corners, is_concave, triangles};
use super::tally::Tally;
use glam::Vec3;
use rayon::prelude::*;
use tess_surface::{Face, FaceError, PolygonMesh, Sides};

/// Cuts quads that have a corner pointing inwards. As a single surface, such a quad would fold over
/// itself.
pub(super) fn cut_concave_quads(draft: &mut Draft) {
    let is_concave = |mesh: &PolygonMesh, face: &Face| {
        let Sides::Quad(corners) = face.positions else { return false };
        let at = |index: u32| mesh.positions.get(index as usize).copied().unwrap_or(Vec3::NAN);
        is_concave(corners.map(at))
    };
    if !draft.mesh.faces.par_iter().any(|face| is_concave(&draft.mesh, face)) {
        return;
    }
    let mut cut = Tally::default();
    draft.replace_faces(|mesh, face, place| {
        if !is_concave(mesh, face) {
            return vec![*face];
        }
        cut.add(place);
        triangles(&corners(face), &mesh.positions)
    });
    draft.note(cut.note("concave quad", "", "cut into two triangles"));
}

/// Drops the normals of faces that have a normal that is zero, NaN or infinite. Such faces get
/// smooth ones.
pub(super) fn drop_bad_normals(draft: &mut Draft) {
    let is_bad = |mesh: &PolygonMesh, face: &Face| {
        face.normals.is_some() && mesh.check_face(face) == Err(FaceError::NotFinite("normal"))
    };
    if !draft.mesh.faces.par_iter().any(|face| is_bad(&draft.mesh, face)) {
        return;
    }
    let mut dropped = Tally::default();
    draft.replace_faces(|mesh, face, place| {
        if !is_bad(mesh, face) {
            return vec![*face];
        }
        dropped.add(place);
        vec![Face { normals: None, ..*face }]
    });
    let done = "they get smooth normals";
    draft.note(dropped.note("face", " with a normal that is zero, NaN or infinite", done));
}

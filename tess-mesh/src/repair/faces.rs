//! Repairs of single faces: concave and crossed quads are cut, and values that cannot be used are
//! dropped.

use crate::repair::draft::Draft;
use crate::repair::polygon::{QuadShape, corners, triangles};
use crate::repair::tally::Tally;
use glam::Vec3;
use rayon::prelude::*;
use tess_surface::{Face, FaceError, MAX_COORDINATE, PolygonMesh, Sides};

/// Cuts quads that have a corner pointing inwards, and quads that cross themselves. As a single
/// surface, such a quad would fold over itself.
pub(crate) fn cut_folded_quads(draft: &mut Draft) {
    let shape = |mesh: &PolygonMesh, face: &Face| {
        let Sides::Quad(corners) = face.positions else { return QuadShape::Convex };
        let at = |index: u32| mesh.positions.get(index as usize).copied().unwrap_or(Vec3::NAN);
        QuadShape::of(corners.map(at))
    };
    if !draft.mesh.faces.par_iter().any(|face| shape(&draft.mesh, face) != QuadShape::Convex) {
        return;
    }
    let (mut concave, mut crossed) = (Tally::default(), Tally::default());
    draft.replace_faces(|mesh, face, place| {
        match shape(mesh, face) {
            QuadShape::Convex => return vec![*face],
            QuadShape::Concave => concave.add(place),
            QuadShape::Crossed => crossed.add(place),
        }
        triangles(&corners(face), &mesh.positions).faces
    });
    draft.note(concave.note("concave quad", "", "cut into two triangles"));
    let done = "cut into two triangles, as it has no inside";
    draft.note(crossed.note("quad", " that crosses itself", done));
}

/// Drops texture coordinates and normals of faces that refer to values that are not there, and
/// texture coordinates that are not finite. Nothing else needs them.
pub(crate) fn drop_missing_values(draft: &mut Draft) {
    let lacks_normal = |mesh: &PolygonMesh, face: &Face| {
        let indices = face.normals.iter().flat_map(|normals| normals.as_slice());
        indices.copied().any(|index| index as usize >= mesh.normals.len())
    };
    let lacks_texcoord = |mesh: &PolygonMesh, face: &Face| {
        let indices = face.texcoords.iter().flat_map(|texcoords| texcoords.as_slice());
        indices.copied().any(|index| {
            let texcoord = mesh.texcoords.get(index as usize);
            // NaN is not within the range either.
            !texcoord.is_some_and(|at| at.abs().max_element() <= MAX_COORDINATE && !at.is_nan())
        })
    };
    let lacks =
        |mesh: &PolygonMesh, face: &Face| lacks_normal(mesh, face) || lacks_texcoord(mesh, face);
    if !draft.mesh.faces.par_iter().any(|face| lacks(&draft.mesh, face)) {
        return;
    }
    let (mut normals, mut texcoords) = (Tally::default(), Tally::default());
    draft.replace_faces(|mesh, face, place| {
        let mut face = *face;
        if lacks_normal(mesh, &face) {
            normals.add(place);
            face.normals = None;
        }
        if lacks_texcoord(mesh, &face) {
            texcoords.add(place);
            face.texcoords = None;
        }
        vec![face]
    });
    draft.note(normals.note("face", " with normals that are not there", "they get smooth normals"));
    let rest = " with texture coordinates that are not there, or not finite";
    draft.note(texcoords.note("face", rest, "they have none"));
}

/// Drops the normals of faces that have a normal that is zero, NaN or infinite. Such faces get
/// smooth ones.
pub(crate) fn drop_bad_normals(draft: &mut Draft) {
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

//! The contents of files as they are, before any repair.

use crate::budget::{Budget, MAX_MEMORY};
use crate::error::{LoadError, LoadErrorKind};
use crate::load::LoadOptions;
use crate::read;
use tess_surface::{BezierPatch, PolygonMesh};

fn in_content(message: String) -> LoadError {
    LoadError::new(LoadErrorKind::Content, message)
}

/// The faces of an OBJ file; polygons of more than four corners are cut. Indices of normals and
/// texture coordinates may be out of range.
///
/// # Errors
/// The fault and its line.
pub fn obj(bytes: &[u8]) -> Result<PolygonMesh, LoadError> {
    let obj = read::obj::parse(bytes, &Budget::new(MAX_MEMORY), &|_| {});
    obj.map(|obj| obj.mesh).map_err(in_content)
}

/// The triangles of a glTF or GLB file that refers to no other files, in their pose.
///
/// # Errors
/// The fault and its JSON path.
pub fn gltf(bytes: &[u8], options: &LoadOptions) -> Result<PolygonMesh, LoadError> {
    let budget = Budget::new(options.max_memory);
    let request = read::gltf::Request {
        folder: None,
        scene: options.scene,
        uses_normals: true,
        budget: &budget,
    };
    let scene = read::gltf::parse(bytes, &request, &|_, _| {});
    scene.map(|scene| scene.mesh).map_err(in_content)
}

/// The patches of a Bezier patch file.
///
/// # Errors
/// The fault and its line.
pub fn bpt(bytes: &[u8]) -> Result<Vec<BezierPatch>, LoadError> {
    let bpt = read::bpt::parse(bytes, &Budget::new(MAX_MEMORY));
    bpt.map(|bpt| bpt.patches).map_err(in_content)
}

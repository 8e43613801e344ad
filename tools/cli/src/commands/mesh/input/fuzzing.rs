//! The readers in the form that fuzz targets call: from bytes to a mesh or a message.

use super::draft::{Draft, FacePlaces};
use super::{bpt, collapsed, gltf, height, obj};
use std::io::Cursor;
use tess_surface::BezierPatch;
use tess_surface::PolygonMesh;

/// A grey image: its width and height, and its texels row by row from the top.
pub type Heights = (usize, usize, Vec<f32>);

/// Reads an OBJ file.
///
/// # Errors
/// The fault and its place.
pub fn obj(bytes: &[u8]) -> Result<PolygonMesh, String> {
    obj::parse(bytes).map(|obj| obj.mesh)
}

/// Reads a glTF or GLB file of at most `most` vertices and triangles that refers to no other files.
///
/// # Errors
/// The fault and its place.
pub fn gltf(bytes: &[u8], most: usize) -> Result<PolygonMesh, String> {
    gltf::parse(bytes, None, most).map(|scene| scene.mesh)
}

/// Reads a Bezier patch file.
///
/// # Errors
/// The fault and its place.
pub fn bpt(bytes: &[u8]) -> Result<Vec<BezierPatch>, String> {
    bpt::parse(bytes).map(|bpt| bpt.patches)
}

/// Reads a PNG of at most `most` pixels as heights.
///
/// # Errors
/// The fault.
pub fn height_png(bytes: &[u8], most: u64) -> Result<Heights, String> {
    let heights = height::decode(Cursor::new(bytes), most)?;
    Ok((heights.width, heights.height, heights.texels))
}

/// Drops faces whose corners coincide, as with every mesh that is read.
pub fn without_collapsed(mesh: &mut PolygonMesh) {
    let places = FacePlaces::Lines((1..=mesh.faces.len()).collect());
    let mut draft = Draft::new(std::mem::take(mesh), places);
    collapsed::repair(&mut draft);
    *mesh = draft.mesh;
}

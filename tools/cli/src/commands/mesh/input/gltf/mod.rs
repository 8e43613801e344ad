//! glTF and GLB files: the triangles of all meshes of a scene.
//!
//! [`container`] splits GLB files, [`document`] reads the JSON, [`buffers`] fetches the bytes that
//! it names, [`accessor`] checks and reads them, [`scene`] walks the nodes, [`primitive`] makes faces.
//! Messages begin with the JSON path of what is wrong.

mod accessor;
mod buffers;
mod container;
mod document;
mod primitive;
mod scene;

use accessor::Data;
use buffers::LoadedBuffers;
use document::broken;
use primitive::PlacedPrimitive;
use scene::out_of_range;
use std::path::{Path, PathBuf};
use tess_surface::PolygonMesh;

/// Most vertices and most triangles of a scene. Nodes can repeat a mesh, so that a small file can
/// have any number of them; this many take about 8 GiB.
pub(crate) const MOST: usize = 1 << 26;

/// The content of a file.
#[derive(Debug, Default)]
pub(crate) struct Scene {
    /// The triangles of all nodes, in the scene's coordinates.
    pub(crate) mesh: PolygonMesh,
    /// The first face and the name of every primitive of every node.
    pub(crate) runs: Vec<(usize, String)>,
    /// The files beside that buffers were read from.
    pub(crate) files: Vec<PathBuf>,
}

/// Reads the default scene, or the first one, with its nodes' transforms applied. Buffers may be files in `folder` or
/// below it; `most` limits vertices and triangles. Errors: the first rule of glTF that is broken, with its JSON path.
pub(crate) fn parse(bytes: &[u8], folder: Option<&Path>, most: usize) -> Result<Scene, String> {
    let (json, blob) = container::split(bytes)?;
    let document = document::parse(json)?;
    accessor::check(&document)?;
    let nodes = scene::nodes(&document)?;
    let LoadedBuffers { contents, files } = buffers::load(&document.buffers, folder, blob)?;
    let data = Data { document: &document, buffers: contents };
    let mut scene = Scene { files, ..Scene::default() };
    for (number, transform) in nodes {
        let Some(mesh) = document.nodes[number].mesh else { continue };
        let primitives = &document.meshes.get(mesh).ok_or_else(|| {
            let what = out_of_range(mesh, document.meshes.len(), "meshes");
            broken(format!("nodes[{number}].mesh"), what)
        })?;
        for (k, primitive) in primitives.primitives.iter().enumerate() {
            let path = format!("meshes[{mesh}].primitives[{k}]");
            scene.runs.push((scene.mesh.faces.len(), format!("nodes[{number}], {path}")));
            let placed = PlacedPrimitive { data: &data, primitive, path: &path, transform };
            placed.append(&mut scene.mesh, most)?;
        }
    }
    Ok(scene)
}

//! glTF and GLB files: the triangles of all meshes of a scene, in the pose at rest.
//!
//! [`container`] splits GLB files, [`document`] parses the JSON, [`buffers`] loads the bytes that
//! it refers to, [`accessor`] checks and reads them, [`scene`] walks the nodes, [`pose`] moves
//! vertices by morph targets, skins and nodes, and [`primitive`] makes faces. Messages begin with
//! the JSON path of the faulty value.

mod accessor;
mod buffers;
mod container;
mod document;
mod pose;
mod primitive;
mod scene;

use super::tally::Tally;
use accessor::Data;
use buffers::LoadedBuffers;
use document::{Document, broken};
use pose::Pose;
use primitive::{PlacedPrimitive, Skipped};
use scene::{Nodes, out_of_range};
use std::path::{Path, PathBuf};
use tess_surface::PolygonMesh;

/// The largest number of vertices, and of triangles, in a scene. Nodes can repeat a mesh, so a
/// small file can have any number of them; this many need about 8 GiB.
pub(crate) const MOST: usize = 1 << 26;

/// The contents of a file.
#[derive(Debug, Default)]
pub(crate) struct Scene {
    /// The triangles of all nodes, in the scene's coordinates.
    pub(crate) mesh: PolygonMesh,
    /// The first face and the name of every primitive of every node.
    pub(crate) runs: Vec<(usize, String)>,
    /// The other files from which buffers were read.
    pub(crate) files: Vec<PathBuf>,
    /// Notes on the parts that were left out.
    pub(crate) notes: Vec<String>,
}

/// Reads the default scene, or the first one, with morph targets, skins and the transforms of nodes
/// applied. Buffers may be files in `folder` or below it; `most` limits vertices and triangles.
/// Errors: the first broken rule of glTF, with its JSON path.
pub(crate) fn parse(bytes: &[u8], folder: Option<&Path>, most: usize) -> Result<Scene, String> {
    let (json, blob) = container::split(bytes)?;
    let document = document::parse(json)?;
    accessor::check(&document)?;
    let nodes = Nodes::of(&document)?;
    let LoadedBuffers { contents, files } = buffers::load(&document.buffers, folder, blob)?;
    let data = Data { document: &document, buffers: contents };
    let mut scene = Scene { files, ..Scene::default() };
    let mut skipped = Skipped::default();
    for &number in &nodes.seen {
        let Some(mesh) = document.nodes[number].mesh else { continue };
        let primitives = &document.meshes.get(mesh).ok_or_else(|| {
            let what = out_of_range(mesh, document.meshes.len(), "meshes");
            broken(format!("nodes[{number}].mesh"), what)
        })?;
        let pose = Pose::of(&data, &nodes, number)?;
        for (k, primitive) in primitives.primitives.iter().enumerate() {
            let path = format!("meshes[{mesh}].primitives[{k}]");
            scene.runs.push((scene.mesh.faces.len(), format!("nodes[{number}], {path}")));
            let placed = PlacedPrimitive { data: &data, primitive, path: &path, pose: &pose };
            placed.append(&mut scene.mesh, &mut skipped, most)?;
        }
    }
    scene.notes = notes(&document, &nodes, &skipped);
    Ok(scene)
}

/// Notes on the parts that were left out.
fn notes(document: &Document, nodes: &Nodes, skipped: &Skipped) -> Vec<String> {
    let animations = Tally::of(document.animations.len(), || "animations[0]".to_owned());
    let mut instanced = Tally::default();
    for number in nodes
        .seen
        .iter()
        .filter(|&&node| document.nodes[node].extensions.contains_key("EXT_mesh_gpu_instancing"))
    {
        instanced.add(|| format!("nodes[{number}]"));
    }
    let once = "the mesh is there once, as EXT_mesh_gpu_instancing is not read";
    let notes = [
        skipped.lines.note(
            "primitive",
            " of points or lines",
            "left out, as these have no surface",
        ),
        skipped.unplaced.note("primitive", " without POSITION", "left out"),
        skipped.rest.note(
            "primitive",
            " with indices that make no whole triangle",
            "those are left out",
        ),
        animations.note(
            "animation",
            "",
            "not applied; the model is in the pose that it has at rest",
        ),
        instanced.note("node", " with instances", once),
    ];
    notes.into_iter().flatten().collect()
}

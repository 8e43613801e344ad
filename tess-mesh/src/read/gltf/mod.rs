//! glTF and GLB files: the triangles of all meshes of a scene, in the pose at rest.
//!
//! [`container`] splits GLB files, [`document`] parses the JSON, [`buffers`] loads the bytes that
//! it refers to, [`accessor`] checks and reads them, [`scene`] walks the nodes, [`pose`] moves
//! vertices by morph targets, skins and nodes, [`primitive`] makes faces, and [`material`] keeps
//! what describes materials. Messages begin with the JSON path of the faulty value.

mod accessor;
mod buffers;
mod container;
mod document;
mod material;
mod pose;
mod primitive;
mod scene;

use crate::budget::Budget;
use crate::parts::{Channel, Materials, Part};
use crate::repair::tally::Tally;
use accessor::Data;
use buffers::Buffers;
use document::{Document, broken};
use pose::{Pose, Skins};
use primitive::{Appended, PlacedPrimitive, Skipped};
use scene::Nodes;
use std::path::{Path, PathBuf};
use tess_surface::{Address, PolygonMesh};

/// How a file is read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request<'a> {
    /// The folder of other files that the file refers to.
    pub(crate) folder: Option<&'a Path>,
    /// The number of the scene, if it is not the default one.
    pub(crate) scene: Option<usize>,
    /// Whether the surface has normals.
    pub(crate) uses_normals: bool,
    pub(crate) budget: &'a Budget,
}

/// The contents of a file.
#[derive(Debug, Default)]
pub(crate) struct Scene {
    /// The triangles of all nodes, in the scene's coordinates.
    pub(crate) mesh: PolygonMesh,
    /// Further values at the positions.
    pub(crate) channels: Vec<Channel>,
    /// The first face, the name and the part of every primitive of every node.
    pub(crate) runs: Vec<(usize, String, Part)>,
    /// The materials.
    pub(crate) materials: Materials,
    /// How images continue beyond their borders, if a material of the scene has an image.
    pub(crate) address: Option<[Address; 2]>,
    /// The other files from which buffers were read.
    pub(crate) files: Vec<PathBuf>,
    /// Notes on the parts that were left out.
    pub(crate) notes: Vec<String>,
}

/// Reads a scene with morph targets, skins and the transforms of nodes applied. `progress` gets the
/// number of nodes that have been read, and their number. Errors: the first broken rule of glTF
/// that something visible needs, with its JSON path; a scene that shows no triangle.
pub(crate) fn parse(
    bytes: &[u8],
    request: &Request<'_>,
    progress: &dyn Fn(usize, usize),
) -> Result<Scene, String> {
    let Request { folder, budget, .. } = *request;
    let mut broken_lengths = Vec::new();
    let (json, blob) = container::split(bytes, |place| broken_lengths.push(place))?;
    let document = document::parse(json, budget)?;
    broken_lengths.into_iter().for_each(|place| document.irregular(|| place));
    let nodes = Nodes::of(&document, request.scene)?;
    let buffers = Buffers::new(document.buffers.len(), folder, blob, budget);
    let data = Data::new(&document, buffers, budget);
    let mut appended = Appended::default();
    let mut runs = Vec::new();
    let mut skins = Skins::default();
    for (done, &number) in nodes.seen.iter().enumerate() {
        progress(done, nodes.seen.len());
        read_node(&data, &nodes, number, request, &mut skins, &mut appended, &mut runs)?;
    }
    let Appended { mesh, mut channels, skipped } = appended;
    for channel in &mut channels {
        channel.values.resize(mesh.positions.len(), channel.kind.default_value());
    }
    if mesh.faces.is_empty() {
        return Err(nothing_shown(&document, &nodes, &skipped));
    }
    let materials = material::materials(&data);
    let address = material::address(&document, runs.iter().filter_map(|(.., part)| part.material));
    let notes = notes(&document, &nodes, &skipped);
    drop(nodes);
    let files = data.buffers.files.take();
    Ok(Scene { mesh, channels, runs, materials, address, files, notes })
}

/// Appends the primitives of a node's mesh.
fn read_node(
    data: &Data<'_>,
    nodes: &Nodes<'_>,
    number: usize,
    request: &Request<'_>,
    skins: &mut Skins,
    appended: &mut Appended,
    runs: &mut Vec<(usize, String, Part)>,
) -> Result<(), String> {
    let document = data.document;
    let node = document.nodes.get(number, format!("nodes[{number}]"))?;
    let Some(mesh) = node.mesh else { return Ok(()) };
    let found = document.meshes.get(mesh, format!("nodes[{number}].mesh"))?;
    let place = format!("nodes[{number}].mesh");
    // Nodes can repeat meshes of many primitives.
    let charged = request.budget.charge(found.primitives.len() as u64, 64, "primitives");
    charged.map_err(|what| broken(&place, what))?;
    let pose = Pose::of(data, nodes, skins, number)?;
    for (k, primitive) in found.primitives.iter().enumerate() {
        let path = format!("meshes[{mesh}].primitives[{k}]");
        let first = appended.mesh.faces.len();
        let uses_normals = request.uses_normals;
        let placed = PlacedPrimitive { data, primitive, path: &path, pose: &pose, uses_normals };
        let Some(channels) = placed.append(appended)? else { continue };
        let charged = request.budget.charge(1, 512, "parts");
        charged.map_err(|what| broken(&place, what))?;
        let material = primitive.material().filter(|&number| {
            let is_there = number < document.materials.materials.len();
            if !is_there {
                document.irregular(|| format!("{path}.material"));
            }
            is_there
        });
        let part = Part {
            node: number,
            object: node.name(),
            group: found.name(),
            material,
            has_texcoords: appended.mesh.faces[first].texcoords.is_some(),
            channels,
        };
        runs.push((first, format!("nodes[{number}], {path}"), part));
    }
    Ok(())
}

/// The message for a scene without triangles: what it shows, and what would show some.
fn nothing_shown(document: &Document, nodes: &Nodes<'_>, skipped: &Skipped) -> String {
    if skipped.lines.count() + skipped.unplaced.count() + skipped.rest.count() > 0 {
        let left_out = skipped.notes().into_iter().flatten().collect::<Vec<_>>();
        return format!("there is no face: {}", left_out.join("; "));
    }
    let scene = match nodes.scene {
        Some(number) => format!("scenes[{number}]"),
        None => "the file".to_owned(),
    };
    if document.meshes.len() == 0 {
        return format!("there is no face: {scene} is shown, and the file has no mesh");
    }
    if nodes.hidden.count() > 0 {
        return format!(
            "there is no face: KHR_node_visibility hides {} nodes of {scene}",
            nodes.hidden.count()
        );
    }
    let shows = |number: &usize| {
        let other = Nodes::of(document, Some(*number));
        let has_mesh =
            |&node: &usize| document.nodes.get(node, "").is_ok_and(|node| node.mesh.is_some());
        other.is_ok_and(|other| other.seen.iter().any(has_mesh))
    };
    // A file may have very many scenes.
    if let Some(other) = (0..document.scenes.len().min(64)).find(shows) {
        return format!(
            "there is no face: {scene} is shown, and none of its nodes has a mesh; scene {other} \
             has some"
        );
    }
    let with_mesh = (0..document.nodes.len())
        .find(|&node| document.nodes.get(node, "").is_ok_and(|node| node.mesh.is_some()));
    match with_mesh {
        Some(node) => format!(
            "there is no face: {scene} is shown, and none of its nodes has a mesh; nodes[{node}] \
             has one, and would be shown as one of the scene's nodes"
        ),
        None => format!(
            "there is no face: no node has a mesh; a node with `\"mesh\": 0` in {scene} would show \
             the first"
        ),
    }
}

impl Skipped {
    /// Notes on primitives.
    fn notes(&self) -> [Option<String>; 4] {
        [
            self.lines.note(
                "primitive",
                " of points or lines",
                "left out, as these have no surface",
            ),
            self.unplaced.note("primitive", " without POSITION", "left out"),
            self.rest.note(
                "primitive",
                " with indices that make no whole triangle",
                "those are left out",
            ),
            self.attributes.note("attribute", " that cannot be read", "left out"),
        ]
    }
}

/// Notes on the parts that were left out.
fn notes(document: &Document, nodes: &Nodes<'_>, skipped: &Skipped) -> Vec<String> {
    let animations = Tally::of(document.animations, || "animations[0]".to_owned());
    let mut instanced = Tally::default();
    for &number in &nodes.seen {
        let node = document.nodes.get(number, "");
        if node.is_ok_and(|node| node.extensions.contains_key("EXT_mesh_gpu_instancing")) {
            instanced.add(|| format!("nodes[{number}]"));
        }
    }
    let once = "the mesh is there once, as EXT_mesh_gpu_instancing is not read";
    let hidden = "left out, with all below it";
    let irregular = document.irregular.borrow();
    let unneeded = "read all the same, as the surface does not depend on it";
    let notes = [
        animations.note(
            "animation",
            "",
            "not applied; the model is in the pose that it has at rest",
        ),
        instanced.note("node", " with instances", once),
        nodes.hidden.note("node", " that KHR_node_visibility hides", hidden),
        irregular.note("value", " that breaks a rule of glTF", unneeded),
    ];
    skipped.notes().into_iter().chain(notes).flatten().collect()
}

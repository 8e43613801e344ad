//! Reading models.
//!
//! Every reader takes the bytes of a file and gives what they hold or says what is wrong and where;
//! [`load`] adds the file's name.

mod bpt;
mod collapsed;
#[cfg(feature = "fuzzing")]
pub mod fuzzing;
mod gltf;
pub(crate) mod height;
mod obj;
mod text;

use crate::failure::Failure;
use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use tess_surface::{MeshError, MeshFault, Model, PolygonMesh, Style, teapot};

/// Which way is up in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Up {
    /// +y, as in glTF and most OBJ files
    Y,
    /// +z, as in Bezier patch files
    Z,
}

/// A model and what its kind of file implies.
#[derive(Debug)]
pub(crate) struct Input {
    /// The patches.
    pub(crate) model: Model,
    /// Which way is up.
    pub(crate) up: Up,
    /// Notes for the user on what was left out.
    pub(crate) notes: Vec<String>,
    /// The files beside the model's own that were read.
    pub(crate) files: Vec<PathBuf>,
}

/// Where each face of a mesh stands in its file.
#[derive(Debug)]
enum FacePlaces {
    /// The line of each face.
    Lines(Vec<usize>),
    /// The first face of each run of triangles, and the run's name.
    Runs(Vec<(usize, String)>),
}

impl FacePlaces {
    /// The place of a face, such as `line 12`.
    fn of(&self, face: usize) -> String {
        match self {
            Self::Lines(lines) => format!("line {}", lines[face]),
            Self::Runs(runs) => {
                let after = runs.partition_point(|&(first, _)| first <= face);
                let (first, name) = &runs[after - 1];
                format!("{name}, triangle {}", face - first)
            }
        }
    }
}

/// Reads a model file, or makes the teapot if there is none. Errors: a file that cannot be read, is of no known kind
/// or is malformed; a model that cannot be tessellated. The message has file and line, or file and face.
pub(crate) fn load(path: Option<&Path>, style: Option<Style>) -> Result<Input, Failure> {
    let Some(path) = path else { return embedded_teapot(style) };
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let in_file = |what: String| Failure::bad_input(format!("{}: {what}", path.display()));
    let loaded = match extension.to_ascii_lowercase().as_str() {
        "obj" => load_obj(&read(path)?, style),
        "gltf" | "glb" => load_gltf(&read(path)?, path, style),
        "bpt" if style.is_some() => return Err(style_of_patches(&path.display().to_string())),
        "bpt" => load_bpt(&read(path)?),
        _ => {
            return Err(Failure::bad_input(format!(
                "cannot tell what {} is: models are .obj, .gltf, .glb or .bpt files",
                path.display()
            )));
        }
    };
    loaded.map_err(in_file)
}

fn load_obj(bytes: &[u8], style: Option<Style>) -> Result<Input, String> {
    let obj::Obj { mesh, lines, skipped } = obj::parse(bytes)?;
    let mut input = polygons(mesh, &FacePlaces::Lines(lines), style)?;
    if skipped > 0 {
        input.notes.push(format!("points and lines have no surface: {skipped} are left out"));
    }
    Ok(input)
}

fn load_gltf(bytes: &[u8], path: &Path, style: Option<Style>) -> Result<Input, String> {
    let gltf::Scene { mesh, runs, files } = gltf::parse(bytes, path.parent(), gltf::MOST)?;
    Ok(Input { files, ..polygons(mesh, &FacePlaces::Runs(runs), style)? })
}

fn load_bpt(bytes: &[u8]) -> Result<Input, String> {
    let bpt::Bpt { patches, lines } = bpt::parse(bytes)?;
    let place = |patch: usize| format!("patch {} at line {}", patch + 1, lines[patch]);
    let model = Model::bezier(patches).map_err(|error| refused(error, place))?;
    Ok(Input { model, up: Up::Z, notes: Vec::new(), files: Vec::new() })
}

fn embedded_teapot(style: Option<Style>) -> Result<Input, Failure> {
    if style.is_some() {
        return Err(style_of_patches("the teapot"));
    }
    let model = Model::bezier(teapot::patches());
    let model = model.map_err(|error| Failure::bad_input(format!("the teapot: {error}")))?;
    Ok(Input { model, up: Up::Z, notes: Vec::new(), files: Vec::new() })
}

fn style_of_patches(what: &str) -> Failure {
    Failure::bad_input(format!(
        "--surface is for triangles and quads; {what} is made of Bezier patches"
    ))
}

/// The most bytes of a model file: a GLB has no more.
const MOST_BYTES: u64 = 1 << 32;

/// Reads a model file. Refuses devices and pipes, which may have no end.
fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let cannot = |error: std::io::Error| Failure::file("read", path, &error);
    let found = fs::metadata(path).map_err(cannot)?;
    let refused = |why: &str| Failure::bad_input(format!("cannot read {}: {why}", path.display()));
    if !found.is_file() {
        return Err(refused("it is not an ordinary file"));
    }
    if found.len() > MOST_BYTES {
        return Err(refused("it is larger than 4 GiB"));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(MOST_BYTES).read_to_end(&mut bytes))
        .map_err(cannot)?;
    Ok(bytes)
}

/// The model of a polygon mesh, without what has collapsed.
fn polygons(
    mut mesh: PolygonMesh,
    places: &FacePlaces,
    style: Option<Style>,
) -> Result<Input, String> {
    let count = mesh.faces.len();
    let collapsed = collapsed::repair(&mut mesh);
    if mesh.faces.is_empty() && count > 0 {
        return Err(format!("all faces, {count}, have no area"));
    }
    let place = |face| places.of(collapsed.original(face));
    let model = Model::polygons(mesh, style.unwrap_or(Style::PointNormal));
    let model = model.map_err(|error| refused(error, place))?;
    let mut notes = collapsed.notes();
    if model.crowded_edges() > 0 {
        notes.push(format!(
            "surfaces touch at edges: each of {} has more than two faces, which are neighbours in pairs",
            model.crowded_edges()
        ));
    }
    Ok(Input { model, up: Up::Y, notes, files: Vec::new() })
}

/// The message about a model whose faces are named by `place`, such as `line 12`.
fn refused(error: MeshError, place: impl Fn(usize) -> String) -> String {
    match error {
        MeshError::Face { face, fault: MeshFault::NonManifold { others: [a, b] } } => format!(
            "{}: an edge of this face belongs to two other faces already ({} and {}); \
             a mesh must be manifold, or as many faces must run one way along an edge as the other",
            place(face),
            place(a),
            place(b)
        ),
        MeshError::Face { face, fault } => format!("{}: {fault}", place(face)),
        error => error.to_string(),
    }
}

//! Readers of models.
//!
//! Every reader takes the bytes of a file, and returns their contents or the fault and its place;
//! [`load`] adds the file's name.

mod bpt;
mod collapsed;
mod draft;
mod faces;
#[cfg(feature = "fuzzing")]
pub mod fuzzing;
mod gltf;
pub(crate) mod height;
mod obj;
mod polygon;
mod tally;
mod text;
mod weld;

use crate::failure::Failure;
use draft::{Draft, FacePlaces};
use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use tally::Tally;
use tess_surface::{Face, HalfEdge, MeshError, Model, PolygonMesh, Style, teapot};

/// The direction that is up in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Up {
    /// +y, as in glTF and most OBJ files
    Y,
    /// +z, as in Bezier patch files
    Z,
}

/// Options for reading a model.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InputOptions {
    /// The surface of polygons, if one was selected.
    pub(crate) style: Option<Style>,
    /// Whether gaps between faces are closed.
    pub(crate) weld: Weld,
}

/// The closing of gaps between faces.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) enum Weld {
    /// Gaps stay open, with a note.
    #[default]
    No,
    /// Gaps up to this width are closed; without a width, those that rounding causes.
    UpTo(Option<f32>),
}

/// A model, with the defaults that its kind of file implies.
#[derive(Debug)]
pub(crate) struct Input {
    /// The patches.
    pub(crate) model: Model,
    /// The direction that is up.
    pub(crate) up: Up,
    /// Notes for the user on parts that were changed or left out.
    pub(crate) notes: Vec<String>,
    /// The other files that were read.
    pub(crate) files: Vec<PathBuf>,
    /// The range of the texture coordinates.
    pub(crate) texcoords: TexcoordRange,
}

/// The range of a model's texture coordinates.
#[derive(Clone, Debug)]
pub(crate) struct TexcoordRange {
    /// Whether all are within 0 and 1, except for rounding.
    pub(crate) is_unit: bool,
    /// A note about the faces without texture coordinates; each of them gets the whole image.
    pub(crate) missing: Option<String>,
}

impl TexcoordRange {
    fn of(mesh: &PolygonMesh, draft: &Draft) -> Self {
        const ROUNDING: f32 = 1e-4;
        let is_unit = |face: &Face| {
            let indices = face.texcoords.as_ref().map_or(&[][..], |indices| indices.as_slice());
            let texcoords = indices.iter().map(|&index| mesh.texcoords[index as usize]);
            let inside = |x: f32| (-ROUNDING..=1.0 + ROUNDING).contains(&x);
            texcoords.fold(true, |all, texcoord| all && inside(texcoord.x) && inside(texcoord.y))
        };
        let mut missing = Tally::default();
        for (number, _) in mesh.faces.iter().enumerate().filter(|(_, f)| f.texcoords.is_none()) {
            missing.add(|| draft.place(number));
        }
        Self { is_unit: mesh.faces.iter().all(is_unit), missing: Self::note(&missing, "face") }
    }

    /// The texture coordinates of Bezier patches are their domain coordinates.
    fn of_patches(count: usize, first: impl FnOnce() -> String) -> Self {
        Self { is_unit: true, missing: Self::note(&Tally::of(count, first), "Bezier patch") }
    }

    fn note(missing: &Tally, noun: &str) -> Option<String> {
        missing.note(noun, " without texture coordinates", "each gets the whole height image")
    }
}

/// Reads a model file, or makes the teapot if there is none. Errors: a file that cannot be read, is
/// of an unknown kind or is malformed; a model that cannot be tessellated. The message names the
/// file and the line or face.
pub(crate) fn load(path: Option<&Path>, options: InputOptions) -> Result<Input, Failure> {
    let Some(path) = path else { return embedded_teapot(options) };
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let in_file = |what: String| Failure::bad_input(format!("{}: {what}", path.display()));
    let loaded = match extension.to_ascii_lowercase().as_str() {
        "obj" => load_obj(&read(path)?, options),
        "gltf" | "glb" => load_gltf(&read(path)?, path, options),
        "bpt" => {
            options.refuse_for_patches(&path.display().to_string())?;
            load_bpt(&read(path)?)
        }
        _ => {
            return Err(Failure::bad_input(format!(
                "cannot tell what {} is: models are .obj, .gltf, .glb or .bpt files",
                path.display()
            )));
        }
    };
    loaded.map_err(in_file)
}

fn load_obj(bytes: &[u8], options: InputOptions) -> Result<Input, String> {
    let obj::Obj { mesh, lines, notes } = obj::parse(bytes)?;
    polygons(Draft::new(mesh, FacePlaces::Lines(lines)), notes, options)
}

fn load_gltf(bytes: &[u8], path: &Path, options: InputOptions) -> Result<Input, String> {
    let gltf::Scene { mesh, runs, files, notes } = gltf::parse(bytes, path.parent(), gltf::MOST)?;
    let input = polygons(Draft::new(mesh, FacePlaces::Runs(runs)), notes, options)?;
    Ok(Input { files, ..input })
}

fn load_bpt(bytes: &[u8]) -> Result<Input, String> {
    let bpt::Bpt { patches, lines } = bpt::parse(bytes)?;
    let place = |patch: usize| format!("patch {} at line {}", patch + 1, lines[patch]);
    let model = Model::bezier(patches).map_err(|error| refused(error, place))?;
    let notes = notes_of_edges(&model, "patch", place);
    let texcoords = TexcoordRange::of_patches(model.len(), || place(0));
    Ok(Input { model, up: Up::Z, notes, files: Vec::new(), texcoords })
}

fn embedded_teapot(options: InputOptions) -> Result<Input, Failure> {
    options.refuse_for_patches("the teapot")?;
    let model = Model::bezier(teapot::patches());
    let model = model.map_err(|error| Failure::bad_input(format!("the teapot: {error}")))?;
    let texcoords = TexcoordRange::of_patches(model.len(), || "patch 1".to_owned());
    Ok(Input { model, up: Up::Z, notes: Vec::new(), files: Vec::new(), texcoords })
}

impl InputOptions {
    /// Refuses options for polygons if the model consists of Bezier patches.
    fn refuse_for_patches(self, what: &str) -> Result<(), Failure> {
        let option = match self {
            Self { style: Some(_), .. } => "--surface",
            Self { weld: Weld::UpTo(_), .. } => "--weld",
            _ => return Ok(()),
        };
        Err(Failure::bad_input(format!(
            "{option} is for triangles and quads; {what} is made of Bezier patches"
        )))
    }
}

/// The largest size of a model file in bytes, which is also that of a GLB file.
const MOST_BYTES: u64 = 1 << 32;

/// Reads a model file. Devices and pipes are refused, because they may be endless.
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

/// The model of a polygon mesh, after repairs. `notes` are those of its reader.
fn polygons(mut draft: Draft, notes: Vec<String>, options: InputOptions) -> Result<Input, String> {
    let style = options.style.unwrap_or(Style::PointNormal);
    let count = draft.mesh.faces.len();
    draft.notes = notes;
    repair(&mut draft, style);
    if draft.mesh.faces.is_empty() && count > 0 {
        return Err(format!("all faces, {count}, have no area"));
    }
    if let Weld::UpTo(reach) = options.weld {
        let welded =
            weld::weld(&mut draft, reach, |mesh| Model::polygons(mesh.clone(), Style::Flat));
        welded.map_err(|error| refused(error, |face| draft.place(face)))?;
    }
    let mesh = std::mem::take(&mut draft.mesh);
    let model = Model::polygons(mesh, style);
    let model = model.map_err(|error| refused(error, |face| draft.place(face)))?;
    let mesh = model.mesh().expect("it was made of a mesh");
    let notes = notes_of_edges(&model, "face", |face| draft.place(face));
    draft.notes.extend(notes);
    if matches!(options.weld, Weld::No) {
        weld::Gaps::of(&model, mesh, None).warn(&mut draft);
    }
    let texcoords = TexcoordRange::of(mesh, &draft);
    Ok(Input { model, up: Up::Y, notes: draft.notes, files: Vec::new(), texcoords })
}

/// Repairs each face by itself.
fn repair(draft: &mut Draft, style: Style) {
    if style == Style::Flat {
        draft.mesh.faces.iter_mut().for_each(|face| face.normals = None);
    }
    faces::cut_concave_quads(draft);
    collapsed::repair(draft);
    faces::drop_bad_normals(draft);
}

/// Notes on edges of more than two faces, which are called `noun` and located by `place`.
fn notes_of_edges(model: &Model, noun: &str, place: impl Fn(usize) -> String) -> Vec<String> {
    let at = |half: HalfEdge| place(half.patch);
    let crowded = model.crowded_edges();
    let paired = Tally::of(crowded.len(), || at(crowded[0]));
    let seams = model.seams();
    // The surplus side is the last one in the file.
    let alone =
        Tally::of(seams.len(), || seams[0].last().map_or_else(String::new, |&side| at(side)));
    let nouns = if noun == "patch" { "patches" } else { "faces" };
    let rest = format!(" of more than two {nouns}");
    let pairs =
        format!("the {nouns} are neighbours in pairs, as where surfaces touch or have two sides");
    let seam = format!("{nouns} there keep their own normals, as there is no single neighbour");
    let notes = [paired.note("edge", &rest, &pairs), alone.note("edge", &rest, &seam)];
    notes.into_iter().flatten().collect()
}

/// The message about a model whose faces are located by `place`, for example at `line 12`.
fn refused(error: MeshError, place: impl Fn(usize) -> String) -> String {
    match error {
        MeshError::Face { face, fault } => format!("{}: {fault}", place(face)),
        error => error.to_string(),
    }
}

//! Models from files: reading, repairs, and the model that results.
//!
//! Every reader takes the bytes of a file, and returns their contents or the fault and its place;
//! [`load`] adds the file's name.

use crate::budget::{Budget, MAX_MEMORY};
use crate::error::{LoadError, LoadErrorKind};
use crate::parts::{Channel, Materials, Part, Parts};
use crate::read::{bpt, gltf, mtl, obj};
use crate::repair::draft::{Draft, FacePlaces};
use crate::repair::tally::Tally;
use crate::repair::{collapsed, faces, weld};
use crate::texcoords;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use tess_surface::{Address, Creases, HalfEdge, MeshError, Model, Style};

/// The direction that is up in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Up {
    /// +y, as in glTF and most OBJ files.
    Y,
    /// +z, as in Bezier patch files.
    Z,
}

/// Options for reading a model.
#[derive(Clone, Copy, Debug)]
pub struct LoadOptions {
    /// The surface of polygons; point-normal if none was selected.
    pub style: Option<Style>,
    /// Whether gaps between faces are closed.
    pub weld: Weld,
    /// The largest angle between the normals of neighbours, in degrees, at which the edge between
    /// them is smooth. It matters only to faces without normals, and only where the file does not
    /// say which edges are smooth: OBJ files have smoothing groups, and faces of glTF files without
    /// normals are flat.
    pub crease: f32,
    /// The number of the glTF scene to read, if it is not the file's default one.
    pub scene: Option<usize>,
    /// The largest memory in bytes that the contents of a file may take, about. A small file can
    /// repeat its contents any number of times.
    pub max_memory: u64,
}

/// The default of [`LoadOptions::crease`]: 30 degrees, as in modelling programs.
pub const CREASE: f32 = 30.0;

impl Default for LoadOptions {
    fn default() -> Self {
        Self { style: None, weld: Weld::No, crease: CREASE, scene: None, max_memory: MAX_MEMORY }
    }
}

/// The closing of gaps between faces.
#[derive(Clone, Copy, Debug, Default)]
pub enum Weld {
    /// Gaps stay open, with a note.
    #[default]
    No,
    /// Gaps up to this width are closed; without a width, those that rounding causes.
    UpTo(Option<f32>),
}

/// A model, with the defaults that its kind of file implies.
#[derive(Debug)]
pub struct Loaded {
    /// The patches.
    pub model: Model,
    /// Their names, materials and further values.
    pub parts: Parts,
    /// The direction that is up.
    pub up: Up,
    /// Notes for the user on parts that were changed or left out.
    pub notes: Vec<String>,
    /// The other files that were read.
    pub files: Vec<PathBuf>,
    /// How an image continues beyond its borders along u and v. A glTF file has it in the samplers
    /// of its textures. Otherwise an image repeats along an axis if texture coordinates are outside
    /// of 0 and 1, or if the surface closes there as a planet does at its date line; else it is
    /// clamped.
    pub address: [Address; 2],
    /// A note about the faces without texture coordinates; each of them gets the whole image.
    pub untextured: Option<String>,
}

/// The kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0, as JSON or as GLB.
    Gltf,
    /// Bezier patches.
    Bpt,
}

impl Format {
    /// The kind that a file's name implies, if it is a known one.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "obj" => Some(Self::Obj),
            "gltf" | "glb" => Some(Self::Gltf),
            "bpt" => Some(Self::Bpt),
            _ => None,
        }
    }
}

/// Sees how far a file has been read: from 0 to 1.
pub type Progress<'a> = &'a dyn Fn(f32);

/// Reads a model file of the kind that its name implies. Other files that it refers to must be in
/// its folder or below it.
///
/// # Errors
/// A file that cannot be read, is of an unknown kind or is malformed; a model that cannot be
/// tessellated. The message names the file and the line or face.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Loaded, LoadError> {
    load_watched(path, options, &|_| {})
}

/// As [`load`], and tells `progress` how far it is.
///
/// # Errors
/// Those of [`load`].
pub fn load_watched(
    path: &Path,
    options: &LoadOptions,
    progress: Progress<'_>,
) -> Result<Loaded, LoadError> {
    let format = Format::of(path).ok_or_else(|| {
        let shown = path.display();
        LoadError::new(
            LoadErrorKind::Format,
            format!("cannot tell what {shown} is: models are .obj, .gltf, .glb or .bpt files"),
        )
    })?;
    if format == Format::Bpt {
        options.refuse_for_patches(&path.display().to_string())?;
    }
    let bytes = read_bytes(path)?;
    read_watched(&bytes, format, path.parent(), options, progress)
        .map_err(|error| LoadError::new(error.kind(), format!("{}: {error}", path.display())))
}

/// Reads the bytes of a model file. Files that it refers to must be in `folder` or below it;
/// without a folder there can be none.
///
/// # Errors
/// Those of [`load`], without the name of the file.
pub fn read(
    bytes: &[u8],
    format: Format,
    folder: Option<&Path>,
    options: &LoadOptions,
) -> Result<Loaded, LoadError> {
    read_watched(bytes, format, folder, options, &|_| {})
}

fn read_watched(
    bytes: &[u8],
    format: Format,
    folder: Option<&Path>,
    options: &LoadOptions,
    progress: Progress<'_>,
) -> Result<Loaded, LoadError> {
    let budget = Budget::new(options.max_memory);
    let loaded = match format {
        Format::Obj => load_obj(bytes, folder, options, &budget, progress),
        Format::Gltf => load_gltf(bytes, folder, options, &budget, progress),
        Format::Bpt => {
            options.refuse_for_patches("the file")?;
            load_bpt(bytes, &budget)
        }
    };
    let kind = if budget.is_exceeded() { LoadErrorKind::Limit } else { LoadErrorKind::Content };
    loaded.map_err(|message| LoadError::new(kind, message))
}

/// The Newell teapot.
///
/// # Errors
/// Options for polygons.
pub fn teapot(options: &LoadOptions) -> Result<Loaded, LoadError> {
    options.refuse_for_patches("the teapot")?;
    let model = Model::bezier(tess_surface::teapot::patches())
        .map_err(|error| LoadError::new(LoadErrorKind::Content, format!("the teapot: {error}")))?;
    Ok(of_patches(model, Vec::new(), || "patch 1".to_owned()))
}

/// The model of Bezier patches. Their texture coordinates are their domain coordinates.
fn of_patches(model: Model, notes: Vec<String>, first: impl FnOnce() -> String) -> Loaded {
    let untextured = texcoords::note(&Tally::of(model.len(), first), "Bezier patch");
    let part = Part { has_texcoords: true, ..Part::default() };
    let parts = Parts { list: vec![part], ..Parts::default() };
    let address = [Address::Clamp; 2];
    Loaded { model, parts, up: Up::Z, notes, files: Vec::new(), address, untextured }
}

fn load_obj(
    bytes: &[u8],
    folder: Option<&Path>,
    options: &LoadOptions,
    budget: &Budget,
    progress: Progress<'_>,
) -> Result<Loaded, String> {
    let part = |done: usize| progress(done as f32 / bytes.len().max(1) as f32);
    let obj::Obj { mesh, lines, smoothing, parts, colors, materials, notes } =
        obj::parse(bytes, budget, &part)?;
    let nodes = numbered_nodes(parts, colors.is_some());
    let mut draft = Draft::new(mesh, FacePlaces::Lines(lines));
    draft.channels = colors.into_iter().collect();
    draft.notes = notes;
    let runs = Runs { parts: nodes, smoothing };
    let mut loaded = polygons(draft, &runs, materials, None, options)?;
    loaded.files = mtl::read(&mut loaded.parts, folder, budget);
    Ok(loaded)
}

/// The runs of an OBJ file's parts. Each object and group of one name is a node.
fn numbered_nodes(parts: Vec<(usize, Part)>, has_colors: bool) -> Vec<(usize, Part)> {
    let mut numbers = BTreeMap::new();
    let numbered = parts.into_iter().map(|(first, mut part)| {
        let count = numbers.len();
        let names = (part.object.clone(), part.group.clone());
        part.node = *numbers.entry(names).or_insert(count);
        part.channels = if has_colors { vec![0] } else { Vec::new() };
        (first, part)
    });
    numbered.collect()
}

fn load_gltf(
    bytes: &[u8],
    folder: Option<&Path>,
    options: &LoadOptions,
    budget: &Budget,
    progress: Progress<'_>,
) -> Result<Loaded, String> {
    let uses_normals = options.style != Some(Style::Flat);
    let request = gltf::Request { folder, scene: options.scene, uses_normals, budget };
    let part = |done: usize, all: usize| progress(done as f32 / all.max(1) as f32);
    let scene = gltf::parse(bytes, &request, &part)?;
    let gltf::Scene { mesh, channels, runs, materials, address, files, notes } = scene;
    let (mut places, mut parts) = (Vec::new(), Vec::new());
    for (first, place, part) in runs {
        places.push((first, place));
        parts.push((first, part));
    }
    // Faces without normals are flat (section 3.7.2.1).
    let smoothing = vec![(0, Some(0))];
    let mut draft = Draft::new(mesh, FacePlaces::Runs(places));
    draft.channels = channels;
    draft.notes = notes;
    let loaded = polygons(draft, &Runs { parts, smoothing }, materials, address, options)?;
    Ok(Loaded { files, ..loaded })
}

fn load_bpt(bytes: &[u8], budget: &Budget) -> Result<Loaded, String> {
    let bpt::Bpt { patches, lines } = bpt::parse(bytes, budget)?;
    let place = |patch: usize| format!("patch {} at line {}", patch + 1, lines[patch]);
    let model = Model::bezier(patches).map_err(|error| refused(error, place))?;
    let notes = notes_of_edges(&model, "patch", place);
    Ok(of_patches(model, notes, || place(0)))
}

impl LoadOptions {
    /// Refuses options for polygons if the model consists of Bezier patches.
    fn refuse_for_patches(&self, what: &str) -> Result<(), LoadError> {
        let option = match *self {
            Self { style: Some(_), .. } => "--surface",
            Self { weld: Weld::UpTo(_), .. } => "--weld",
            _ => return Ok(()),
        };
        Err(LoadError::new(
            LoadErrorKind::Option,
            format!("{option} is for triangles and quads; {what} is made of Bezier patches"),
        ))
    }
}

/// The largest size of a model file in bytes, which is also that of a GLB file.
const MOST_BYTES: u64 = 1 << 32;

/// Reads a model file. Devices and pipes are refused, because they may be endless.
fn read_bytes(path: &Path) -> Result<Vec<u8>, LoadError> {
    let refused = |why: &dyn std::fmt::Display| {
        LoadError::new(LoadErrorKind::File, format!("cannot read {}: {why}", path.display()))
    };
    let found = fs::metadata(path).map_err(|error| refused(&error))?;
    if !found.is_file() {
        return Err(refused(&"it is not an ordinary file"));
    }
    if found.len() > MOST_BYTES {
        return Err(refused(&"it is larger than 4 GiB"));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(MOST_BYTES).read_to_end(&mut bytes))
        .map_err(|error| refused(&error))?;
    Ok(bytes)
}

/// Runs of faces of a file, by the number of each run's first face.
struct Runs {
    parts: Vec<(usize, Part)>,
    smoothing: Vec<(usize, Option<u32>)>,
}

/// The value of the run that a face is in.
fn run_of<T>(runs: &[(usize, T)], face: usize) -> Option<&T> {
    let after = runs.partition_point(|&(first, _)| first <= face);
    runs.get(after.checked_sub(1)?).map(|(_, value)| value)
}

/// The model of a polygon mesh, after repairs.
fn polygons(
    mut draft: Draft,
    runs: &Runs,
    materials: Materials,
    address: Option<[Address; 2]>,
    options: &LoadOptions,
) -> Result<Loaded, String> {
    let style = options.style.unwrap_or(Style::PointNormal);
    let count = draft.mesh.faces.len();
    if count == 0 && !draft.notes.is_empty() {
        return Err(format!("there is no face: {}", draft.notes.join("; ")));
    }
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
    let faces = 0..mesh.faces.len();
    let group = |face| run_of(&runs.smoothing, draft.original(face)).copied().flatten();
    let groups: Vec<Option<u32>> = faces.map(group).collect();
    let least_cosine = libm::cosf(options.crease.clamp(0.0, 180.0).to_radians());
    let creases = Creases { least_cosine, groups: &groups };
    let model = Model::creased(mesh, style, &creases);
    let model = model.map_err(|error| refused(error, |face| draft.place(face)))?;
    add_notes(&mut draft, &model, options);
    let mesh = model.mesh().expect("it was made of a mesh");
    let range = texcoords::Range::of(mesh, |face| draft.place(face));
    let parts = parts_of(&draft, &model, &runs.parts, materials);
    Ok(Loaded {
        parts,
        up: Up::Y,
        notes: draft.notes,
        files: Vec::new(),
        address: address.unwrap_or_else(|| range.address()),
        untextured: texcoords::note(&range.missing, "face"),
        model,
    })
}

/// Adds the notes on edges.
fn add_notes(draft: &mut Draft, model: &Model, options: &LoadOptions) {
    let mesh = model.mesh().expect("it was made of a mesh");
    let creases = model.creases();
    let hard = Tally::of(creases.len(), || draft.place(creases[0].patch));
    let crease = options.crease;
    let done =
        format!("kept hard, as the file does not say which edges are smooth; --crease {crease}");
    draft.note(hard.note("edge", " of faces without normals", &done));
    let notes = notes_of_edges(model, "face", |face| draft.place(face));
    draft.notes.extend(notes);
    if let Some((count, face)) = weld::turned_over(model, mesh) {
        let turned = Tally::of(count, || draft.place(face));
        let done = "one of the faces has its outside where the other has its inside";
        draft.note(turned.note("edge", " along which both faces run the same way", done));
    }
    if matches!(options.weld, Weld::No) {
        weld::Gaps::of(model, mesh, None).warn(draft);
    }
}

/// The parts of a model: each run of the file, divided by whether faces have texture coordinates.
/// Runs of one node with one material are one part.
fn parts_of(draft: &Draft, model: &Model, runs: &[(usize, Part)], materials: Materials) -> Parts {
    let mesh = model.mesh().expect("it was made of a mesh");
    let mut numbers: BTreeMap<(usize, Option<usize>, bool, Vec<usize>), u32> = BTreeMap::new();
    let mut list: Vec<Part> = Vec::new();
    let mut of_patch = Vec::with_capacity(mesh.faces.len());
    // The number of the part that the last face of the same run and kind had.
    let mut last: Option<(usize, bool, u32)> = None;
    for (number, face) in mesh.faces.iter().enumerate() {
        let has_texcoords = face.texcoords.is_some();
        let original = draft.original(number);
        let run = runs.partition_point(|&(first, _)| first <= original);
        if let Some((_, _, part)) = last.filter(|&(r, has, _)| r == run && has == has_texcoords) {
            of_patch.push(part);
            continue;
        }
        let mut part = run
            .checked_sub(1)
            .and_then(|run| runs.get(run))
            .map_or_else(Part::default, |r| r.1.clone());
        part.has_texcoords = has_texcoords;
        let key = (part.node, part.material, has_texcoords, part.channels.clone());
        let number = *numbers.entry(key).or_insert_with(|| {
            list.push(part);
            u32::try_from(list.len() - 1).unwrap_or(u32::MAX)
        });
        last = Some((run, has_texcoords, number));
        of_patch.push(number);
    }
    if list.len() == 1 {
        of_patch = Vec::new();
    }
    let channels: Vec<Channel> = draft.channels.clone();
    Parts { list, of_patch, channels, materials }
}

/// Repairs each face by itself.
fn repair(draft: &mut Draft, style: Style) {
    if style == Style::Flat {
        draft.mesh.faces.iter_mut().for_each(|face| face.normals = None);
    }
    faces::drop_missing_values(draft);
    faces::cut_folded_quads(draft);
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

//! `tess mesh`: turns a model file into a tessellated mesh or a picture.
//!
//! The crate `tess-mesh` does the work; here are the arguments, the picture, the progress and the
//! statistics.
#![expect(clippy::float_arithmetic, reason = "surfaces and pictures are made of floats")]

mod outline;
mod output;
mod prefix;
mod size;
mod statistics;
mod view;

use crate::args::{Choices, choice, name_of};
use crate::failure::{Exit, Failure};
use crate::output::{OutputArgs, Role, form, note, progress, refuse_shared};
use crate::threads::start_pool;
use clap::builder::ValueParser;
use glam::Vec3;
use output::{MeshFile, Options, ResultForm};
use statistics::Statistics;
use std::io::Write;
use std::path::{Path, PathBuf};
use tess_core::Partitioning;
use tess_mesh::write::{GltfOptions, IndexWidth};
use tess_mesh::{
    Job, LoadError, LoadErrorKind, LoadOptions, Loaded, Totals, Weld, height, largest_factor,
};
use tess_surface::{Address, DisplacedModel, Displacement, FactorRule, HeightError, Model, Style};
use tess_verify::Named;
use view::{CameraView, ViewArgs};

/// Tessellate a model into a mesh or a picture
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Neighbouring patches get the same factor on their common edge, and the same points to the bit, so no crack opens between \
them. Corners are the same if their coordinates are equal. Where a corner is on the inside of another face's edge, or \
differs from another corner in its last digits, a crack may open: a note counts such corners, and --weld closes the gaps.

Edges are hard where the file says so: between the smoothing groups of an OBJ file (`s`), and around glTF faces without \
normals. Where it says nothing, --crease decides.

Some faces are changed; a note gives their number and the place of the first one. Polygons of more than four corners, \
concave quads and quads that cross themselves are cut into triangles. Faces without area are left out, and their neighbours \
are joined. Faces with a normal that is zero or NaN get smooth normals. Where more than two faces share an edge, each keeps \
its own normals. A face that occurs twice, once for each side, is two sheets. What the surface does not need, such as \
points, lines, and texture coordinates that are not there, is left out.

glTF models are in their pose at rest, with the weights of morph targets, the joints of skins and the \
transforms of nodes; animations are not applied. Buffers must be files in the model's folder or below it.

Meshes keep names, materials, colours, tangents and all texture coordinates; glTF keeps the images, by reference or embedded \
as in the input. Of an OBJ file's material libraries, glTF gets base colours (`Kd`), opacity and their images (`map_Kd`). Vertices that patches share are written once, except where normals or other values differ. The poses of \
skins and morph targets are applied, and animations are lost.

--displace maps the image by the model's texture coordinates, (0, 0) at the lower left. A face without texture coordinates \
gets the whole image, as does each Bezier patch.

Notes and statistics go to stderr.

Examples:
  tess mesh -o teapot.png                          the teapot, 64 segments to the patch edge
  tess mesh --factor 4 --wireframe -o teapot.png
  tess mesh bunny.obj --pixels 8 --eye 0,0.1,0.5 -o bunny.glb
  tess mesh rock.glb --displace height.png --height 0.1 --tolerance 0.01 -o rock.obj")]
pub(crate) struct MeshCommand {
    /// Model to read: .obj, .gltf, .glb or .bpt [default: the Newell teapot]
    #[arg(value_name = "IN")]
    input: Option<PathBuf>,
    /// File to write: .obj, .gltf or .glb for a mesh, .png for a picture; - is stdout
    ///
    /// A .gltf has its binary part in a .bin of the same name next to it. An existing .bin is
    /// replaced only if the existing .gltf refers to it.
    #[arg(short = 'o', value_name = "OUT", required = true)]
    output: PathBuf,
    /// Format of the result [default: from the file's name]
    #[arg(long, value_name = "NAME")]
    format: Option<ResultForm>,
    /// Surface of triangles and quads [default: pn]
    #[arg(long, value_name = "NAME", value_parser = choice(SURFACES))]
    surface: Option<Style>,
    /// Close gaps between faces, up to this width in the model's units
    ///
    /// Joins corners that are closer than this to each other, and splits edges at corners that are
    /// closer than this. Without a width, only gaps caused by rounding are closed: up to 1e-6 of
    /// the model's diagonal. Only edges of a single face can have gaps.
    #[arg(long, value_name = "LENGTH", num_args = 0..=1, require_equals = true)]
    #[arg(value_parser = ValueParser::new(positive))]
    weld: Option<Option<f32>>,
    /// Largest angle between two faces at which their edge is smooth, in degrees
    ///
    /// For faces without normals, where the file does not say which edges are smooth. With 180 all
    /// edges are smooth, with 0 all are hard.
    #[arg(long, value_name = "DEGREES", default_value_t = tess_mesh::CREASE)]
    #[arg(value_parser = ValueParser::new(angle_of_crease))]
    crease: f32,
    /// glTF scene to read, counted from 0 [default: the one that the file names]
    #[arg(long, value_name = "N")]
    scene: Option<usize>,
    /// Largest memory that the model may take when it is read, in MiB
    #[arg(long, value_name = "MIB", default_value_t = tess_mesh::MAX_MEMORY >> 20)]
    max_memory: u64,
    #[command(flatten)]
    rule: RuleArgs,
    /// Spacing of the cuts
    #[arg(long, value_name = "NAME", default_value = "integer")]
    #[arg(value_parser = name_of::<Partitioning>())]
    partitioning: Partitioning,
    /// Height image to displace the surface by: a PNG, black 0, white 1
    #[arg(long, value_name = "PNG")]
    displace: Option<PathBuf>,
    /// Displacement at height 1, in the model's units
    #[arg(long, value_name = "LENGTH", default_value = "0.1", allow_hyphen_values = true)]
    #[arg(value_parser = ValueParser::new(finite), requires = "displace")]
    height: f32,
    /// Heights beyond the image: `repeat` (the image again), `clamp` (the outermost pixels) or
    /// `mirror` (the image again, every second time reversed); for both axes, or for u and v, as in
    /// `repeat,clamp` [default: what the samplers of a glTF model say; otherwise, for each axis,
    /// repeat if texture coordinates are outside of 0 and 1 or the surface closes there, or else
    /// clamp]
    #[arg(long, value_name = "U[,V]", requires = "displace")]
    #[arg(value_parser = ValueParser::new(wrap))]
    wrap: Option<Wrap>,
    /// Largest height image to read, in pixels
    #[arg(long, value_name = "N", default_value = "64000000")]
    max_pixels: u64,
    /// Width of the indices in glTF
    #[arg(long, value_name = "BITS", default_value = "auto", value_parser = choice(WIDTHS))]
    indices: IndexWidth,
    /// Show the triangles' edges in pictures
    #[arg(long)]
    wireframe: bool,
    #[command(flatten)]
    view: ViewArgs,
}

/// The surfaces of triangles and quads.
const SURFACES: Choices<Style> = &[
    ("flat", Style::Flat, "Planes and bilinear quads"),
    (
        "pn",
        Style::PointNormal,
        "Point-normal triangles and quads, rounded by their corners' normals",
    ),
];

/// The widths of indices.
const WIDTHS: Choices<IndexWidth> = &[
    ("auto", IndexWidth::Auto, "16 bits if all vertices can be numbered with them, else 32"),
    ("16", IndexWidth::Bits16, "16 bits: at most 65535 vertices"),
    ("32", IndexWidth::Bits32, "32 bits"),
];

/// The continuation of a height image beyond its borders along u and v.
#[derive(Clone, Copy, Debug)]
struct Wrap([Address; 2]);

fn wrap(text: &str) -> Result<Wrap, String> {
    let mode = |name: &str| match name.trim() {
        "repeat" => Ok(Address::Repeat),
        "clamp" => Ok(Address::Clamp),
        "mirror" => Ok(Address::Mirror),
        _ => Err("modes are repeat, clamp and mirror; two with a comma are for u and v".to_owned()),
    };
    let (u, v) = text.split_once(',').unwrap_or((text, text));
    Ok(Wrap([mode(u)?, mode(v)?]))
}

fn angle_of_crease(text: &str) -> Result<f32, String> {
    let angle = text.parse().ok().filter(|angle: &f32| (0.0..=180.0).contains(angle));
    angle.ok_or_else(|| "an angle is 0 to 180 degrees".to_owned())
}

/// How finely edges are cut.
#[derive(Clone, Copy, Debug, clap::Args)]
#[group(multiple = false)]
struct RuleArgs {
    /// The same factor everywhere [default: the largest with at most 300000 triangles]
    #[arg(long, value_name = "F", value_parser = ValueParser::new(positive))]
    factor: Option<f32>,
    /// Factor at distance 1 from the eye, falling off with the distance
    #[arg(long, value_name = "F", value_parser = ValueParser::new(positive))]
    distance: Option<f32>,
    /// Length of a segment in the picture, in pixels
    #[arg(long, value_name = "PIXELS", value_parser = ValueParser::new(positive))]
    pixels: Option<f32>,
    /// Largest distance of triangles from the surface, in the model's units
    #[arg(long, value_name = "LENGTH", value_parser = ValueParser::new(positive))]
    tolerance: Option<f32>,
}

impl RuleArgs {
    /// Whether the factors depend on the camera.
    const fn looks(self) -> bool {
        self.distance.is_some() || self.pixels.is_some()
    }

    /// Refuses a factor that would be clamped.
    fn fit(self, partitioning: Partitioning) -> Result<(), Failure> {
        let (low, high) = partitioning.range();
        match self.factor {
            Some(factor) if !(low..=high).contains(&factor) => Err(Failure::bad_input(format!(
                "--factor {factor}: factors are {low} to {high} with --partitioning {}",
                partitioning.name()
            ))),
            _ => Ok(()),
        }
    }

    /// Whether no rule was selected.
    const fn is_default(self) -> bool {
        self.factor.is_none() && self.tolerance.is_none() && !self.looks()
    }

    /// The rule; `default` is the factor if none was selected.
    fn rule(self, view: &CameraView, default: f32) -> FactorRule {
        let CameraView { eye, pixels_per_unit, .. } = *view;
        match self {
            Self { distance: Some(scale), .. } => FactorRule::Distance { eye, scale },
            Self { pixels: Some(segment), .. } => {
                FactorRule::ScreenSize { eye, pixels_per_unit, segment }
            }
            Self { tolerance: Some(tolerance), .. } => FactorRule::Flatness { tolerance },
            Self { factor, .. } => FactorRule::Uniform(factor.unwrap_or(default)),
        }
    }
}

fn finite(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number: &f32| number.is_finite());
    number.ok_or_else(|| "a length is a finite number".to_owned())
}

fn positive(text: &str) -> Result<f32, String> {
    let number = finite(text).ok().filter(|&number| number > 0.0);
    number.ok_or_else(|| "a finite number greater than zero is needed".to_owned())
}

fn refused(error: LoadError) -> Failure {
    match error.kind() {
        LoadErrorKind::Limit => {
            Failure::bad_input(format!("{error}; --max-memory raises the limit"))
        }
        _ => Failure::bad_input(error),
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part is 0 to 1")]
const fn percent(part: f32) -> u64 {
    (part * 100.0) as u64
}

/// The number of triangles with which the default factor is chosen: what viewers open at once.
const VIEWABLE: u64 = 300_000;

fn too_high(error: HeightError) -> Failure {
    Failure::bad_input(format!("--height is too large: {error}"))
}

/// Runs the command. Errors: a model that cannot be read or tessellated; an output that cannot be
/// written.
pub(crate) fn run(args: &MeshCommand) -> Result<Exit, Failure> {
    let form = args.form()?;
    let part = output::part_beside(&args.output, form);
    refuse_shared(&args.roles(&[], part.as_deref()))?;
    start_pool();
    let mut statistics = Statistics::default();
    let (loaded, displacement) = statistics.load(|| args.load())?;
    refuse_shared(&args.roles(&loaded.files, part.as_deref()))?;
    let Loaded { model, parts, up, notes, untextured, .. } = &loaded;
    let missing = untextured.iter().filter(|_| displacement.is_some());
    notes.iter().chain(missing).for_each(|line| note(&format!("note: {line}")));
    let displaced = statistics.load(|| {
        displacement.as_ref().map(|displacement| DisplacedModel::new(model, displacement))
    });
    let up = args.view.up.unwrap_or(*up);
    let view = args.view.view(&args.outline(form, model), up);
    let job = Job {
        model,
        rule: args.rule.rule(&view, args.default_factor(model)),
        partitioning: args.partitioning,
        displaced: displaced.as_ref(),
        parts: Some(parts),
    };
    let prefix = prefix::between(args.input.as_deref(), &args.output);
    let options = Options {
        view,
        wireframe: args.wireframe,
        prefix: &prefix,
        gltf: GltfOptions {
            up,
            indices: args.indices,
            parts: Some(parts),
            image_prefix: &prefix::uri(&prefix),
        },
    };
    size::refuse_too_large(&job, &args.output, form, &options)?;
    output::notes_of_losses(form, parts).for_each(|line| note(&format!("note: {line}")));
    let mut file = MeshFile::open(&args.output, form, &options)?;
    statistics.patches = model.len();
    statistics.bar = Some(progress(model.len() as u64, "patches"));
    let totals = job.run(file.sink(), &mut statistics);
    let totals = totals.map_err(|error| Failure::write(&args.output, error))?;
    statistics.end(|| file.finish())?;
    (statistics.vertices, statistics.triangles) = (totals.vertices, totals.indices / 3);
    statistics.bar = None;
    // Nobody may be reading stderr; the output is complete all the same.
    _ = write!(std::io::stderr(), "{statistics}");
    Ok(Exit::Done)
}

impl MeshCommand {
    /// The model and its displacement.
    fn load(&self) -> Result<(Loaded, Option<Displacement>), Failure> {
        let map = self.displace.as_deref();
        let map =
            map.map(|path| height::load(path, self.max_pixels)).transpose().map_err(refused)?;
        let weld = self.weld.map_or(Weld::No, Weld::UpTo);
        let options = LoadOptions {
            style: self.surface,
            weld,
            crease: self.crease,
            scene: self.scene,
            max_memory: self.max_memory.saturating_mul(1 << 20),
        };
        let loaded = match &self.input {
            Some(path) => {
                let bar = progress(100, "% of the model");
                tess_mesh::load_watched(path, &options, &|part| {
                    bar.set_position(percent(part));
                })
            }
            None => tess_mesh::teapot(&options),
        };
        let loaded = loaded.map_err(refused)?;
        let displacement = map.map(|map| {
            let map = map.with_addresses(self.wrap.map_or(loaded.address, |wrap| wrap.0));
            Displacement::new(map, self.height).map_err(too_high)
        });
        Ok((loaded, displacement.transpose()?))
    }

    /// The factor that is used if no rule was selected.
    fn default_factor(&self, model: &Model) -> f32 {
        if !self.rule.is_default() {
            return 1.0; // not used
        }
        let (low, _) = self.partitioning.range();
        let fits = |totals: Totals| totals.indices / 3 <= VIEWABLE;
        let factor = largest_factor(model, self.partitioning, fits).unwrap_or(low);
        note(&format!("note: factor {factor}, as none was given (--factor)"));
        factor
    }

    /// The files of the command, including those to which the model refers and the binary part next
    /// to the result.
    fn roles<'a>(&'a self, others: &'a [PathBuf], part: Option<&'a Path>) -> Vec<Role<'a>> {
        let input = self.input.as_deref().map(|path| Role::input("IN", path));
        let map = self.displace.as_deref().map(|path| Role::input("--displace", path));
        let others = others.iter().map(|path| Role::input("a file of the model", path));
        let inputs = input.into_iter().chain(map).chain(others);
        let part = part.map(|path| Role::output("the binary part of -o,", path));
        inputs.chain([Role::output("-o", &self.output)]).chain(part).collect()
    }

    /// The format of the result. Errors: a name that implies no format; an option that the format
    /// does not have; binary data for a terminal.
    fn form(&self) -> Result<ResultForm, Failure> {
        let form = form::choose(self.format, &self.output)?;
        let is_picture = form == ResultForm::Png;
        let is_gltf = matches!(form, ResultForm::Gltf | ResultForm::Glb);
        let needless = [
            (self.indices != IndexWidth::Auto && !is_gltf, "--indices is for .gltf and .glb"),
            (self.wireframe && !is_picture, "--wireframe is for pictures"),
            (
                self.view.is_chosen() && !is_picture && !self.rule.looks(),
                "--eye, --target, --fov and --size are for pictures, --distance and --pixels",
            ),
        ];
        if let Some((_, why)) = needless.iter().find(|(is_needless, _)| *is_needless) {
            return Err(Failure::bad_input(format!(
                "{why}; {} has no use for it",
                form::name(&form)
            )));
        }
        self.rule.fit(self.partitioning)?;
        if !form.is_text() {
            OutputArgs { file: self.output.clone() }.refuse_terminal("this form")?;
        }
        Ok(form)
    }

    /// The points that must be in the camera's picture; empty if no camera is needed.
    fn outline(&self, form: ResultForm, model: &Model) -> Vec<Vec3> {
        let reach = if self.displace.is_some() { self.height.abs() } else { 0.0 };
        let looks = form == ResultForm::Png || self.rule.looks();
        if looks { outline::outline(model, reach) } else { Vec::new() }
    }
}

//! `tess mesh`: turns a model file into a tessellated mesh or a picture.
//!
//! [`input`] reads and checks the whole model; [`pipeline`] sends its patches through factors,
//! tessellation and evaluation, one block at a time; [`output`] takes the blocks as they come.
#![expect(clippy::float_arithmetic, reason = "surfaces and pictures are made of floats")]

mod input;
mod outline;
mod output;
mod pipeline;
mod statistics;
mod view;

#[cfg(feature = "fuzzing")]
pub use input::fuzzing;

use crate::args::{Choices, choice, name_of};
use crate::failure::{Exit, Failure};
use crate::output::{OutputArgs, Role, form, note, refuse_shared};
use crate::threads::start_pool;
use clap::builder::ValueParser;
use glam::Vec3;
use input::{Input, InputOptions, TexcoordRange, Weld, height};
use output::{IndexWidth, MeshFile, Options, ResultForm};
use pipeline::MeshJob;
use statistics::{MeshStage, Statistics};
use std::io::Write;
use std::path::{Path, PathBuf};
use tess_core::Partitioning;
use tess_surface::{Address, DisplacedModel, Displacement, FactorRule, HeightError, Model, Style};
use tess_verify::Named;
use view::{CameraView, ViewArgs};

/// Tessellate a model into a mesh or a picture
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Neighbouring patches get the same factor on their common edge, and the same points to the bit, so no crack opens between \
them. Corners are the same if their coordinates are equal. Where a corner is on the inside of another face's edge, or \
differs from another corner in its last digits, a crack may open: a note counts such corners, and --weld closes the gaps.

Some faces are changed; a note gives their number and the place of the first one. Polygons of more than four corners and \
concave quads are cut into triangles. Faces without area are left out. Faces with a normal that is zero or NaN get smooth \
normals, as do faces without normals. Where more than two faces share an edge, each keeps its own normals. A face that \
occurs twice, once for each side, is two sheets. Points and lines are left out.

glTF models are in their pose at rest, with the weights of morph targets, the joints of skins and the \
transforms of nodes; animations are not applied. Buffers must be files in the model's folder or below it.

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
    /// Heights beyond the image [default: clamp if all texture coordinates are within 0 and 1, or
    /// else repeat]
    #[arg(long, value_name = "NAME", value_parser = choice(WRAPS), requires = "displace")]
    wrap: Option<Address>,
    /// Largest height image to read, in pixels
    #[arg(long, value_name = "N", default_value = "64000000")]
    max_pixels: u64,
    /// Width of the indices in glTF
    #[arg(long, value_name = "BITS", default_value = "auto")]
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

/// The continuation of a height image beyond its borders.
const WRAPS: Choices<Address> = &[
    ("repeat", Address::Repeat, "The image again"),
    ("clamp", Address::Clamp, "The outermost pixels"),
    ("mirror", Address::Mirror, "The image again, every second time reversed"),
];

/// How finely edges are cut.
#[derive(Clone, Copy, Debug, clap::Args)]
#[group(multiple = false)]
struct RuleArgs {
    /// The same factor everywhere [default: the largest: 64, or 63 with `fractional_odd`]
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

    fn rule(self, view: &CameraView) -> FactorRule {
        let CameraView { eye, pixels_per_unit, .. } = *view;
        match self {
            Self { distance: Some(scale), .. } => FactorRule::Distance { eye, scale },
            Self { pixels: Some(segment), .. } => {
                FactorRule::ScreenSize { eye, pixels_per_unit, segment }
            }
            Self { tolerance: Some(tolerance), .. } => FactorRule::Flatness { tolerance },
            Self { factor, .. } => FactorRule::Uniform(factor.unwrap_or(64.0)),
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
    let (input, displacement) = statistics.time(MeshStage::Load, || args.load())?;
    let Input { model, up, notes, files, texcoords } = input;
    refuse_shared(&args.roles(&files, part.as_deref()))?;
    let missing = texcoords.missing.filter(|_| displacement.is_some());
    notes.iter().chain(&missing).for_each(|line| note(&format!("note: {line}")));
    let displaced = statistics.time(MeshStage::Load, || {
        displacement.as_ref().map(|displacement| DisplacedModel::new(&model, displacement))
    });
    let up = args.view.up.unwrap_or(up);
    let view = args.view.view(&args.outline(form, &model), up);
    let options = Options { up, indices: args.indices, view, wireframe: args.wireframe };
    let mut sink = MeshFile::open(&args.output, form, &options)?;
    let job = MeshJob {
        model: &model,
        rule: args.rule.rule(&view),
        partitioning: args.partitioning,
        displaced: displaced.as_ref(),
    };
    pipeline::run(&job, &mut sink, &mut statistics)?;
    statistics.time(MeshStage::Output, || sink.finish())?;
    // Nobody may be reading stderr; the output is complete all the same.
    _ = write!(std::io::stderr(), "{statistics}");
    Ok(Exit::Done)
}

impl MeshCommand {
    /// The model and its displacement.
    fn load(&self) -> Result<(Input, Option<Displacement>), Failure> {
        let map = self.displace.as_deref();
        let map = map.map(|path| height::load(path, self.max_pixels)).transpose()?;
        let weld = self.weld.map_or(Weld::No, Weld::UpTo);
        let options = InputOptions { style: self.surface, weld };
        let input = input::load(self.input.as_deref(), options)?;
        let displacement = map.map(|map| {
            let map = map.with_address(self.address(&input.texcoords));
            Displacement::new(map, self.height).map_err(too_high)
        });
        Ok((input, displacement.transpose()?))
    }

    /// How the height image continues beyond its borders.
    fn address(&self, texcoords: &TexcoordRange) -> Address {
        let fitting = if texcoords.is_unit { Address::Clamp } else { Address::Repeat };
        self.wrap.unwrap_or(fitting)
    }

    /// The files of the command, including the buffers next to the model and the binary part next
    /// to the result.
    fn roles<'a>(&'a self, buffers: &'a [PathBuf], part: Option<&'a Path>) -> Vec<Role<'a>> {
        let input = self.input.as_deref().map(|path| Role::input("IN", path));
        let map = self.displace.as_deref().map(|path| Role::input("--displace", path));
        let buffers = buffers.iter().map(|path| Role::input("the model's buffer", path));
        let inputs = input.into_iter().chain(map).chain(buffers);
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

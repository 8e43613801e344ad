//! `tess shaders`: the compute shaders in any language, with the data that a host needs to run
//! them.

mod formula;
mod header;
mod languages;
mod manifest;
mod old_vulkan;
mod places;
mod plan;
#[cfg(feature = "gpu")]
mod programs;
#[cfg(feature = "gpu")]
mod sdl_header;
#[cfg(all(test, feature = "gpu"))]
mod sdl_tests;
mod slots;
#[cfg(feature = "gpu")]
mod stage;
mod stage_manifest;
#[cfg(feature = "gpu")]
mod stage_modules;
#[cfg(feature = "gpu")]
mod stage_pulled;
mod structures;
mod surfaces;
#[cfg(test)]
mod tests;
mod translation;

use crate::args::{Choices, ORDERS, choice, name_of};
use crate::failure::{Exit, Failure};
use crate::output::{NewFolder, json, refuse_stdout};
use manifest::Manifest;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_gpu::tables;
use tess_gpu::{IndexType, Numbering, Order, PointFormat, Setup};
#[cfg(feature = "probe")]
pub(crate) use translation::Checks;
#[cfg(not(feature = "probe"))]
use translation::Checks;
use translation::{Layout, Target, Translation};

/// Write the compute shaders for any API, with a manifest that describes how to run them
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The folder gets a file per stage, tables.bin with the constants that they look up, and the same manifest twice: \
manifest.json, and tess_shaders.h for C99. With wgsl it also gets surfaces/, functions for shaders of your own: factors by \
rule, culling, surfaces without cracks. bindings/vulkan is a host in C that needs nothing else; bindings/sdl is one over SDL 3, \
for --layout sdl --stage FILE, which also writes tess_stage.h. Tests compile spirv, glsl and hlsl; no Metal compiler has seen msl.

Examples:
  tess shaders --target spirv --domain quad -o shaders/
  tess shaders --target hlsl --domain tri --partitioning fractional_odd --points f32 -o shaders/
  tess shaders --target wgsl --domain quad --stage terrain.wgsl --evaluate -o shaders/
  tess shaders --target spirv --layout sdl --domain quad --stage terrain.wgsl -o shaders/   for bindings/sdl
  tess shaders --target spirv --checks none -o shaders/   faster; see docs/performance.md
  tess shaders --target wgsl --index-order cache --force -o build/shaders/   as a step of a build")]
pub(crate) struct ShadersCommand {
    /// Language of the shaders
    #[arg(long, value_name = "NAME")]
    target: Target,
    /// Domain of the patches
    #[arg(long, value_name = "NAME", default_value = "tri", value_parser = name_of::<Domain>())]
    domain: Domain,
    /// Spacing of the cuts
    #[arg(long, value_name = "NAME", default_value = "integer")]
    #[arg(value_parser = name_of::<Partitioning>())]
    partitioning: Partitioning,
    /// Primitives that the indices describe
    #[arg(long, value_name = "NAME", default_value = "triangle_cw")]
    #[arg(value_parser = name_of::<OutputPrimitive>())]
    output: OutputPrimitive,
    /// Order in which points join an edge
    #[arg(long, value_name = "NAME", default_value = "ruler")]
    #[arg(value_parser = name_of::<SplitOrder>())]
    split: SplitOrder,
    /// Format of the points, 8 bytes each
    #[arg(long, value_name = "FORM", default_value = "packed", value_parser = choice(POINTS))]
    points: PointFormat,
    /// Width of the indices
    #[arg(long, value_name = "TYPE", default_value = "u32", value_parser = choice(INDEX_TYPES))]
    index_type: IndexType,
    /// Point that has index 0
    #[arg(long, value_name = "NAME", default_value = "per-batch")]
    #[arg(value_parser = choice(NUMBERINGS))]
    numbering: Numbering,
    /// Order of the triangles
    #[arg(long = "index-order", value_name = "NAME", default_value = "specification")]
    #[arg(value_parser = choice(ORDERS))]
    order: Order,
    /// Whether the shaders check every access and every loop
    #[arg(long, value_name = "WHICH", default_value = "full")]
    checks: Checks,
    /// Where the shaders expect their resources
    #[arg(long, value_name = "WHOSE", default_value = "plain")]
    layout: Layout,
    /// With --target wgsl or --layout sdl: also write the tessellation stage, complete for the
    /// functions hull and domain in FILE, or, with wgsl and without FILE, in parts that a host
    /// joins to WGSL when it runs
    #[cfg(feature = "gpu")]
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    stage: Option<Option<PathBuf>>,
    /// With --stage FILE: call domain once for each point, in a pass, instead of for each vertex of
    /// each draw
    #[cfg(feature = "gpu")]
    #[arg(long, requires = "stage")]
    evaluate: bool,
    /// With --stage FILE: the function of the WGSL that each draw calls for each vertex
    #[cfg(feature = "gpu")]
    #[arg(long, requires = "stage", value_name = "FUNCTION")]
    project: Option<String>,
    /// Replace the folder and everything in it, if this command wrote it or it is empty
    #[arg(long)]
    force: bool,
    /// New folder to write
    #[arg(short = 'o', value_name = "FOLDER")]
    folder: PathBuf,
}

const POINTS: Choices<PointFormat> = &[
    ("packed", PointFormat::Packed, "16.16 coordinates and the number of the patch"),
    ("f32", PointFormat::F32, "Two binary32 coordinates"),
];

const INDEX_TYPES: Choices<IndexType> =
    &[("u16", IndexType::U16, "16 bits"), ("u32", IndexType::U32, "32 bits")];

const NUMBERINGS: Choices<Numbering> = &[
    ("per-batch", Numbering::PerBatch, "The first point of the batch, for one draw of everything"),
    ("per-patch", Numbering::PerPatch, "The first point of each patch"),
];

/// Runs the command.
///
/// # Errors
/// The folder exists and is not to be replaced, or it cannot be written.
pub(crate) fn run(args: &ShadersCommand) -> Result<Exit, Failure> {
    refuse_stdout(&args.folder, "the shaders are several files")?;
    let setup = args.setup();
    let translation = args.translation()?;
    let shaders = Shaders::new(setup, translation)?;
    #[cfg(feature = "gpu")]
    let stage = args.stage(setup, translation)?;
    let write = || {
        let new = match (is_ours(&args.folder), args.force) {
            (true, true) => NewFolder::replacing(&args.folder)?,
            (true, false) => {
                let message = "it exists already; --force replaces it";
                return Err(io::Error::new(io::ErrorKind::AlreadyExists, message));
            }
            (false, _) => NewFolder::create(&args.folder)?,
        };
        shaders.write(new.path())?;
        #[cfg(feature = "gpu")]
        stage.as_ref().map_or(Ok(()), |stage| stage.write(new.path(), &shaders.manifest))?;
        new.finish()
    };
    write().map_err(|error| Failure::write(&args.folder, error))?;
    Ok(Exit::Done)
}

#[cfg(feature = "gpu")]
impl ShadersCommand {
    /// The stage, if it was asked for.
    ///
    /// # Errors
    /// An option does not go with it, or the user's WGSL is not valid with it.
    fn stage(
        &self,
        setup: Setup,
        translation: Translation,
    ) -> Result<Option<stage::Stage>, Failure> {
        let Some(file) = &self.stage else { return Ok(None) };
        let given = Setup { order: setup.order, ..Setup::new(setup.domain, setup.config) };
        let is_for_sdl = self.layout == Layout::Sdl;
        if self.target != Target::Wgsl && !is_for_sdl || setup != given {
            return Err(Failure::bad_input(
                "--stage needs --target wgsl or --layout sdl, packed points, and 32-bit indices that count from \
                 the batch's first point",
            ));
        }
        if is_for_sdl && file.is_none() {
            return Err(Failure::bad_input(
                "--layout sdl needs your WGSL: name its file, as in --stage FILE",
            ));
        }
        if file.is_none() && (self.evaluate || self.project.is_some()) {
            return Err(Failure::bad_input(
                "--evaluate and --project choose for a text: name its file, as in --stage FILE",
            ));
        }
        let (evaluate, project) = (self.evaluate, self.project.as_deref());
        let translation = is_for_sdl.then_some(translation);
        let asked = stage::Asked { file: file.as_ref(), evaluate, project, translation };
        stage::Stage::new(setup, &asked).map(Some)
    }
}

/// The names of the stage's files in a folder.
fn stage_files(folder: &Path) -> Vec<String> {
    #[cfg(feature = "gpu")]
    let files = stage::files_of(folder);
    #[cfg(not(feature = "gpu"))]
    let files = {
        _ = folder;
        Vec::new()
    };
    files
}

/// Whether a folder is empty or has only files that this command wrote, according to its manifest.
fn is_ours(folder: &Path) -> bool {
    let surfaces = folder.join(surfaces::FOLDER);
    has_only(folder, &manifest::files_of(folder))
        && (!surfaces.exists() || has_only(&surfaces, &surfaces::files()))
}

/// Whether everything in a folder has one of these names.
fn has_only(folder: &Path, names: &[String]) -> bool {
    let is_named = |entry: io::Result<fs::DirEntry>| {
        entry.is_ok_and(|entry| names.iter().any(|name| entry.file_name() == **name))
    };
    fs::read_dir(folder).is_ok_and(|mut entries| entries.all(is_named))
}

impl ShadersCommand {
    /// # Errors
    /// SDL takes no shaders in this language.
    fn translation(&self) -> Result<Translation, Failure> {
        let Self { target, layout, checks, .. } = *self;
        if layout == Layout::Sdl && matches!(target, Target::Wgsl | Target::Glsl) {
            return Err(Failure::bad_input(
                "--layout sdl needs --target spirv, hlsl or msl: SDL takes no other shaders",
            ));
        }
        Ok(Translation { target, layout, checks })
    }

    fn setup(&self) -> Setup {
        let config =
            Config { partitioning: self.partitioning, output: self.output, split: self.split };
        Setup {
            point_format: self.points,
            numbering: self.numbering,
            index_type: self.index_type,
            order: self.order,
            ..Setup::new(self.domain, config)
        }
    }
}

/// A stage in SPIR-V.
///
/// # Errors
/// SPIR-V cannot express the stage.
#[cfg(feature = "probe")]
pub(crate) fn spirv(
    stage: tess_gpu::Stage,
    setup: Setup,
    checks: Checks,
) -> Result<Vec<u8>, String> {
    let translation = Translation { target: Target::Spirv, layout: Layout::Plain, checks };
    translation.write(stage, setup).map(|written| written.text)
}

/// The contents of the folder.
struct Shaders {
    target: Target,
    manifest: Manifest,
    files: Vec<(String, Vec<u8>)>,
    tables: Vec<u8>,
}

impl Shaders {
    /// The shaders of a setup.
    ///
    /// # Errors
    /// Exit code 3 if the language cannot express a shader.
    fn new(setup: Setup, translation: Translation) -> Result<Self, Failure> {
        let plans = plan::variants(setup);
        let mut files = Vec::new();
        let mut stages = Vec::new();
        for stage in plan::stages(&plans) {
            let written = translation.write(stage, setup).map_err(Failure::unavailable)?;
            files.push((written.file.clone(), written.text));
            stages.push(written.stage);
        }
        let structures = structures::all(setup);
        let manifest = Manifest::new(setup, translation, stages, plans, structures);
        let words = tables(setup.config.split);
        Ok(Self {
            target: translation.target,
            manifest,
            files,
            tables: words.iter().flat_map(|word| word.to_le_bytes()).collect(),
        })
    }

    /// Writes every file into the folder.
    fn write(&self, folder: &Path) -> io::Result<()> {
        for (name, text) in &self.files {
            fs::write(folder.join(name), text)?;
        }
        fs::write(folder.join(manifest::TABLES_FILE), &self.tables)?;
        fs::write(folder.join(manifest::FILE), json(&self.manifest))?;
        if self.target == Target::Wgsl {
            surfaces::write(folder)?;
        }
        // The header says that everything is in one set.
        match self.manifest.translation.layout {
            Layout::Plain => {
                fs::write(folder.join(manifest::HEADER_FILE), header::text(&self.manifest))
            }
            Layout::Sdl => Ok(()),
        }
    }
}

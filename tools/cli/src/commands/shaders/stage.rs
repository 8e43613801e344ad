//! `--stage`: the tessellation stage of `tess-wgpu` as files, for any host. docs/shaders.md
//! explains each entry of its manifest.

use super::formula::{Formula, Variable};
use super::manifest::{self, Described};
use super::programs::{self, Program, Programs};
use super::sdl_header;
use super::stage_manifest::{
    Attribute, Bound, Buffer, Manifest, Parts, Pass, Uniform, Vertex, Workgroups,
};
use super::translation::Translation;
use crate::failure::Failure;
use crate::input;
use crate::output::json;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{AddressSpace, GlobalVariable, Module, StorageAccess};
use serde::Deserialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tess_core::Domain;
use tess_gpu::{Capacity, Setup};
use tess_wgpu::TessellationStage;
use tess_wgpu::stage::{FixedShaders, Points, ShaderParts, UserShaders, VertexLayout};

/// The manifest's file, its first entry, and the files of the shaders.
const FILE: &str = "stage.json";
const FORMAT: &str = "tess-stage 1";
const HULL: &str = "stage_hull.wgsl";
const COPY_FACTORS: &str = "stage_copy_factors.wgsl";
const FIT: &str = "stage_fit.wgsl";
const EVALUATE: &str = "stage_evaluate.wgsl";
const VERTEX: &str = "stage_vertex.wgsl";

/// The names of the files of a stage in a folder that this command has written.
pub(super) fn files_of(folder: &Path) -> Vec<String> {
    #[derive(Deserialize)]
    struct Written {
        format: String,
        files: Vec<String>,
    }
    let text = manifest::text_of(&folder.join(FILE));
    match serde_json::from_str::<Written>(&text) {
        Ok(written) if written.format == FORMAT => {
            written.files.into_iter().chain([FILE.to_owned()]).collect()
        }
        _ => Vec::new(),
    }
}

/// The most bytes of the user's WGSL.
const MOST_WGSL: u64 = 16 << 20;

/// What was asked for.
#[derive(Clone, Debug)]
pub(super) struct Asked<'a> {
    /// The user's WGSL; `None` for the parts.
    pub(super) file: Option<&'a PathBuf>,
    pub(super) evaluate: bool,
    pub(super) project: Option<&'a str>,
    /// The language, with the layout for SDL; `None` for WGSL.
    pub(super) translation: Option<Translation>,
}

/// The manifest and the files beside it.
#[derive(Debug)]
pub(super) struct Stage {
    pub(super) manifest: Manifest,
    pub(super) files: Vec<(String, Vec<u8>)>,
}

/// The smallest text with which every module is whole.
fn least(domain: Domain) -> String {
    let kind = match domain {
        Domain::Isoline => "IsolineFactors",
        Domain::Triangle => "TriFactors",
        Domain::Quad => "QuadFactors",
    };
    format!(
        "struct Vertex {{ @builtin(position) position: vec4<f32> }}\n\
         fn hull(number: u32) -> {kind} {{ return {kind}(); }}\n\
         fn domain(number: u32, uv: vec2<f32>) -> Vertex {{\n\
         let factors = tess_factors(number); return Vertex(); }}"
    )
}

impl Stage {
    /// The stage of a setup.
    ///
    /// # Errors
    /// The user's WGSL cannot be read, or is not valid with the stage.
    pub(super) fn new(setup: Setup, asked: &Asked<'_>) -> Result<Self, Failure> {
        let text = match asked.file {
            Some(path) => {
                input::text(path, MOST_WGSL).map_err(|error| Failure::file("read", path, &error))?
            }
            None => least(setup.domain),
        };
        let wrong = |why: String| match asked.file {
            Some(path) => Failure::bad_input(format!("{}: {why}", input::name(path))),
            None => Failure::bad_input(why),
        };
        let is_evaluated = asked.evaluate || asked.file.is_none();
        let points = if is_evaluated { Points::Evaluated } else { Points::Stored };
        let builder = TessellationStage::builder(&text, setup.domain, setup.config, 1);
        let made = builder.points(points).user_shaders(asked.project);
        let user = made.map_err(|error| wrong(error.to_string()))?;
        Self::with(setup, user, asked).map_err(wrong)
    }

    fn with(setup: Setup, user: UserShaders, asked: &Asked<'_>) -> Result<Self, String> {
        let is_parts = asked.file.is_none();
        let (fixed, group, vertices) =
            (FixedShaders::new(setup), user.group, user.vertices.clone());
        let sources = Sources::new(user, &fixed, is_parts);
        let mut before_batch = passes(&sources.before)?;
        let mut after_batch = passes(&sources.after)?;
        let read = |text: &String| Vertex::new(text, group, &vertices);
        let mut vertex = sources.drawn.as_ref().map(read).transpose()?;
        let lists = [&mut before_batch, &mut after_batch];
        let translated = asked
            .translation
            .map(|translation| sources.translated(translation, lists, vertex.as_mut()))
            .transpose()?;
        let is_evaluated = !after_batch.is_empty() && !is_parts;
        if is_parts {
            before_batch.iter_mut().chain(&mut after_batch).for_each(|pass| pass.file = None);
        }
        let (files, users, fragments) = match translated {
            Some((made, fragments)) => (made.files, Some(made.users), Some(fragments)),
            None if is_parts => (Vec::new(), None, None),
            None => (sources.files(), None, None),
        };
        let manifest = Manifest {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION"),
            files: files.iter().map(|(name, _)| name.clone()).collect(),
            translation: asked.translation,
            setup: Described::new(setup),
            workgroup_size: 64,
            group: (!is_parts).then_some(group),
            buffers: buffers(setup, &fixed, if is_evaluated { vertices.array_stride } else { 0 }),
            before_batch,
            after_batch,
            vertex,
            fragments,
            users,
            uniform: [1.0, 4.0, 8.0, 64.0].map(|factor| uniform(setup, factor)).into(),
            ladder: fixed.ladder.clone(),
            parts: is_parts.then(|| Parts::new(setup.domain, fixed)),
        };
        Ok(Self { manifest, files })
    }

    /// Writes the manifest and the shaders into a folder; for SDL also the header, which has the
    /// batch too.
    pub(super) fn write(&self, folder: &Path, batch: &manifest::Manifest) -> io::Result<()> {
        for (name, text) in &self.files {
            fs::write(folder.join(name), text)?;
        }
        if self.manifest.translation.is_some() {
            let text = sdl_header::text(&self.manifest, batch);
            fs::write(folder.join(manifest::STAGE_HEADER_FILE), text)?;
        }
        fs::write(folder.join(FILE), json(&self.manifest))
    }
}

impl Parts {
    fn new(domain: Domain, fixed: FixedShaders) -> Self {
        let parts = ShaderParts::new(domain);
        Self {
            shared: parts.shared,
            hull: parts.hull,
            copy_factors: fixed.copy_factors,
            fit: fixed.fit,
            evaluate: parts.evaluate,
            vertex_stored: parts.vertex_stored,
            vertex_evaluated: parts.vertex_evaluated,
            factors: parts.factors,
            draws: parts.draws,
        }
    }
}

fn uniform(setup: Setup, factor: f32) -> Uniform {
    let Capacity { points, primitives } = Capacity::uniform(setup, 1, factor);
    Uniform { factor, points, primitives }
}

/// The buffers that the batch of `manifest.json` does not have. Its own are also bound.
fn buffers(setup: Setup, fixed: &FixedShaders, stride: u64) -> Vec<Buffer> {
    let words = |count: usize| Formula::from(4 * count as u64);
    let factors = Formula::term(4 * setup.factors(), Variable::Patches, 1);
    let mut all = vec![
        Buffer { name: "patch_count", bytes: words(1) },
        Buffer { name: "given_factors", bytes: factors },
        // The step and three reserved words, then 33 sums of four words.
        Buffer { name: "fit", bytes: words(4 + 4 * 33) },
        Buffer { name: "terms", bytes: words(4 + fixed.ladder.len()) },
        Buffer { name: "fit_arguments", bytes: words(3) },
        Buffer { name: "window", bytes: words(2) },
    ];
    if stride > 0 {
        let bytes = Formula::term(stride, Variable::Points, 1);
        all.push(Buffer { name: "vertices", bytes });
    }
    all
}

/// Entry points, and what their workgroups depend on.
type Entry = (&'static str, Workgroups);

const HULL_PASS: Entry = ("tess_hull", Workgroups::Patches);
const COPY_PASS: Entry = ("copy_factors", Workgroups::Patches);
const EVALUATE_PASS: Entry = ("tess_evaluate", Workgroups::Points);
const FIT_PASSES: [Entry; 5] = [
    ("count_whole", Workgroups::Patches),
    ("decide", Workgroups::One),
    ("count_coarse", Workgroups::FitArguments),
    ("count_fine", Workgroups::FitArguments),
    ("scale_factors", Workgroups::FitArguments),
];

/// The buffers of the stage's variables.
const BUFFERS: [(&str, &str); 13] = [
    ("tess_written_factors", "factors"),
    ("tess_drawn_factors", "factors"),
    ("factors", "factors"),
    ("tess_frame", "patch_count"),
    ("patches", "patch_count"),
    ("given", "given_factors"),
    ("fit", "fit"),
    ("terms", "terms"),
    ("arguments", "fit_arguments"),
    ("tess_packed_points", "points"),
    ("tess_vertices", "vertices"),
    ("tess_status", "status"),
    ("tess_window", "window"),
];

/// The buffer of a variable of the stage.
fn own_buffer(variable: &str) -> Option<&'static str> {
    BUFFERS.iter().find(|(own, _)| *own == variable).map(|(_, buffer)| *buffer)
}

/// A module in WGSL with entry points of passes.
struct Source {
    file: &'static str,
    text: String,
    /// The stage's own bind group; the user's are before it.
    group: u32,
    part: &'static str,
    entries: &'static [Entry],
}

impl Source {
    const fn new(
        file: &'static str,
        text: String,
        group: u32,
        part: &'static str,
        entries: &'static [Entry],
    ) -> Self {
        Self { file, text, group, part, entries }
    }
}

/// The modules of a stage.
struct Sources {
    before: Vec<Source>,
    after: Vec<Source>,
    /// The module of draws, which has the user's fragment shaders too.
    drawn: Option<String>,
    group: u32,
}

impl Sources {
    fn new(user: UserShaders, fixed: &FixedShaders, is_parts: bool) -> Self {
        let group = user.group;
        let hull = user.hull.map(|text| Source::new(HULL, text, group, "hull", &[HULL_PASS]));
        // The parts have both, so that the host can choose.
        let copy = (is_parts || hull.is_none()).then(|| {
            let text = fixed.copy_factors.clone();
            Source::new(COPY_FACTORS, text, 0, "copy_factors", &[COPY_PASS])
        });
        let fit = Source::new(FIT, fixed.fit.clone(), 0, "fit", &FIT_PASSES);
        let evaluate = user
            .evaluate
            .map(|text| Source::new(EVALUATE, text, group, "evaluate", &[EVALUATE_PASS]));
        Self {
            before: hull.into_iter().chain(copy).chain([fit]).collect(),
            after: evaluate.into_iter().collect(),
            drawn: user.vertex.filter(|_| !is_parts),
            group,
        }
    }

    /// The modules as files.
    fn files(self) -> Vec<(String, Vec<u8>)> {
        let passes = self.before.into_iter().chain(self.after);
        let passes = passes.map(|one| (one.file.to_owned(), one.text.into_bytes()));
        let drawn = self.drawn.map(|text| (VERTEX.to_owned(), text.into_bytes()));
        passes.chain(drawn).collect()
    }

    /// Gives each pass and the draws their shaders for SDL; returns them with the fragment shaders.
    ///
    /// # Errors
    /// The language or SDL cannot express one.
    fn translated(
        &self,
        translation: Translation,
        [before, after]: [&mut Vec<Pass>; 2],
        vertex: Option<&mut Vertex>,
    ) -> Result<(Programs, Vec<Program>), String> {
        let mut made = Programs::new(translation);
        translate(&mut made, &self.before, before)?;
        translate(&mut made, &self.after, after)?;
        let mut fragments = Vec::new();
        if let (Some(text), Some(vertex)) = (&self.drawn, vertex) {
            let own = (text.as_str(), self.group);
            vertex.file = None;
            vertex.program = Some(made.add("stage_vertex", own, "tess_vertex", own_buffer)?);
            for name in programs::fragments(text)? {
                let file = format!("stage_fragment_{name}");
                fragments.push(made.add(&file, own, &name, own_buffer)?);
            }
        }
        Ok((made, fragments))
    }
}

/// The passes of modules.
///
/// # Errors
/// One is not valid.
fn passes(sources: &[Source]) -> Result<Vec<Pass>, String> {
    let mut all = Vec::new();
    for source in sources {
        let read = Read::new(&source.text)?;
        let pass = |&(entry_point, workgroups): &Entry| Pass {
            entry_point: entry_point.to_owned(),
            file: Some(source.file),
            part: source.part,
            workgroups,
            bindings: read.bindings(entry_point, source.group),
            program: None,
        };
        all.extend(source.entries.iter().map(pass));
    }
    Ok(all)
}

/// Gives each pass its shader for SDL.
///
/// # Errors
/// The language or SDL cannot express one.
fn translate(made: &mut Programs, sources: &[Source], all: &mut [Pass]) -> Result<(), String> {
    let entries = sources.iter().flat_map(|one| one.entries.iter().map(move |_| one));
    for (source, pass) in entries.zip(all) {
        let entry = pass.entry_point.as_str();
        let name = format!("stage_{}", entry.trim_start_matches("tess_"));
        let text = (source.text.as_str(), source.group);
        let program = made.add(&name, text, entry, own_buffer)?;
        (pass.file, pass.program) = (None, Some(program));
    }
    Ok(())
}

impl Vertex {
    fn new(text: &str, group: u32, layout: &VertexLayout) -> Result<Self, String> {
        let attribute = |one: &wgpu::VertexAttribute| Attribute {
            location: one.shader_location,
            offset: one.offset,
            format: format!("{:?}", one.format).to_lowercase(),
        };
        Ok(Self {
            file: Some(VERTEX),
            entry_point: "tess_vertex",
            stride: layout.array_stride,
            attributes: layout.attributes.iter().map(attribute).collect(),
            bindings: Read::new(text)?.bindings("tess_vertex", group),
            program: None,
        })
    }
}

/// A valid module.
struct Read {
    module: Module,
    info: naga::valid::ModuleInfo,
}

impl Read {
    fn new(text: &str) -> Result<Self, String> {
        let module =
            naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
        // What the user's WGSL asks of a device is known only there.
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
        let info = validator.validate(&module).map_err(|error| error.emit_to_string(text))?;
        Ok(Self { module, info })
    }

    /// The stage's own bindings that an entry point uses, in order. The user's are in the bind
    /// groups before `from_group`.
    fn bindings(&self, entry_point: &str, from_group: u32) -> Vec<Bound> {
        let Self { module, info } = self;
        let is_it = |one: &naga::EntryPoint| one.name == entry_point;
        let Some(number) = module.entry_points.iter().position(is_it) else { return Vec::new() };
        let used = info.get_entry_point(number);
        let bound = |(handle, variable): (naga::Handle<GlobalVariable>, &GlobalVariable)| {
            let binding = variable.binding.filter(|binding| binding.group >= from_group)?;
            let name = variable.name.as_deref()?;
            let buffer = own_buffer(name)?;
            let is_used = !used[handle].is_empty();
            let AddressSpace::Storage { access } = variable.space else { return None };
            let is_written = access.contains(StorageAccess::STORE);
            let (group, binding) = (binding.group, binding.binding);
            is_used.then_some(Bound { group, binding, is_written, buffer })
        };
        let mut all: Vec<_> = module.global_variables.iter().filter_map(bound).collect();
        all.sort_by_key(|one| (one.group, one.binding));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Config, OutputPrimitive, Partitioning};

    fn manifest(domain: Domain) -> serde_json::Value {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let asked = Asked { file: None, evaluate: false, project: None, translation: None };
        let stage = Stage::new(Setup::new(domain, config), &asked).expect("it is sound");
        serde_json::to_value(&stage.manifest).expect("JSON")
    }

    /// The bindings of a pass as `group.binding buffer`, with `*` where it is written.
    fn bindings(manifest: &serde_json::Value, entry_point: &str) -> String {
        let all = ["before_batch", "after_batch"].map(|list| manifest[list].as_array().cloned());
        let mut passes = all.into_iter().flatten().flatten();
        let pass = passes.find(|pass| pass["entry_point"] == entry_point).expect(entry_point);
        let text = |one: &serde_json::Value| {
            let mark = if one["is_written"] == true { "*" } else { "" };
            let buffer = one["buffer"].as_str().unwrap_or_default();
            format!("{}.{} {buffer}{mark}", one["group"], one["binding"])
        };
        let bound = pass["bindings"].as_array().expect("a list").iter().map(text);
        bound.collect::<Vec<_>>().join(", ")
    }

    #[test]
    fn passes_have_their_bindings() {
        for domain in Domain::ALL {
            let manifest = manifest(domain);
            for (entry_point, expected) in [
                ("tess_hull", "0.0 factors*, 0.1 patch_count"),
                ("copy_factors", "0.0 factors*, 0.1 patch_count, 0.2 given_factors"),
                ("count_whole", "0.0 factors*, 0.1 fit*, 0.2 terms"),
                ("decide", "0.1 fit*, 0.2 terms, 1.0 fit_arguments*"),
                ("count_fine", "0.0 factors*, 0.1 fit*, 0.2 terms"),
                ("scale_factors", "0.0 factors*, 0.1 fit*, 0.2 terms"),
                ("tess_evaluate", "0.0 points, 0.1 vertices*, 0.2 status, 0.3 window, 0.8 factors"),
            ] {
                assert_eq!(bindings(&manifest, entry_point), expected, "{domain:?}, {entry_point}");
            }
            let uniform = &manifest["uniform"];
            assert_eq!(uniform[0]["factor"], 1.0, "{uniform}");
            assert_eq!(manifest["ladder"].as_array().map(Vec::len), Some(257), "all steps");
        }
    }

    /// `fit` and `terms` have the sizes of the structs in the shader.
    #[test]
    fn buffers_have_the_sizes_of_the_structs() {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let fixed = FixedShaders::new(Setup::new(Domain::Quad, config));
        let read = Read::new(&fixed.fit).expect("it is valid");
        let ty = |name: &str| {
            let found = read.module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
            found.expect("it is declared").1.inner.clone()
        };
        let naga::TypeInner::Struct { span, .. } = ty("Fit") else { panic!("Fit is a struct") };
        let naga::TypeInner::Struct { members, .. } = ty("Terms") else { panic!("so is Terms") };
        let ladder_at = u64::from(members.last().expect("the ladder").offset);
        let manifest = manifest(Domain::Quad);
        let buffers = manifest["buffers"].as_array().expect("a list");
        let bytes = |name: &str| {
            buffers.iter().find(|one| one["name"] == name).expect(name)["bytes"].as_u64()
        };
        assert_eq!(bytes("fit"), Some(span.into()), "the sums end it");
        assert_eq!(bytes("terms"), Some(ladder_at + 4 * fixed.ladder.len() as u64), "the ladder");
    }
}

//! `--stage`: the tessellation stage of `tess-wgpu` as files, for any host. docs/shaders.md
//! explains each entry of its manifest.

use super::formula::{Formula, Variable};
use super::manifest::{self, Described};
use super::sdl_header;
use super::stage_manifest::{Buffer, Manifest, Parts, Uniform, Vertex};
use super::stage_modules::{Sources, passes};
use super::stage_pulled;
use super::translation::Translation;
use crate::failure::Failure;
use crate::input;
use crate::output::json;
use serde::Deserialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tess_core::Domain;
use tess_gpu::{Capacity, Setup};
use tess_wgpu::TessellationStage;
use tess_wgpu::stage::{FixedShaders, Points, ShaderParts, UserShaders};

/// The manifest's file, and its first entry.
const FILE: &str = "stage.json";
const FORMAT: &str = "tess-stage 1";

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

/// The most workgroups of the pass that evaluates points, as in `tess-wgpu`.
const MOST_WORKGROUPS: u32 = 4096;

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
            most_workgroups: MOST_WORKGROUPS,
            group: (!is_parts).then_some(group),
            buffers: buffers(setup, &fixed, if is_evaluated { vertices.array_stride } else { 0 }),
            before_batch,
            after_batch,
            vertex,
            fragments,
            users,
            uniform: [1.0, 4.0, 8.0, 64.0].map(|factor| uniform(setup, factor)).into(),
            ladder: fixed.ladder.clone(),
            groups: is_parts.then(|| stage_pulled::groups(setup).0),
            pulled: is_parts.then(|| stage_pulled::pulled(setup)),
            parts: is_parts.then(|| Parts::new(setup, fixed)),
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
    fn new(setup: Setup, fixed: FixedShaders) -> Self {
        let parts = ShaderParts::new(setup);
        let [vertex_pulled, vertex_unindexed] = parts.vertex_pulled;
        Self {
            shared: parts.shared,
            hull: parts.hull,
            copy_factors: fixed.copy_factors,
            fit: fixed.fit,
            evaluate: parts.evaluate,
            vertex_stored: parts.vertex_stored,
            vertex_evaluated: parts.vertex_evaluated,
            vertex_pulled,
            vertex_unindexed,
            groups: stage_pulled::groups(setup).1,
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

#[cfg(test)]
mod tests {
    use super::super::stage_modules::Read;
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

    /// Hosts evaluate points with as many workgroups as `tess-wgpu` does.
    #[test]
    fn hosts_evaluate_as_the_stage_in_rust() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tess-wgpu/src/stage/evaluation.rs");
        let text = fs::read_to_string(file).expect("the stage in Rust");
        let declared = format!("\nconst MOST_WORKGROUPS: u32 = {MOST_WORKGROUPS};\n");
        assert!(text.contains(&declared), "{declared}");
        assert_eq!(manifest(Domain::Quad)["most_workgroups"], MOST_WORKGROUPS);
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

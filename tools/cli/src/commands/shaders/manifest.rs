//! The manifest: the data that a host needs to run the shaders. docs/shaders.md explains each
//! entry.

use super::plan::{Variant, resource_name, resources};
use super::structures::Structure;
use super::translation::Translation;
use super::{INDEX_TYPES, NUMBERINGS, POINTS, stage_files, surfaces};
use crate::args::{ORDERS, name_in};
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::Path;
use tess_gpu::sizes::ALIGNMENT;
use tess_gpu::{Resource, Setup};
use tess_verify::Named;

/// The file of the manifest, and its first entry.
pub(super) const FILE: &str = "manifest.json";
pub(super) const FORMAT: &str = "tess-shaders 1";

/// The file with the contents of the tables.
pub(super) const TABLES_FILE: &str = "tables.bin";

/// The manifest as a file for C.
pub(super) const HEADER_FILE: &str = "tess_shaders.h";

/// The stage's manifest as a file for C, with the layout for SDL.
pub(super) const STAGE_HEADER_FILE: &str = "tess_stage.h";

/// The names of the files that this command has written into a folder; empty if the folder has no
/// manifest of this format.
pub(super) fn files_of(folder: &Path) -> Vec<String> {
    #[derive(Deserialize)]
    struct Written {
        format: String,
        stages: Vec<WrittenStage>,
    }
    #[derive(Deserialize)]
    struct WrittenStage {
        file: String,
    }
    match serde_json::from_str::<Written>(&text_of(&folder.join(FILE))) {
        Ok(written) if written.format == FORMAT => {
            let own = [FILE, TABLES_FILE, HEADER_FILE, STAGE_HEADER_FILE, surfaces::FOLDER];
            let stages = written.stages.into_iter().map(|stage| stage.file);
            // What a compiler of HLSL makes of them lies beside them.
            let compiled =
                |name: &String| name.strip_suffix(".hlsl").map(|it| format!("{it}.dxil"));
            let all = stages.chain(stage_files(folder)).collect::<Vec<_>>();
            let compiled: Vec<String> = all.iter().filter_map(compiled).collect();
            own.map(str::to_owned).into_iter().chain(all).chain(compiled).collect()
        }
        _ => Vec::new(),
    }
}

/// The text of a file; empty if there is no such file.
pub(super) fn text_of(path: &Path) -> String {
    // A link could lead to a device without an end, and a pipe would wait for its writer.
    let is_file = path.symlink_metadata().is_ok_and(|found| found.is_file());
    if is_file { fs::read_to_string(path).unwrap_or_default() } else { String::new() }
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Manifest {
    pub(super) format: &'static str,
    pub(super) version: &'static str,
    #[serde(flatten)]
    pub(super) translation: Translation,
    pub(super) setup: Described,
    pub(super) stages: Vec<Stage>,
    pub(super) resources: Vec<ResourceRole>,
    /// The distance between two jobs in their buffer, in bytes.
    pub(super) job_stride: u64,
    pub(super) plans: Vec<Variant>,
    pub(super) structures: Vec<Structure>,
}

/// A setup as names and numbers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Described {
    pub(super) domain: &'static str,
    pub(super) partitioning: &'static str,
    pub(super) output: &'static str,
    pub(super) split: &'static str,
    pub(super) points: &'static str,
    pub(super) index_type: &'static str,
    pub(super) numbering: &'static str,
    pub(super) order: &'static str,
    pub(super) factors_per_patch: u32,
    pub(super) indices_per_primitive: u32,
    pub(super) bytes_per_index: u32,
    pub(super) bytes_per_point: u32,
}

/// A shader.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Stage {
    pub(super) name: &'static str,
    pub(super) file: String,
    pub(super) entry_point: String,
    pub(super) workgroup_size: [u32; 3],
    pub(super) bindings: Vec<Binding>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) msl_sizes: Option<MetalSizes>,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Binding {
    pub(super) set: u32,
    pub(super) binding: u32,
    pub(super) kind: Kind,
    pub(super) is_written: bool,
    #[serde(serialize_with = "resource_name")]
    pub(super) resource: Resource,
    pub(super) hlsl_register: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Kind {
    Uniform,
    Storage,
}

/// The buffer of Metal in which the host passes the lengths of others: one word per binding.
#[derive(Clone, Debug, Serialize)]
pub(super) struct MetalSizes {
    pub(super) buffer: u32,
    pub(super) of_bindings: Vec<u32>,
}

/// How the host uses a buffer.
#[derive(Clone, Debug, Serialize)]
pub(super) struct ResourceRole {
    #[serde(serialize_with = "resource_name")]
    pub(super) resource: Resource,
    pub(super) host: Host,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Host {
    /// It writes the jobs.
    WritesJobs,
    /// It writes the raw factors.
    WritesFactors,
    /// It writes the contents of `tables.bin`, once.
    WritesTables,
    /// It fills the buffer with zeros before the first run. Every run leaves it as the next one
    /// needs it.
    Clears,
    /// It dispatches and draws with the buffer.
    UsesIndirectly,
    /// It reads the result.
    Reads,
    /// It only keeps the buffer, whose contents pass from one dispatch to another.
    Keeps,
}

impl Manifest {
    pub(super) fn new(
        setup: Setup,
        translation: Translation,
        stages: Vec<Stage>,
        plans: Vec<Variant>,
        structures: Vec<Structure>,
    ) -> Self {
        let role = |resource| ResourceRole { resource, host: Host::of(resource) };
        Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION"),
            translation,
            setup: Described::new(setup),
            stages,
            resources: resources().map(role).collect(),
            job_stride: ALIGNMENT,
            plans,
            structures,
        }
    }
}

impl Described {
    pub(super) fn new(setup: Setup) -> Self {
        Self {
            domain: setup.domain.name(),
            partitioning: setup.config.partitioning.name(),
            output: setup.config.output.name(),
            split: setup.config.split.name(),
            points: name_in(POINTS, &setup.point_format),
            index_type: name_in(INDEX_TYPES, &setup.index_type),
            numbering: name_in(NUMBERINGS, &setup.numbering),
            order: name_in(ORDERS, &setup.order),
            factors_per_patch: setup.factors(),
            indices_per_primitive: setup.indices_per_primitive(),
            bytes_per_index: setup.index_type.bytes(),
            bytes_per_point: 8,
        }
    }
}

impl Host {
    const fn of(resource: Resource) -> Self {
        match resource {
            Resource::Job => Self::WritesJobs,
            Resource::Factors => Self::WritesFactors,
            Resource::Tables => Self::WritesTables,
            Resource::Catalogue => Self::Clears,
            Resource::Arguments | Resource::Draws => Self::UsesIndirectly,
            Resource::Status | Resource::Points | Resource::Indices => Self::Reads,
            Resource::Topologies
            | Resource::Contexts
            | Resource::Offsets
            | Resource::Tiles
            | Resource::Groups => Self::Keeps,
        }
    }
}

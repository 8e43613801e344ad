//! The manifest of a stage, `stage.json`. docs/shaders.md explains each entry.

use super::formula::Formula;
use super::manifest::Described;
use super::programs::{Program, User};
use super::translation::Translation;
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Manifest {
    pub(super) format: &'static str,
    pub(super) version: &'static str,
    /// The names of the files beside this one.
    pub(super) files: Vec<String>,
    #[serde(flatten)]
    pub(super) translation: Option<Translation>,
    pub(super) setup: Described,
    /// Threads of a workgroup in every pass whose workgroups depend on patches or points.
    pub(super) workgroup_size: u32,
    /// The most workgroups of a pass whose workgroups depend on points.
    pub(super) most_workgroups: u32,
    /// The number of the stage's own bind group, if the user's WGSL is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) group: Option<u32>,
    pub(super) buffers: Vec<Buffer>,
    /// The passes before and after the batch of `manifest.json`, in order.
    pub(super) before_batch: Vec<Pass>,
    pub(super) after_batch: Vec<Pass>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) vertex: Option<Vertex>,
    /// For SDL: the fragment shaders of the user's WGSL, and its resources.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) fragments: Option<Vec<Program>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) users: Option<Vec<User>>,
    /// Points and primitives of one patch whose factors all have this value.
    pub(super) uniform: Vec<Uniform>,
    pub(super) ladder: Vec<f32>,
    /// In parts: the pass after the batch that makes a draw for each group of patches, and what
    /// vertex shaders bind that compute the points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) groups: Option<Pass>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) pulled: Option<Vec<Bound>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) parts: Option<Parts>,
}

#[derive(Debug, Serialize)]
pub(super) struct Buffer {
    pub(super) name: &'static str,
    pub(super) bytes: Formula,
}

#[derive(Debug, Serialize)]
pub(super) struct Pass {
    pub(super) entry_point: String,
    /// The module; none in parts, where `part` names it, and for SDL, where `program` does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) file: Option<&'static str>,
    pub(super) part: &'static str,
    /// What the number of workgroups depends on.
    pub(super) workgroups: Workgroups,
    /// As the module in WGSL numbers them.
    pub(super) bindings: Vec<Bound>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) program: Option<Program>,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Workgroups {
    /// A thread for each patch that there is room for.
    Patches,
    /// One workgroup.
    One,
    /// Indirect: the three words of the buffer `fit_arguments`.
    FitArguments,
    /// A thread for each group of patches.
    Groups,
    /// A thread for each point that there is room for, but at most `most_workgroups`.
    Points,
}

#[derive(Debug, Serialize)]
pub(super) struct Bound {
    pub(super) group: u32,
    pub(super) binding: u32,
    pub(super) is_written: bool,
    pub(super) buffer: &'static str,
}

#[derive(Debug, Serialize)]
pub(super) struct Vertex {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) file: Option<&'static str>,
    pub(super) entry_point: &'static str,
    pub(super) stride: u64,
    pub(super) attributes: Vec<Attribute>,
    /// Further bindings of the draws, as the module in WGSL numbers them.
    pub(super) bindings: Vec<Bound>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) program: Option<Program>,
}

#[derive(Debug, Serialize)]
pub(super) struct Attribute {
    pub(super) location: u32,
    pub(super) offset: u64,
    /// As WebGPU names it, such as `float32x4`.
    pub(super) format: String,
}

#[derive(Debug, Serialize)]
pub(super) struct Uniform {
    pub(super) factor: f32,
    pub(super) points: u32,
    pub(super) primitives: u32,
}

/// The texts from which a host makes the modules: see `tess_wgpu::stage::ShaderParts`.
/// `vertex_pulled` and `vertex_unindexed` take the place of `vertex_stored` where points are
/// computed.
#[derive(Debug, Serialize)]
pub(super) struct Parts {
    pub(super) shared: String,
    pub(super) hull: String,
    pub(super) copy_factors: String,
    pub(super) fit: String,
    pub(super) evaluate: String,
    pub(super) vertex_stored: String,
    pub(super) vertex_evaluated: String,
    pub(super) vertex_pulled: String,
    pub(super) vertex_unindexed: String,
    pub(super) groups: String,
    pub(super) factors: String,
    pub(super) draws: Vec<[String; 3]>,
}

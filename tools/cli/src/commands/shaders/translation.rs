//! How stages are written: the language, and the checks in the shaders.

use clap::ValueEnum;
use serde::Serialize;

/// The languages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Target {
    /// WebGPU
    Wgsl,
    /// Vulkan 1.1, OpenGL 4.6: SPIR-V 1.3
    Spirv,
    /// OpenGL 4.3
    Glsl,
    /// Direct3D 11 and 12: shader model 5.1
    Hlsl,
    /// Metal 2.0; no compiler of Metal has checked it
    Msl,
}

/// The accesses and loops that a shader checks itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Checks {
    /// All: no access goes beyond a buffer, even one that is too small, and every loop ends
    Full,
    /// None: buffers must have the sizes given in the manifest
    None,
}

/// The places of resources.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Layout {
    /// All in set 0, numbered together
    Plain,
    /// As SDL 3's GPU interface expects them, with a header for the host in bindings/sdl
    Sdl,
}

/// How stages are written.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Translation {
    pub(super) target: Target,
    pub(super) layout: Layout,
    pub(super) checks: Checks,
}

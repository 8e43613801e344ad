//! Helpers that the tests share.

#![allow(dead_code, reason = "each test crate uses its part")]

pub(crate) mod evaluate;

use naga::Module;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use tess_gpu::{IndexType, Numbering, PointFormat, Setup};
use tess_verify::generate::configurations;

/// The functions that [`tess_gpu::Pull`] offers, called as a user's shader does.
pub(crate) const PULLING: &str = "
@group(0) @binding(4) var<storage, read_write> out: array<vec2<f32>>;
@compute @workgroup_size(64)
fn user(@builtin(global_invocation_id) id: vec3<u32>) {
    let corner = tess_primitive(id.x, id.y).x;
    out[id.x] = tess_location(id.x, corner) + vec2<f32>(tess_point(id.x, corner));
}
";

/// The functions of [`tess_gpu::Pull::source_for_drawing`], called as a user's vertex shader does.
pub(crate) const DRAWING: &str = "
@vertex
fn user(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4<f32> {
    let point = tess_point_at(vertex);
    let primitive = tess_primitive_at(vertex / 3u);
    let corner = tess_primitive(primitive.x, primitive.y)[vertex % 3u];
    return vec4<f32>(tess_location(point.x, point.y), tess_location(primitive.x, corner));
}
";

/// The function of [`tess_gpu::Counting`], called as a user's shader does.
pub(crate) const COUNTING: &str = "
@group(0) @binding(1) var<storage, read_write> out: array<vec2<u32>>;
@compute @workgroup_size(64)
fn user(@builtin(global_invocation_id) id: vec3<u32>) {
    out[id.x] = tess_counts(id.xyzx, id.xy);
}
";

/// Every configuration in every point format and numbering, and with 16-bit indices.
pub(crate) fn all_setups() -> Vec<Setup> {
    let mut all = Vec::new();
    for (domain, config) in configurations() {
        for point_format in [PointFormat::Packed, PointFormat::F32] {
            for numbering in [Numbering::PerBatch, Numbering::PerPatch] {
                all.push(Setup { point_format, numbering, ..Setup::new(domain, config) });
            }
        }
        let (numbering, index_type) = (Numbering::PerPatch, IndexType::U16);
        all.push(Setup { numbering, index_type, ..Setup::new(domain, config) });
    }
    all
}

/// The module of a shader.
pub(crate) fn parse(source: &str) -> Module {
    naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)))
}

/// Demands that the module of a shader passes every check without any optional capability.
pub(crate) fn validate(source: &str, module: &Module) {
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    if let Err(error) = validator.validate(module) {
        panic!("{}", error.emit_to_string(source));
    }
}

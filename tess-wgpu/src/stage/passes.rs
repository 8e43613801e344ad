//! The stage's compute pipelines, their bind groups and their workgroups.

use crate::Tessellator;
use crate::device::pipeline;
use crate::device::pipelines::PipelineKey;
use crate::error::Error;
use std::sync::Arc;
use tess_gpu::{Access, Resource};

/// The threads of a workgroup in the stage's own passes.
pub(crate) const WORKGROUP: u32 = 64;

/// The workgroups for a number of threads, in rows that the device allows.
pub(crate) fn workgroups(device: &wgpu::Device, threads: u32) -> [u32; 2] {
    let most = device.limits().max_compute_workgroups_per_dimension;
    let workgroups = threads.div_ceil(WORKGROUP);
    [workgroups.min(most), workgroups.div_ceil(most)]
}

/// A binding of a compute pass: a storage buffer, and whether it is only read.
pub(crate) type Binding<'a> = (&'a wgpu::Buffer, Access);

/// The layout of these storage buffers.
pub(crate) fn layout(
    tessellator: &Tessellator,
    label: &str,
    bindings: impl IntoIterator<Item = (u32, Access)>,
) -> Result<wgpu::BindGroupLayout, Error> {
    let entry = |(number, access)| {
        let storage = tess_gpu::Binding(Resource::Tables, access);
        pipeline::entry(number, storage, wgpu::ShaderStages::COMPUTE)
    };
    let entries = bindings.into_iter().map(entry).collect();
    tessellator.pipelines().layout(label, entries)
}

/// The layout and the bind group of these buffers, which get the bindings 0, 1, ...
pub(crate) fn bind(
    tessellator: &Tessellator,
    label: &str,
    buffers: &[Binding<'_>],
) -> Result<(wgpu::BindGroupLayout, wgpu::BindGroup), Error> {
    let layout = layout(tessellator, label, (0..).zip(buffers.iter().map(|one| one.1)))?;
    let bindings = (0..).zip(buffers.iter().map(|(buffer, _)| buffer.as_entire_binding()));
    let group = pipeline::group(tessellator.device(), label, &layout, bindings)?;
    Ok((layout, group))
}

/// The compute pipeline of a key. If the tessellator has none yet, it is made from `module`.
pub(crate) fn pipeline(
    tessellator: &Tessellator,
    key: PipelineKey,
    module: impl FnOnce() -> Result<wgpu::ShaderModule, Error>,
) -> Result<Arc<wgpu::ComputePipeline>, Error> {
    if let Some(pipeline) = tessellator.pipelines().passes.find(&key) {
        return Ok(pipeline);
    }
    let (module, constants) = (module()?, constants(&key));
    let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    let mut pipelines = tessellator.pipelines();
    let (of, cache) = ((&module, key.entry_point), pipelines.cache.as_ref());
    let made = pipeline::compute(tessellator.device(), of, &key.layouts, options, cache)?;
    Ok(pipelines.passes.keep(key, made))
}

/// The pipeline constants of a key, as wgpu takes them.
pub(crate) fn constants(key: &PipelineKey) -> Vec<(&str, f64)> {
    key.constants.iter().map(|(name, bits)| (name.as_str(), f64::from_bits(*bits))).collect()
}

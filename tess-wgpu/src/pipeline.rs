//! Compute pipelines of the shaders, and bind groups.

use crate::error::{Error, checked};
use tess_gpu::{Access, Binding, Resource, Stage};

/// The pipeline of a stage's source.
pub(crate) fn of_stage(
    device: &wgpu::Device,
    stage: Stage,
    source: &str,
    cache: Option<&wgpu::PipelineCache>,
) -> wgpu::ComputePipeline {
    let label = Some(stage.entry_point());
    let entries: Vec<_> = entries(stage.bindings()).collect();
    compute_pipeline(device, label, source, &entries, cache)
}

/// The pipeline of a tap's source: it binds the input, the output and the tables.
#[cfg(feature = "measure")]
pub(crate) fn of_tap(device: &wgpu::Device, source: &str) -> wgpu::ComputePipeline {
    let accesses = [Access::Read, Access::ReadWrite, Access::Read];
    let bindings = accesses.map(|access| Binding(Resource::Tables, access));
    let entries: Vec<_> = entries(&bindings).collect();
    compute_pipeline(device, Some("taps"), source, &entries, None)
}

fn compute_pipeline(
    device: &wgpu::Device,
    label: Option<&str>,
    source: &str,
    entries: &[wgpu::BindGroupLayoutEntry],
    cache: Option<&wgpu::PipelineCache>,
) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let group =
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(&group)],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label,
        layout: Some(&layout),
        module: &module,
        entry_point: label,
        compilation_options: wgpu::PipelineCompilationOptions {
            // Every word of it is written before it is read.
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache,
    })
}

/// The entries of bindings 0, 1, ... of a compute shader.
fn entries(bindings: &[Binding]) -> impl Iterator<Item = wgpu::BindGroupLayoutEntry> {
    (0..)
        .zip(bindings)
        .map(|(number, &binding)| entry(number, binding, wgpu::ShaderStages::COMPUTE))
}

/// The entry of a binding in the layout of its bind group.
pub(crate) const fn entry(
    binding: u32,
    Binding(resource, access): Binding,
    visibility: wgpu::ShaderStages,
) -> wgpu::BindGroupLayoutEntry {
    let ty = match (resource, access) {
        (Resource::Job, _) => wgpu::BufferBindingType::Uniform,
        (_, Access::Read) => wgpu::BufferBindingType::Storage { read_only: true },
        (_, Access::ReadWrite) => wgpu::BufferBindingType::Storage { read_only: false },
    };
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    }
}

/// A bind group of resources with their numbers.
pub(crate) fn group<'a>(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: impl IntoIterator<Item = (u32, wgpu::BindingResource<'a>)>,
) -> Result<wgpu::BindGroup, Error> {
    let entry = |(binding, resource)| wgpu::BindGroupEntry { binding, resource };
    let entries: Vec<_> = resources.into_iter().map(entry).collect();
    let descriptor = wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries };
    checked(device, || device.create_bind_group(&descriptor))
}

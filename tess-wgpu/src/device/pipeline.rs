//! Compute pipelines, their layouts and modules, and bind groups.

use crate::error::{Error, checked};
use tess_gpu::{Access, Binding, Resource};

/// Makes the compute pipeline of an entry point with these layouts.
pub(crate) fn compute(
    device: &wgpu::Device,
    (module, entry_point): (&wgpu::ShaderModule, &str),
    layouts: &[wgpu::BindGroupLayout],
    compilation_options: wgpu::PipelineCompilationOptions<'_>,
    cache: Option<&wgpu::PipelineCache>,
) -> Result<wgpu::ComputePipeline, Error> {
    let (layout, label) = (layout(device, entry_point, layouts)?, Some(entry_point));
    checked(device, || {
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&layout),
            module,
            entry_point: label,
            compilation_options,
            cache,
        })
    })
}

/// Makes the layout of a pipeline.
pub(crate) fn layout(
    device: &wgpu::Device,
    label: &str,
    layouts: &[wgpu::BindGroupLayout],
) -> Result<wgpu::PipelineLayout, Error> {
    let layouts: Vec<_> = layouts.iter().map(Some).collect();
    checked(device, || {
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        })
    })
}

/// Makes a module of WGSL that contains no text of the user.
pub(crate) fn module(
    device: &wgpu::Device,
    label: &str,
    source: String,
) -> Result<wgpu::ShaderModule, Error> {
    checked(device, || {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        })
    })
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

/// Makes a bind group of resources with their binding numbers.
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

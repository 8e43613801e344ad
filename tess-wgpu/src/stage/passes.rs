//! Compute pipelines of the stage, and how their threads are laid out.

use crate::error::{Error, checked};
use tess_gpu::Access;

/// The threads of a workgroup of the stage's own passes.
pub(crate) const WORKGROUP: u32 = 64;

/// The workgroups for a number of threads, in rows that the device allows.
pub(crate) fn workgroups(device: &wgpu::Device, threads: u32) -> [u32; 2] {
    let most = device.limits().max_compute_workgroups_per_dimension;
    let workgroups = threads.div_ceil(WORKGROUP);
    [workgroups.min(most), workgroups.div_ceil(most)]
}

/// A binding of a compute pass: a storage buffer, and whether it is only read.
pub(crate) type Binding<'a> = (&'a wgpu::Buffer, Access);

/// The layout and the bind group of these buffers, bindings 0, 1, ...
pub(crate) fn bind(
    device: &wgpu::Device,
    label: &str,
    buffers: &[Binding<'_>],
) -> Result<(wgpu::BindGroupLayout, wgpu::BindGroup), Error> {
    let label = Some(label);
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, (_, access))| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: *access == Access::Read },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    checked(device, || {
        let entries = &entries;
        let layout =
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries });
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, (buffer, _))| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let entries = &entries;
        let layout_of = &layout;
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label,
            layout: layout_of,
            entries,
        });
        (layout, group)
    })
}

/// A compute pipeline of a module.
pub(crate) fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    entry_point: &str,
    layouts: &[&wgpu::BindGroupLayout],
) -> Result<wgpu::ComputePipeline, Error> {
    let label = Some(entry_point);
    let layouts: Vec<_> = layouts.iter().map(|&layout| Some(layout)).collect();
    checked(device, || {
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&layout),
            module,
            entry_point: label,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    })
}

/// A module of the stage's own WGSL.
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

//! wgpu's objects, for the tests' own shaders, in few words.

#![allow(dead_code, unused_imports, reason = "each test crate uses its part")]

#[allow(clippy::duplicate_mod, reason = "tests load several examples")]
#[path = "../../examples/shared/bindings.rs"]
mod bindings;
#[allow(clippy::duplicate_mod, reason = "tests load several examples")]
#[path = "../../examples/shared/target.rs"]
mod target;

pub(crate) use bindings::{group, layout, whole};
pub(crate) use target::{copy_pixels, image, plain, view_of};
use tess_wgpu::{Error, Gpu};
use wgpu::{BindGroup, BindGroupLayout, BindingResource, BindingType};

/// A buffer that a shader reads, or that it may also write.
pub(crate) const fn storage(read_only: bool) -> BindingType {
    buffer(wgpu::BufferBindingType::Storage { read_only })
}

/// A whole buffer.
pub(crate) const fn buffer(ty: wgpu::BufferBindingType) -> BindingType {
    BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

/// A part of a buffer.
pub(crate) fn part(buffer: &wgpu::Buffer, offset: u64, size: u64) -> BindingResource<'_> {
    let size = std::num::NonZeroU64::new(size);
    BindingResource::Buffer(wgpu::BufferBinding { buffer, offset, size })
}

/// A compute pipeline with these layouts or, if there are none, with those that wgpu finds in the
/// text.
pub(crate) fn compute(
    device: &wgpu::Device,
    wgsl: String,
    entry_point: &str,
    layouts: &[&BindGroupLayout],
) -> wgpu::ComputePipeline {
    let (label, source) = (Some(entry_point), wgpu::ShaderSource::Wgsl(wgsl.into()));
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source });
    let layouts: Vec<_> = layouts.iter().map(|&layout| Some(layout)).collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &layouts,
        immediate_size: 0,
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label,
        layout: (!layouts.is_empty()).then_some(&layout),
        module: &module,
        entry_point: label,
        compilation_options: Default::default(),
        cache: None,
    })
}

/// Runs a compute pipeline with these bind groups, and waits for it.
pub(crate) fn dispatch(
    gpu: &Gpu,
    pipeline: &wgpu::ComputePipeline,
    groups: &[&BindGroup],
    workgroups: u32,
) -> Result<(), Error> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(pipeline);
    for (number, &group) in (0..).zip(groups) {
        pass.set_bind_group(number, group, &[]);
    }
    pass.dispatch_workgroups(workgroups, 1, 1);
    drop(pass);
    gpu.run(encoder)
}

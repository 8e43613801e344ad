//! Bind groups of resources that shaders read.

#![allow(dead_code, reason = "each user has its part")]

use tess_wgpu::Gpu;
use wgpu::{BindGroup, BindGroupLayout, BindingResource, BindingType, ShaderStages};

/// Something that is bound.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bound<'a> {
    Uniform(&'a wgpu::Buffer),
    Read(&'a wgpu::Buffer),
    /// A texture whose texels are loaded, not sampled.
    Texture(&'a wgpu::TextureView),
    Depth(&'a wgpu::TextureView),
    Comparison(&'a wgpu::Sampler),
}

/// The layout and the bind group of these resources, as bindings 0, 1, ..., for all shader stages.
pub(crate) fn bind<'a>(gpu: &Gpu, all: &[Bound<'a>]) -> (BindGroupLayout, BindGroup) {
    let buffer = |ty| BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture = |sample_type| BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let kind = |bound: &Bound<'_>| match bound {
        Bound::Uniform(_) => buffer(wgpu::BufferBindingType::Uniform),
        Bound::Read(_) => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Bound::Texture(_) => texture(wgpu::TextureSampleType::Float { filterable: false }),
        Bound::Depth(_) => texture(wgpu::TextureSampleType::Depth),
        Bound::Comparison(_) => BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
    };
    let visibility = ShaderStages::COMPUTE | ShaderStages::VERTEX_FRAGMENT;
    let layout = layout(&gpu.device, visibility, all.iter().map(kind));
    let resource = |bound: &Bound<'a>| match *bound {
        Bound::Uniform(buffer) | Bound::Read(buffer) => buffer.as_entire_binding(),
        Bound::Texture(view) | Bound::Depth(view) => BindingResource::TextureView(view),
        Bound::Comparison(sampler) => BindingResource::Sampler(sampler),
    };
    let group = group(&gpu.device, &layout, (0..).zip(all.iter().map(resource)));
    (layout, group)
}

/// A layout of the bindings 0, 1, ...
pub(crate) fn layout(
    device: &wgpu::Device,
    visibility: ShaderStages,
    types: impl IntoIterator<Item = BindingType>,
) -> BindGroupLayout {
    let entry = |(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let entries: Vec<_> = (0..).zip(types).map(entry).collect();
    let entries = &entries;
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries })
}

/// A bind group of resources with their numbers.
pub(crate) fn group<'a>(
    device: &wgpu::Device,
    layout: &BindGroupLayout,
    resources: impl IntoIterator<Item = (u32, BindingResource<'a>)>,
) -> BindGroup {
    let entry = |(binding, resource)| wgpu::BindGroupEntry { binding, resource };
    let entries: Vec<_> = resources.into_iter().map(entry).collect();
    let entries = &entries;
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries })
}

/// Whole buffers, as the bindings 0, 1, ...
pub(crate) fn whole<'a>(
    buffers: impl IntoIterator<Item = &'a wgpu::Buffer>,
) -> impl Iterator<Item = (u32, BindingResource<'a>)> {
    (0..).zip(buffers.into_iter().map(wgpu::Buffer::as_entire_binding))
}

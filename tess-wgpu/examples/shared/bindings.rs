//! Bind groups of what shaders read.

use tess_wgpu::Gpu;

/// Something that is bound.
#[derive(Clone, Copy, Debug)]
#[allow(dead_code, reason = "each example binds its own")]
pub(crate) enum Bound<'a> {
    Uniform(&'a wgpu::Buffer),
    Read(&'a wgpu::Buffer),
    /// A texture that is loaded from, not sampled.
    Texture(&'a wgpu::TextureView),
    /// 16 bytes at a dynamic offset.
    Dynamic(&'a wgpu::Buffer),
    Depth(&'a wgpu::TextureView),
    Comparison(&'a wgpu::Sampler),
}

/// The layout and the bind group of these, bindings 0, 1, ..., for all stages.
pub(crate) fn bind(gpu: &Gpu, all: &[Bound<'_>]) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let buffer = |ty, has_dynamic_offset| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset,
        min_binding_size: None,
    };
    let texture = |sample_type| wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let kind = |bound: &Bound<'_>| match bound {
        Bound::Uniform(_) => buffer(wgpu::BufferBindingType::Uniform, false),
        Bound::Dynamic(_) => buffer(wgpu::BufferBindingType::Uniform, true),
        Bound::Read(_) => buffer(wgpu::BufferBindingType::Storage { read_only: true }, false),
        Bound::Texture(_) => texture(wgpu::TextureSampleType::Float { filterable: false }),
        Bound::Depth(_) => texture(wgpu::TextureSampleType::Depth),
        Bound::Comparison(_) => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
    };
    let visibility = wgpu::ShaderStages::COMPUTE | wgpu::ShaderStages::VERTEX_FRAGMENT;
    let layouts: Vec<_> = (0..)
        .zip(all)
        .map(|(binding, bound)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: kind(bound),
            count: None,
        })
        .collect();
    let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &layouts,
    });
    let entries: Vec<_> = (0..)
        .zip(all)
        .map(|(binding, bound)| wgpu::BindGroupEntry {
            binding,
            resource: match *bound {
                Bound::Uniform(buffer) | Bound::Read(buffer) => buffer.as_entire_binding(),
                Bound::Texture(view) | Bound::Depth(view) => {
                    wgpu::BindingResource::TextureView(view)
                }
                Bound::Comparison(sampler) => wgpu::BindingResource::Sampler(sampler),
                Bound::Dynamic(buffer) => wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset: 0,
                    size: std::num::NonZeroU64::new(16),
                }),
            },
        })
        .collect();
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    });
    (layout, group)
}

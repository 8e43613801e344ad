//! Bind groups of read-only things.

use tess_wgpu::Gpu;

/// What is bound.
#[derive(Clone, Copy, Debug)]
#[allow(dead_code, reason = "each example binds its own")]
pub(crate) enum Bound<'a> {
    Uniform(&'a wgpu::Buffer),
    Read(&'a wgpu::Buffer),
    /// A texture that is loaded from, not sampled.
    Texture(&'a wgpu::TextureView),
}

/// The layout and the bind group of these, bindings 0, 1, ..., for all stages.
pub(crate) fn bind(gpu: &Gpu, all: &[Bound<'_>]) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let buffer =
        |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let kind = |bound: &Bound<'_>| match bound {
        Bound::Uniform(_) => buffer(wgpu::BufferBindingType::Uniform),
        Bound::Read(_) => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Bound::Texture(_) => wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
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
                Bound::Texture(view) => wgpu::BindingResource::TextureView(view),
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

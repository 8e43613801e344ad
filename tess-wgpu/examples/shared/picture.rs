//! The common part of pictures: a batch tessellated and drawn by one command buffer, and its pixels.

use std::error::Error;
use tess_gpu::Setup;
use tess_gpu::layout::{DrawIndexed, Status};
use tess_wgpu::{Batch, Gpu, Outputs, Tessellator};
use wgpu::BufferUsages as Usage;

/// Pixels across.
pub(crate) const WIDTH: u32 = 960;
/// Pixels down.
pub(crate) const HEIGHT: u32 = 720;

const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// A batch's patches, and how they are drawn.
#[derive(Debug)]
pub(crate) struct Scene<'a> {
    /// The tessellation, with packed points.
    pub(crate) setup: Setup,
    /// The number of patches.
    pub(crate) patches: u32,
    /// Their factors.
    pub(crate) factors: &'a wgpu::Buffer,
    /// Bytes of room for points and for indices.
    pub(crate) room: [u64; 2],
    /// WGSL with the entry points `place_vertex` and `shade`.
    pub(crate) source: &'a str,
    /// The shaders' binding 0 of group 0, if they have one.
    pub(crate) read: Option<&'a wgpu::Buffer>,
    /// The meshes that the patches belong to; if there are none, all patches are drawn at once.
    pub(crate) meshes: &'a [Mesh<'a>],
    /// Triangles that are not drawn; the front is counter-clockwise.
    pub(crate) cull: Option<wgpu::Face>,
    /// The colour behind everything.
    pub(crate) background: wgpu::Color,
}

/// Some of a scene's patches, drawn with a material of their own.
#[derive(Debug)]
pub(crate) struct Mesh<'a> {
    /// The first patch. The mesh ends where the next one begins.
    pub(crate) first_patch: u32,
    /// The shaders' binding 0 of group 1, with the usage `UNIFORM`.
    pub(crate) material: &'a wgpu::Buffer,
}

/// Tessellates and draws a scene behind what `encoder` has recorded, and submits it. The pixels
/// are RGBA, row by row.
///
/// # Errors
/// If the device was lost, or there was too little room for points or indices.
pub(crate) fn render(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    scene: &Scene<'_>,
) -> Result<Vec<u8>, Box<dyn Error>> {
    let [point_bytes, index_bytes] = scene.room;
    let points = gpu.buffer("points", point_bytes, Usage::STORAGE | Usage::VERTEX)?;
    let indices = gpu.buffer("indices", index_bytes, Usage::STORAGE | Usage::INDEX)?;
    let outputs = Outputs::Buffers { points: &points, indices: &indices };
    let groups: Vec<u32> = scene.meshes.iter().map(|mesh| mesh.first_patch).collect();
    let mut tessellator = Tessellator::new(&gpu.device);
    let Scene { setup, patches, factors, .. } = *scene;
    let batch = tessellator.batch_in_groups(setup, patches, &groups, factors, outputs)?;
    let color = texture(gpu, COLOR, wgpu::TextureUsages::COPY_SRC);
    let depth = texture(gpu, DEPTH, wgpu::TextureUsages::empty());
    let pixels =
        gpu.buffer("pixels", u64::from(4 * WIDTH * HEIGHT), Usage::COPY_DST | Usage::COPY_SRC)?;
    let pipeline = render_pipeline(gpu, scene);

    batch.encode(&mut encoder);
    {
        let mut pass = begin_render_pass(&mut encoder, &color, &depth, scene.background);
        pass.set_pipeline(&pipeline);
        if let Some(buffer) = scene.read {
            let layout = pipeline.get_bind_group_layout(0);
            pass.set_bind_group(0, &bind_group(gpu, &layout, &[buffer]), &[]);
        }
        pass.set_vertex_buffer(0, points.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        draw(gpu, &mut pass, &pipeline, &batch, scene.meshes);
    }
    copy_pixels(&mut encoder, &color, &pixels);
    gpu.run(encoder)?;
    let status = gpu.read(batch.status(), size_of::<Status>() as u64)?;
    if !bytemuck::pod_read_unaligned::<Status>(&status).fits() {
        return Err(format!("the output does not fit {point_bytes} and {index_bytes} bytes").into());
    }
    Ok(gpu.read(&pixels, pixels.size())?)
}

/// Draws each mesh with its material, or everything if there are no meshes.
fn draw(
    gpu: &Gpu,
    pass: &mut wgpu::RenderPass<'_>,
    pipeline: &wgpu::RenderPipeline,
    batch: &Batch,
    meshes: &[Mesh<'_>],
) {
    if meshes.is_empty() {
        pass.draw_indexed_indirect(batch.draw_arguments(), 0);
    }
    for (number, mesh) in (0..).zip(meshes) {
        let layout = pipeline.get_bind_group_layout(1);
        pass.set_bind_group(1, &bind_group(gpu, &layout, &[mesh.material]), &[]);
        let offset = number * size_of::<DrawIndexed>() as u64;
        pass.draw_indexed_indirect(batch.group_arguments(), offset);
    }
}

/// A shader module of WGSL text.
pub(crate) fn module(gpu: &Gpu, source: &str) -> wgpu::ShaderModule {
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

/// Whole buffers as bindings 0, 1, ...
pub(crate) fn bind_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    buffers: &[&wgpu::Buffer],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}

fn copy_pixels(encoder: &mut wgpu::CommandEncoder, color: &wgpu::Texture, pixels: &wgpu::Buffer) {
    encoder.copy_texture_to_buffer(
        color.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: pixels,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * WIDTH),
                rows_per_image: None,
            },
        },
        color.size(),
    );
}

fn texture(gpu: &Gpu, format: wgpu::TextureFormat, more: wgpu::TextureUsages) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: WIDTH, height: HEIGHT, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | more,
        view_formats: &[],
    })
}

fn begin_render_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    color: &wgpu::Texture,
    depth: &wgpu::Texture,
    background: wgpu::Color,
) -> wgpu::RenderPass<'a> {
    let color = color.create_view(&wgpu::TextureViewDescriptor::default());
    let depth = depth.create_view(&wgpu::TextureViewDescriptor::default());
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(background),
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Discard,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

fn render_pipeline(gpu: &Gpu, scene: &Scene<'_>) -> wgpu::RenderPipeline {
    let module = module(gpu, scene.source);
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("picture"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("place_vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 8,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Uint32x2],
            })],
        },
        primitive: wgpu::PrimitiveState {
            front_face: wgpu::FrontFace::Ccw,
            cull_mode: scene.cull,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(COLOR.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

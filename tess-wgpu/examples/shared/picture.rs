//! The common part of pictures: a batch tessellated and drawn by one command buffer, and its pixels.

#[allow(clippy::duplicate_mod, reason = "tests load several examples")]
#[path = "bindings.rs"]
mod bindings;
#[allow(clippy::duplicate_mod, reason = "tests load several examples")]
#[path = "target.rs"]
mod target;

pub(crate) use bindings::{group, whole};
use std::error::Error;
use target::{DEPTH, begin_pass, copy_pixels, depth, texture, view_of};
use tess_gpu::Setup;
use tess_gpu::layout::{DrawIndexed, Status};
use tess_wgpu::{Batch, Gpu, Outputs, Tessellator};
use wgpu::BufferUsages as Usage;

/// Pixels across.
pub(crate) const WIDTH: u32 = 960;
/// Pixels down.
pub(crate) const HEIGHT: u32 = 720;

const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

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
    let [color, depth] = [COLOR, DEPTH].map(|format| texture(gpu, format, [WIDTH, HEIGHT]));
    let pixels =
        gpu.buffer("pixels", u64::from(4 * WIDTH * HEIGHT), Usage::COPY_DST | Usage::COPY_SRC)?;
    let pipeline = render_pipeline(gpu, scene);

    batch.encode(&mut encoder);
    {
        let targets = [&view_of(&color), &view_of(&depth)];
        let mut pass = begin_pass(&mut encoder, targets, scene.background);
        pass.set_pipeline(&pipeline);
        if let Some(buffer) = scene.read {
            let layout = pipeline.get_bind_group_layout(0);
            pass.set_bind_group(0, &group(&gpu.device, &layout, whole([buffer])), &[]);
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
        pass.set_bind_group(1, &group(&gpu.device, &layout, whole([mesh.material])), &[]);
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
        depth_stencil: Some(depth()),
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

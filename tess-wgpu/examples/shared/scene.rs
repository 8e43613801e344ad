//! A scene drawn from a batch, every step of which is recorded into one command buffer.

use crate::app::depth;
use crate::bindings::{group, whole};
use std::error::Error;
use tess_gpu::Setup;
use tess_gpu::layout::{DrawIndexed, Status};
use tess_wgpu::{Batch, Gpu, Outputs, Tessellator};
use wgpu::BufferUsages as Usage;

/// The patches of a batch, and their shaders.
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
    /// The face that is not drawn; the front is counter-clockwise.
    pub(crate) cull: Option<wgpu::Face>,
}

/// Some of a scene's patches, drawn with a material of their own.
#[derive(Debug)]
pub(crate) struct Mesh<'a> {
    /// The first patch. The mesh ends where the next one begins.
    pub(crate) first_patch: u32,
    /// The shaders' binding 0 of group 1, with the usage `UNIFORM`.
    pub(crate) material: &'a wgpu::Buffer,
}

/// A scene's objects.
pub(crate) struct Drawn {
    batch: Batch,
    points: wgpu::Buffer,
    indices: wgpu::Buffer,
    pipeline: wgpu::RenderPipeline,
    /// The bind group 0.
    read: Option<wgpu::BindGroup>,
    /// The bind group 1 of each mesh.
    materials: Vec<wgpu::BindGroup>,
}

impl Drawn {
    /// Makes a scene's objects, for a picture of this format.
    pub(crate) fn new(
        gpu: &Gpu,
        format: wgpu::TextureFormat,
        scene: &Scene<'_>,
    ) -> Result<Self, Box<dyn Error>> {
        let [point_bytes, index_bytes] = scene.room;
        let points = gpu.buffer("points", point_bytes, Usage::STORAGE | Usage::VERTEX)?;
        let indices = gpu.buffer("indices", index_bytes, Usage::STORAGE | Usage::INDEX)?;
        let outputs = Outputs::Buffers { points: &points, indices: &indices };
        let groups: Vec<u32> = scene.meshes.iter().map(|mesh| mesh.first_patch).collect();
        let mut tessellator = Tessellator::new(&gpu.device);
        let Scene { setup, patches, factors, .. } = *scene;
        let batch = tessellator.batch_in_groups(setup, patches, &groups, factors, outputs)?;
        let pipeline = render_pipeline(gpu, format, scene);
        let bound = |number, buffer| {
            group(&gpu.device, &pipeline.get_bind_group_layout(number), whole([buffer]))
        };
        let read = scene.read.map(|buffer| bound(0, buffer));
        let materials = scene.meshes.iter().map(|mesh| bound(1, mesh.material)).collect();
        Ok(Self { batch, points, indices, pipeline, read, materials })
    }

    /// Records the tessellation.
    pub(crate) fn prepare(&self, encoder: &mut wgpu::CommandEncoder) {
        self.batch.encode(encoder);
    }

    /// Draws each mesh with its material, or everything if there are no meshes.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.read, &[]);
        pass.set_vertex_buffer(0, self.points.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        if self.materials.is_empty() {
            pass.draw_indexed_indirect(self.batch.draw_arguments(), 0);
        }
        for (number, material) in (0..).zip(&self.materials) {
            pass.set_bind_group(1, material, &[]);
            let offset = number * size_of::<DrawIndexed>() as u64;
            pass.draw_indexed_indirect(self.batch.group_arguments(), offset);
        }
    }

    /// # Errors
    /// If the device was lost, or there was too little room for points or indices.
    pub(crate) fn check(&self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        let status = gpu.read(self.batch.status(), size_of::<Status>() as u64)?;
        if bytemuck::pod_read_unaligned::<Status>(&status).fits() {
            return Ok(());
        }
        let [points, indices] = [&self.points, &self.indices].map(wgpu::Buffer::size);
        Err(format!("the output does not fit {points} and {indices} bytes").into())
    }
}

/// A shader module of WGSL text.
pub(crate) fn module(gpu: &Gpu, source: &str) -> wgpu::ShaderModule {
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn render_pipeline(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    scene: &Scene<'_>,
) -> wgpu::RenderPipeline {
    let module = module(gpu, scene.source);
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("scene"),
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
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

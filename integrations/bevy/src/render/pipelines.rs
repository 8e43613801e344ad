//! The pipelines of programs, for what cameras need of them.

use super::layout;
use crate::program::{DRAW_GROUP, Program};
use bevy::ecs::prelude::*;
use bevy::mesh::{MeshVertexBufferLayoutRef, MeshVertexBufferLayouts, VertexBufferLayout};
use bevy::pbr::{MeshPipeline, MeshPipelineKey};
use bevy::platform::collections::HashMap;
use bevy::render::render_resource::{
    CachedRenderPipelineId, PipelineCache, PolygonMode, PrimitiveTopology,
    RenderPipelineDescriptor, SpecializedMeshPipeline, VertexAttribute, VertexFormat,
    VertexStepMode,
};
use bevy::render::view::RetainedViewEntity;

/// The pipelines of programs, for what cameras need of them.
#[derive(Debug, Default, Resource)]
pub(crate) struct Pipelines {
    /// By the program's number, what the camera needs, and whether as a wireframe.
    all: HashMap<(usize, MeshPipelineKey, bool), CachedRenderPipelineId>,
    /// The keys of this frame's cameras.
    views: HashMap<RetainedViewEntity, (MeshPipelineKey, bool)>,
}

impl Pipelines {
    /// The pipeline of a program for a camera.
    pub(crate) fn of(
        &self,
        program: usize,
        view: RetainedViewEntity,
    ) -> Option<CachedRenderPipelineId> {
        let &(mesh_key, wireframe) = self.views.get(&view)?;
        self.all.get(&(program, mesh_key, wireframe)).copied()
    }

    /// Forgets the cameras of the frame before.
    pub(crate) fn begin(&mut self) {
        self.views.clear();
    }

    /// Asks for the pipelines that a camera needs for these programs, and notes the camera's key.
    pub(crate) fn request<'a>(
        &mut self,
        view: RetainedViewEntity,
        (key, wireframe): (MeshPipelineKey, bool),
        programs: impl Iterator<Item = &'a Program>,
        (mesh_pipeline, cache): (&MeshPipeline, &PipelineCache),
    ) {
        self.views.insert(view, (key, wireframe));
        for program in programs {
            self.all.entry((program.number, key, wireframe)).or_insert_with(|| {
                cache.queue_render_pipeline(descriptor(mesh_pipeline, program, key, wireframe))
            });
        }
    }
}

/// A mesh with the attributes that a fallback has, for whose layout Bevy states what a camera needs.
fn layout_of_a_mesh() -> MeshVertexBufferLayoutRef {
    crate::cpu::mesh(Default::default(), PrimitiveTopology::TriangleList)
        .get_mesh_vertex_buffer_layout(&mut MeshVertexBufferLayouts::default())
}

/// Bevy's pipeline for meshes, with the program's shaders and bind group in place of those for meshes.
fn descriptor(
    mesh_pipeline: &MeshPipeline,
    program: &Program,
    key: MeshPipelineKey,
    wireframe: bool,
) -> RenderPipelineDescriptor {
    let key = key
        | MeshPipelineKey::from_primitive_topology_and_strip_index(
            PrimitiveTopology::TriangleList,
            None,
        );
    let mut descriptor = mesh_pipeline
        .specialize(key, &layout_of_a_mesh())
        .expect("the mesh has the attributes that Bevy asks for");
    descriptor.label = Some("bevy_tess".into());
    descriptor.layout[DRAW_GROUP] = layout::bind_group_layout();
    descriptor.layout.truncate(DRAW_GROUP + 1);
    descriptor.vertex.shader = program.vertex.clone();
    descriptor.vertex.entry_point = Some("tess_vertex".into());
    descriptor.vertex.shader_defs.clear();
    descriptor.vertex.buffers = vec![VertexBufferLayout {
        array_stride: 8,
        step_mode: VertexStepMode::Vertex,
        attributes: vec![VertexAttribute {
            format: VertexFormat::Uint32x2,
            offset: 0,
            shader_location: 0,
        }],
    }];
    if let Some(fragment) = &mut descriptor.fragment {
        fragment.shader = program.fragment.clone();
        fragment.entry_point = None;
    }
    if wireframe {
        descriptor.primitive.polygon_mode = PolygonMode::Line;
        descriptor.primitive.cull_mode = None;
    }
    descriptor
}

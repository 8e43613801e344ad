//! The pipelines of programs, for what cameras and lights need of them.

use super::layout;
use crate::program::{DRAW_GROUP, Program};
use bevy::ecs::prelude::*;
use bevy::ecs::system::SystemParam;
use bevy::material::MaterialProperties;
use bevy::material::key::{ErasedMaterialKey, ErasedMaterialPipelineKey, ErasedMeshPipelineKey};
use bevy::mesh::{MeshVertexBufferLayoutRef, MeshVertexBufferLayouts, VertexBufferLayout};
use bevy::pbr::{MeshPipeline, MeshPipelineKey, PrepassPipeline, PrepassPipelineSpecializer};
use bevy::platform::collections::HashMap;
use bevy::render::render_resource::{
    CachedRenderPipelineId, Face, PipelineCache, PolygonMode, PrimitiveTopology,
    RenderPipelineDescriptor, SpecializedMeshPipeline, VertexAttribute, VertexFormat,
    VertexStepMode,
};
use std::any::TypeId;
use std::sync::Arc;

/// What is drawn: of Bevy's key, whether only depth, normals and motion, and whether as a wireframe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Kind {
    pub(crate) key: MeshPipelineKey,
    pub(crate) is_prepass: bool,
    pub(crate) wireframe: bool,
}

/// The pipelines so far, by the program's number.
#[derive(Debug, Default, Resource)]
pub(crate) struct Pipelines(HashMap<(usize, Kind), CachedRenderPipelineId>);

/// Bevy's own pipelines, which state what cameras and lights need.
#[derive(SystemParam)]
pub(crate) struct Own<'w> {
    mesh: Res<'w, MeshPipeline>,
    prepass: Res<'w, PrepassPipeline>,
    cache: Res<'w, PipelineCache>,
}

impl Pipelines {
    /// The pipeline of a program for what is drawn.
    pub(crate) fn get(
        &mut self,
        program: &Program,
        kind: Kind,
        own: &Own<'_>,
    ) -> CachedRenderPipelineId {
        *self
            .0
            .entry((program.number, kind))
            .or_insert_with(|| own.cache.queue_render_pipeline(descriptor(own, program, kind)))
    }
}

/// A mesh with the attributes that a fallback has, for whose layout Bevy states what a camera needs.
fn layout_of_a_mesh() -> MeshVertexBufferLayoutRef {
    crate::cpu::mesh(Default::default(), PrimitiveTopology::TriangleList)
        .get_mesh_vertex_buffer_layout(&mut MeshVertexBufferLayouts::default())
}

/// Bevy's pipeline for meshes, with the program's shaders and bind group in place of those for meshes.
fn descriptor(own: &Own<'_>, program: &Program, kind: Kind) -> RenderPipelineDescriptor {
    let mut descriptor = of_a_mesh(own, kind);
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
        let shader = if kind.is_prepass { &program.prepass } else { &program.fragment };
        fragment.shader = shader.clone();
        fragment.entry_point = None;
    }
    descriptor.primitive.cull_mode = Some(Face::Back);
    if kind.wireframe {
        descriptor.primitive.polygon_mode = PolygonMode::Line;
        descriptor.primitive.cull_mode = None;
    }
    descriptor
}

/// Bevy's pipeline for a mesh. Where the device cannot draw what is in front of the near plane, the vertex shader moves
/// it there.
fn of_a_mesh(own: &Own<'_>, Kind { mut key, is_prepass, .. }: Kind) -> RenderPipelineDescriptor {
    key |= MeshPipelineKey::from_primitive_topology_and_strip_index(
        PrimitiveTopology::TriangleList,
        None,
    );
    let unclipped = MeshPipelineKey::UNCLIPPED_DEPTH_ORTHO;
    let clamps = key.contains(unclipped) && !own.prepass.depth_clip_control_supported;
    key.set(unclipped, key.contains(unclipped) && !clamps);
    let layout = layout_of_a_mesh();
    let specialized = if is_prepass {
        let properties = MaterialProperties {
            material_layout: Some(own.prepass.empty_layout.clone()),
            ..Default::default()
        };
        let pipeline = own.prepass.clone();
        PrepassPipelineSpecializer { pipeline, properties: Arc::new(properties) }.specialize(
            ErasedMaterialPipelineKey {
                mesh_key: ErasedMeshPipelineKey::new(key),
                material_key: ErasedMaterialKey::new(()),
                type_id: TypeId::of::<()>(),
            },
            &layout,
        )
    } else {
        own.mesh.specialize(key, &layout)
    };
    let mut descriptor = specialized.expect("the mesh has the attributes that Bevy asks for");
    descriptor.vertex.constants = vec![("tess_clamps".into(), f64::from(clamps))];
    descriptor
}

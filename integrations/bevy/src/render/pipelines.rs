//! The pipelines of programs, for the passes of cameras and lights.

use super::layout;
use crate::program::{DRAW_GROUP, Program};
use bevy::ecs::prelude::*;
use bevy::ecs::system::SystemParam;
use bevy::material::MaterialProperties;
use bevy::material::key::{ErasedMaterialPipelineKey, ErasedMeshPipelineKey};
use bevy::material::specialize::SpecializedMeshPipelineError;
use bevy::mesh::{MeshVertexBufferLayoutRef, MeshVertexBufferLayouts, VertexBufferLayout};
use bevy::pbr::{
    MATERIAL_BIND_GROUP_INDEX, MaterialPipeline, MeshPipeline, MeshPipelineKey, PrepassPipeline,
    PrepassPipelineSpecializer,
};
use bevy::platform::collections::HashMap;
use bevy::render::render_resource::{
    CachedRenderPipelineId, PipelineCache, PolygonMode, PrimitiveTopology,
    RenderPipelineDescriptor, SpecializedMeshPipeline, VertexAttribute, VertexFormat,
    VertexStepMode,
};
use bevy::shader::ShaderDefVal;
use std::sync::Arc;

/// A kind of draw: Bevy's key, whether only depth, normals and motion are drawn, and whether as a
/// wireframe.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Kind {
    pub(crate) key: ErasedMaterialPipelineKey,
    pub(crate) is_prepass: bool,
    pub(crate) wireframe: bool,
}

/// The pipelines made so far, by the program's number and the kind.
#[derive(Debug, Default, Resource)]
pub(crate) struct Pipelines(HashMap<(usize, Kind), CachedRenderPipelineId>);

/// Bevy's own pipelines, from which those of programs are made.
#[derive(SystemParam)]
pub(crate) struct Own<'w> {
    mesh: Res<'w, MeshPipeline>,
    prepass: Res<'w, PrepassPipeline>,
    cache: Res<'w, PipelineCache>,
}

impl Pipelines {
    /// The pipeline of a program for a kind of draw.
    pub(crate) fn get(
        &mut self,
        program: &Program,
        kind: Kind,
        properties: &Arc<MaterialProperties>,
        own: &Own<'_>,
    ) -> CachedRenderPipelineId {
        *self.0.entry((program.number, kind)).or_insert_with_key(|(_, kind)| {
            own.cache.queue_render_pipeline(descriptor(own, program, kind, properties))
        })
    }
}

/// A mesh with the attributes of the CPU's meshes. For its layout Bevy makes the pipelines that the
/// plugin adapts.
fn layout_of_a_mesh() -> MeshVertexBufferLayoutRef {
    crate::cpu::mesh(Default::default(), PrimitiveTopology::TriangleList)
        .get_mesh_vertex_buffer_layout(&mut MeshVertexBufferLayouts::default())
}

/// Bevy's pipeline for meshes, with the program's shaders and bind group in place of the meshes'.
fn descriptor(
    own: &Own<'_>,
    program: &Program,
    kind: &Kind,
    properties: &Arc<MaterialProperties>,
) -> RenderPipelineDescriptor {
    let mut descriptor = of_a_mesh(own, kind, properties);
    descriptor.label = Some("bevy_tess".into());
    descriptor.layout.truncate(DRAW_GROUP);
    descriptor.layout.push(layout::bind_group_layout());
    descriptor.layout.extend(properties.material_layout.clone());
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
        // Tangents if a material needs them, as meshes have them.
        if ["NORMAL_MAP", "CLEARCOAT_NORMAL_MAP", "ANISOTROPY"].into_iter().any(|name| {
            let name = format!("STANDARD_MATERIAL_{name}");
            fragment.shader_defs.contains(&name.into())
        }) {
            fragment.shader_defs.push("VERTEX_TANGENTS".into());
        }
    }
    if kind.wireframe {
        descriptor.primitive.polygon_mode = PolygonMode::Line;
        descriptor.primitive.cull_mode = None;
    }
    descriptor
}

/// Bevy's pipeline for a mesh of a material. If the device cannot draw vertices in front of the
/// near plane, the vertex shader moves them onto it.
fn of_a_mesh(
    own: &Own<'_>,
    kind: &Kind,
    properties: &Arc<MaterialProperties>,
) -> RenderPipelineDescriptor {
    let mut key: MeshPipelineKey = kind.key.mesh_key.downcast();
    key |= MeshPipelineKey::from_primitive_topology_and_strip_index(
        PrimitiveTopology::TriangleList,
        None,
    );
    let unclipped = MeshPipelineKey::UNCLIPPED_DEPTH_ORTHO;
    let clamps = key.contains(unclipped) && !own.prepass.depth_clip_control_supported;
    key.set(unclipped, key.contains(unclipped) && !clamps);
    let layout = layout_of_a_mesh();
    let erased =
        ErasedMaterialPipelineKey { mesh_key: ErasedMeshPipelineKey::new(key), ..kind.key.clone() };
    let specialized = if kind.is_prepass {
        let (pipeline, properties) = (own.prepass.clone(), Arc::clone(properties));
        PrepassPipelineSpecializer { pipeline, properties }.specialize(erased, &layout)
    } else {
        lit(own, key, erased, &layout, properties)
    };
    let mut descriptor = specialized.expect("the mesh has the attributes that Bevy asks for");
    descriptor.vertex.constants = vec![("tess_clamps".into(), f64::from(clamps))];
    descriptor
}

/// Bevy's pipeline for the main pass, as from its `MaterialPipelineSpecializer`, which other crates
/// cannot make.
fn lit(
    own: &Own<'_>,
    key: MeshPipelineKey,
    erased: ErasedMaterialPipelineKey,
    layout: &MeshVertexBufferLayoutRef,
    properties: &MaterialProperties,
) -> Result<RenderPipelineDescriptor, SpecializedMeshPipelineError> {
    let mut descriptor = own.mesh.specialize(key, layout)?;
    let group = ShaderDefVal::UInt("MATERIAL_BIND_GROUP".into(), MATERIAL_BIND_GROUP_INDEX as u32);
    let bindless = properties.bindless.then(|| "BINDLESS".into());
    let fragment = descriptor.fragment.iter_mut();
    fragment
        .for_each(|f| f.shader_defs.extend(bindless.clone().into_iter().chain([group.clone()])));
    if let Some(specialize) = properties.user_specialize {
        let pipeline = MaterialPipeline { mesh_pipeline: own.mesh.clone() };
        specialize(&pipeline, &mut descriptor, layout, erased)?;
    }
    Ok(descriptor)
}

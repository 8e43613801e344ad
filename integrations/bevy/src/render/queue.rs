//! Phase items and pipelines.

use super::draw::DrawTessellated;
use super::extract::Extracted;
use super::layout;
use crate::component::Tessellated;
use crate::setup::{DRAW_GROUP, Setup};
use bevy::asset::AssetId;
use bevy::core_pipeline::core_3d::{Opaque3d, Opaque3dBatchSetKey, Opaque3dBinKey};
use bevy::ecs::prelude::*;
use bevy::log::error_once;
use bevy::mesh::{Mesh, MeshVertexBufferLayoutRef, MeshVertexBufferLayouts, VertexBufferLayout};
use bevy::pbr::{MeshPipeline, MeshPipelineKey, ViewKeyCache};
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::mesh::allocator::MeshSlabs;
use bevy::render::render_phase::{
    BinnedRenderPhaseType, DrawFunctions, InputUniformIndex, ViewBinnedRenderPhases,
};
use bevy::render::render_resource::{
    CachedRenderPipelineId, PipelineCache, PolygonMode, PrimitiveTopology,
    RenderPipelineDescriptor, SpecializedMeshPipeline, VertexAttribute, VertexFormat,
    VertexStepMode, WgpuFeatures,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RenderVisibleEntities, RetainedViewEntity};

/// The pipelines of setups, for what cameras need of them.
#[derive(Debug, Default, Resource)]
pub(crate) struct Pipelines {
    /// By the setup's number, what the camera needs, and whether as a wireframe.
    all: HashMap<(usize, MeshPipelineKey, bool), CachedRenderPipelineId>,
    /// The keys of this frame's cameras.
    views: HashMap<RetainedViewEntity, (MeshPipelineKey, bool)>,
}

impl Pipelines {
    /// The pipeline of a setup for a camera.
    pub(crate) fn of(
        &self,
        setup: usize,
        view: RetainedViewEntity,
    ) -> Option<CachedRenderPipelineId> {
        let &(mesh_key, wireframe) = self.views.get(&view)?;
        self.all.get(&(setup, mesh_key, wireframe)).copied()
    }
}

/// Puts what cameras see into their opaque phases, and asks for the pipelines.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are what it uses")]
pub(crate) fn queue(
    extracted: Res<Extracted>,
    mut pipelines: ResMut<Pipelines>,
    device: Res<RenderDevice>,
    cache: Res<PipelineCache>,
    mesh_pipeline: Res<MeshPipeline>,
    keys: Res<ViewKeyCache>,
    draw_functions: Res<DrawFunctions<Opaque3d>>,
    mut phases: ResMut<ViewBinnedRenderPhases<Opaque3d>>,
    views: Query<(&ExtractedView, &RenderVisibleEntities)>,
    mut queued: Local<HashMap<RetainedViewEntity, HashSet<MainEntity>>>,
) {
    let draw_function = draw_functions.read().id::<DrawTessellated>();
    let known: HashSet<MainEntity> = extracted.items.iter().map(|item| item.entity).collect();
    let can_wireframe = device.features().contains(WgpuFeatures::POLYGON_MODE_LINE);
    if extracted.wireframe && !can_wireframe {
        error_once!("the device has no POLYGON_MODE_LINE, so surfaces are not drawn as wireframes");
    }
    let wireframe = extracted.wireframe && can_wireframe;
    pipelines.views.clear();
    for (view, visible) in &views {
        let of = view.retained_view_entity;
        let (Some(phase), Some(&key)) = (phases.get_mut(&of), keys.get(&of)) else { continue };
        let queued = queued.entry(of).or_default();
        for entity in queued.drain() {
            phase.remove(entity);
        }
        pipelines.views.insert(of, (key, wireframe));
        for item in &extracted.items {
            let own = (item.setup.number, key, wireframe);
            pipelines.all.entry(own).or_insert_with(|| {
                let descriptor = descriptor(&mesh_pipeline, &item.setup, key, wireframe);
                cache.queue_render_pipeline(descriptor)
            });
        }
        let Some(visible) = visible.get::<Tessellated>() else { continue };
        for &(render_entity, entity) in &visible.entities_cpu_culling {
            if !known.contains(&entity) {
                continue;
            }
            queued.insert(entity);
            phase.add(
                batch_set_key(draw_function),
                Opaque3dBinKey { asset_id: AssetId::<Mesh>::default().untyped() },
                (render_entity, entity),
                InputUniformIndex::default(),
                BinnedRenderPhaseType::NonMesh,
            );
        }
    }
}

/// The pipeline is found when the item is drawn.
fn batch_set_key(draw_function: bevy::render::render_phase::DrawFunctionId) -> Opaque3dBatchSetKey {
    Opaque3dBatchSetKey {
        draw_function,
        pipeline: CachedRenderPipelineId::INVALID,
        material_bind_group_index: None,
        lightmap_slab: None,
        slabs: MeshSlabs::default(),
    }
}

/// A mesh with the attributes that a fallback has, for whose layout Bevy states what a camera needs.
fn layout_of_a_mesh() -> MeshVertexBufferLayoutRef {
    crate::cpu::mesh(Default::default(), PrimitiveTopology::TriangleList)
        .get_mesh_vertex_buffer_layout(&mut MeshVertexBufferLayouts::default())
}

/// Bevy's pipeline for meshes, with the setup's shaders and bind group in place of those for meshes.
fn descriptor(
    mesh_pipeline: &MeshPipeline,
    setup: &Setup,
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
    descriptor.vertex.shader = setup.vertex.clone();
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
        fragment.shader = setup.fragment.clone();
        fragment.entry_point = None;
    }
    if wireframe {
        descriptor.primitive.polygon_mode = PolygonMode::Line;
        descriptor.primitive.cull_mode = None;
    }
    descriptor
}

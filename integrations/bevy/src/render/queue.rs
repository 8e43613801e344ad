//! The phase items of a frame, and requests for their pipelines.

use super::draw::DrawTessellated;
use super::extract::Extracted;
use super::pipelines::Pipelines;
use crate::component::Tessellated;
use bevy::asset::AssetId;
use bevy::core_pipeline::core_3d::{Opaque3d, Opaque3dBatchSetKey, Opaque3dBinKey};
use bevy::ecs::prelude::*;
use bevy::log::error_once;
use bevy::mesh::Mesh;
use bevy::pbr::{MeshPipeline, ViewKeyCache};
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::mesh::allocator::MeshSlabs;
use bevy::render::render_phase::{
    BinnedRenderPhaseType, DrawFunctions, InputUniformIndex, ViewBinnedRenderPhases,
};
use bevy::render::render_resource::{CachedRenderPipelineId, PipelineCache, WgpuFeatures};
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RenderVisibleEntities, RetainedViewEntity};

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
    pipelines.begin();
    for (view, visible) in &views {
        let of = view.retained_view_entity;
        let (Some(phase), Some(&key)) = (phases.get_mut(&of), keys.get(&of)) else { continue };
        let queued = queued.entry(of).or_default();
        for entity in queued.drain() {
            phase.remove(entity);
        }
        let programs = extracted.items.iter().map(|item| &*item.program);
        pipelines.request(of, (key, wireframe), programs, (&*mesh_pipeline, &*cache));
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

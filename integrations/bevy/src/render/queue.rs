//! The phase items of a frame, with their pipelines.

use super::draw::{DrawDepth, DrawLit};
use super::extract::{Extracted, Item};
use super::pipelines::{Kind, Own, Pipelines};
use bevy::asset::AssetId;
use bevy::core_pipeline::core_3d::{Opaque3d, Opaque3dBatchSetKey, Opaque3dBinKey};
use bevy::core_pipeline::prepass::{
    Opaque3dPrepass, OpaqueNoLightmap3dBatchSetKey, OpaqueNoLightmap3dBinKey,
};
use bevy::ecs::prelude::*;
use bevy::ecs::system::SystemParam;
use bevy::log::error_once;
use bevy::mesh::{Mesh, Mesh3d};
use bevy::pbr::{
    LightKeyCache, MeshPipelineKey, Shadow, ShadowBatchSetKey, ShadowBinKey, ViewKeyCache,
    ViewKeyPrepassCache,
};
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::mesh::allocator::MeshSlabs;
use bevy::render::render_phase::{
    BinnedPhaseItem, BinnedRenderPhaseType, DrawFunctionId, DrawFunctions, InputUniformIndex,
    ViewBinnedRenderPhases,
};
use bevy::render::render_resource::{CachedRenderPipelineId, WgpuFeatures};
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{
    ExtractedView, RenderShadowMapVisibleEntities, RenderVisibleEntities, RetainedViewEntity,
};
use std::ops::Deref;

/// What cameras and shadow maps see, by Bevy's culling.
#[derive(SystemParam)]
pub(crate) struct Seen<'w, 's> {
    cameras: Query<'w, 's, (&'static ExtractedView, &'static RenderVisibleEntities)>,
    lights: Query<'w, 's, &'static RenderShadowMapVisibleEntities>,
}

impl Seen<'_, '_> {
    /// The entities of each camera.
    fn cameras(&self) -> impl Iterator<Item = (RetainedViewEntity, &[(Entity, MainEntity)])> {
        self.cameras.iter().map(|(view, all)| (view.retained_view_entity, meshes(all)))
    }

    /// The entities of each shadow map.
    fn maps(&self) -> impl Iterator<Item = (RetainedViewEntity, &[(Entity, MainEntity)])> {
        let maps = self.lights.iter().flat_map(|light| &light.subviews);
        maps.map(|(&view, (_, all))| (view, meshes(all)))
    }

    /// The entities that a camera or a shadow map of its picture sees.
    pub(crate) fn by(&self, camera: RetainedViewEntity) -> HashSet<MainEntity> {
        let is_its_own = |of: MainEntity| of == camera.main_entity;
        let maps = self.maps().filter(|(map, _)| map.auxiliary_entity.is_none_or(is_its_own));
        let own = self.cameras().filter(|&(view, _)| view == camera);
        own.chain(maps).flat_map(|(_, all)| all).map(|&(_, entity)| entity).collect()
    }
}

fn meshes(all: &RenderVisibleEntities) -> &[(Entity, MainEntity)] {
    all.get::<Mesh3d>().map_or(&[], |class| &class.entities_cpu_culling)
}

/// A phase of Bevy's that surfaces are in.
pub(crate) trait Phase: BinnedPhaseItem {
    /// Bevy's keys of the pipelines, by the camera or the shadow map.
    type Keys: Resource + Deref<Target = HashMap<RetainedViewEntity, MeshPipelineKey>>;
    /// The command.
    type Draw: 'static;
    const IS_PREPASS: bool;

    fn keys(
        pipeline: CachedRenderPipelineId,
        draw_function: DrawFunctionId,
    ) -> (Self::BatchSetKey, Self::BinKey);
}

macro_rules! phase {
    ($item:ident, $keys:ident, $draw:ident, $is_prepass:literal, $set:ident { $($more:tt)* }, $bin:ident) => {
        impl Phase for $item {
            type Keys = $keys;
            type Draw = $draw;
            const IS_PREPASS: bool = $is_prepass;

            fn keys(
                pipeline: CachedRenderPipelineId,
                draw_function: DrawFunctionId,
            ) -> ($set, $bin) {
                let (slabs, material_bind_group_index) = (MeshSlabs::default(), None);
                let asset_id = AssetId::<Mesh>::default().untyped();
                ($set { pipeline, draw_function, material_bind_group_index, slabs, $($more)* }, $bin { asset_id })
            }
        }
    };
}
phase!(
    Opaque3d,
    ViewKeyCache,
    DrawLit,
    false,
    Opaque3dBatchSetKey { lightmap_slab: None },
    Opaque3dBinKey
);
phase!(
    Opaque3dPrepass,
    ViewKeyPrepassCache,
    DrawDepth,
    true,
    OpaqueNoLightmap3dBatchSetKey {},
    OpaqueNoLightmap3dBinKey
);
phase!(Shadow, LightKeyCache, DrawDepth, true, ShadowBatchSetKey {}, ShadowBinKey);

/// Puts what cameras or shadow maps see into their phases.
pub(crate) fn queue<P: Phase>(
    extracted: Res<Extracted>,
    (mut pipelines, own, device): (ResMut<Pipelines>, Own<'_>, Res<RenderDevice>),
    keys: Res<P::Keys>,
    draw_functions: Res<DrawFunctions<P>>,
    mut phases: ResMut<ViewBinnedRenderPhases<P>>,
    seen: Seen<'_, '_>,
    mut queued: Local<HashMap<RetainedViewEntity, HashSet<MainEntity>>>,
) {
    let draw_function = draw_functions.read().id::<P::Draw>();
    let known: HashMap<MainEntity, &Item> =
        extracted.items.iter().map(|item| (item.entity, item)).collect();
    let can_wireframe = device.features().contains(WgpuFeatures::POLYGON_MODE_LINE);
    if extracted.wireframe && !can_wireframe {
        error_once!("the device has no POLYGON_MODE_LINE, so surfaces are not drawn as wireframes");
    }
    let wireframe = extracted.wireframe && can_wireframe;
    queued.retain(|view, _| phases.contains_key(view));
    for (view, all) in seen.cameras().chain(seen.maps()) {
        let (Some(phase), Some(&key)) = (phases.get_mut(&view), keys.get(&view)) else { continue };
        let queued = queued.entry(view).or_default();
        for entity in queued.drain() {
            phase.remove(entity);
        }
        let kind = Kind { key, is_prepass: P::IS_PREPASS, wireframe };
        for &entities in all {
            let entity = entities.1;
            let Some(item) = known.get(&entity) else { continue };
            let pipeline = pipelines.get(&item.program, kind, &own);
            let (set_key, bin_key) = P::keys(pipeline, draw_function);
            let (index, kind) = (InputUniformIndex::default(), BinnedRenderPhaseType::NonMesh);
            phase.add(set_key, bin_key, entities, index, kind);
            queued.insert(entity);
        }
    }
}

//! The phase items of a frame, with their pipelines.

use super::draw::{DrawDepth, DrawLit};
use super::extract::{Extracted, Item};
use super::materials::{Material, Pass};
use super::pipelines::{Kind, Own, Pipelines};
use super::seen::Seen;
use bevy::asset::AssetId;
use bevy::core_pipeline::core_3d::{
    AlphaMask3d, Opaque3d, Opaque3dBatchSetKey, Opaque3dBinKey, Transparent3d,
    TransparentSortingInfo3d,
};
use bevy::core_pipeline::prepass::{
    AlphaMask3dPrepass, Opaque3dPrepass, OpaqueNoLightmap3dBatchSetKey, OpaqueNoLightmap3dBinKey,
};
use bevy::ecs::component::Mutable;
use bevy::ecs::prelude::*;
use bevy::log::error_once;
use bevy::material::AlphaMode;
use bevy::mesh::Mesh;
use bevy::pbr::{
    LightKeyCache, MeshPipelineKey, Shadow, ShadowBatchSetKey, ShadowBinKey, ViewKeyCache,
    ViewKeyPrepassCache, alpha_mode_pipeline_key,
};
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::mesh::allocator::MeshSlabs;
use bevy::render::render_phase::{
    BinnedRenderPhase, BinnedRenderPhaseType, DrawFunctionId, DrawFunctions, InputUniformIndex,
    PhaseItem, PhaseItemExtraIndex, SortedRenderPhase, ViewBinnedRenderPhases,
    ViewSortedRenderPhases,
};
use bevy::render::render_resource::{CachedRenderPipelineId, WgpuFeatures};
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{Msaa, RetainedViewEntity};
use std::ops::{Deref, DerefMut};

/// A phase of Bevy's in which surfaces are drawn.
pub(crate) trait Phase: PhaseItem {
    /// Bevy's keys of the pipelines, by the camera or the shadow map.
    type Keys: Resource + Deref<Target = HashMap<RetainedViewEntity, MeshPipelineKey>>;
    /// The phases of all cameras or shadow maps.
    type Phases: Resource<Mutability = Mutable>
        + DerefMut<Target = HashMap<RetainedViewEntity, Self::Phase>>;
    type Phase;
    /// The command that draws an item.
    type Draw: 'static;
    const IS_PREPASS: bool;
    /// The materials that the phase takes; all if `None`.
    const TAKES: Option<Pass>;

    /// The part of the key that the alpha mode adds.
    fn alpha_key(mode: AlphaMode, key: MeshPipelineKey) -> MeshPipelineKey {
        alpha_mode_pipeline_key(mode, &Msaa::from_samples(key.msaa_samples()))
    }

    fn add(
        phase: &mut Self::Phase,
        item: &Item,
        material: &Material,
        pipeline: CachedRenderPipelineId,
        draw_function: DrawFunctionId,
    );

    fn remove(phase: &mut Self::Phase, entity: MainEntity);
}

macro_rules! binned {
    (
        $item:ident, $keys:ident, $draw:ident, $is_prepass:literal, $takes:expr,
        $set:ident { $($more:tt)* }, $bin:ident $(, $alpha:item)?
    ) => {
        impl Phase for $item {
            type Keys = $keys;
            type Phases = ViewBinnedRenderPhases<Self>;
            type Phase = BinnedRenderPhase<Self>;
            type Draw = $draw;
            const IS_PREPASS: bool = $is_prepass;
            const TAKES: Option<Pass> = $takes;
            $($alpha)?

            fn add(
                phase: &mut Self::Phase,
                item: &Item,
                _: &Material,
                pipeline: CachedRenderPipelineId,
                draw_function: DrawFunctionId,
            ) {
                let (slabs, material_bind_group_index) = (MeshSlabs::default(), None);
                let asset_id = AssetId::<Mesh>::default().untyped();
                let set = $set {
                    pipeline,
                    draw_function,
                    material_bind_group_index,
                    slabs,
                    $($more)*
                };
                let entities = (Entity::PLACEHOLDER, item.entity);
                let (index, kind) = (InputUniformIndex::default(), BinnedRenderPhaseType::NonMesh);
                phase.add(set, $bin { asset_id }, entities, index, kind);
            }

            fn remove(phase: &mut Self::Phase, entity: MainEntity) {
                phase.remove(entity);
            }
        }
    };
}
binned!(
    Opaque3d,
    ViewKeyCache,
    DrawLit,
    false,
    Some(Pass::Opaque),
    Opaque3dBatchSetKey { lightmap_slab: None },
    Opaque3dBinKey
);
binned!(
    AlphaMask3d,
    ViewKeyCache,
    DrawLit,
    false,
    Some(Pass::Mask),
    OpaqueNoLightmap3dBatchSetKey {},
    OpaqueNoLightmap3dBinKey
);
binned!(
    Opaque3dPrepass,
    ViewKeyPrepassCache,
    DrawDepth,
    true,
    Some(Pass::Opaque),
    OpaqueNoLightmap3dBatchSetKey {},
    OpaqueNoLightmap3dBinKey
);
binned!(
    AlphaMask3dPrepass,
    ViewKeyPrepassCache,
    DrawDepth,
    true,
    Some(Pass::Mask),
    OpaqueNoLightmap3dBatchSetKey {},
    OpaqueNoLightmap3dBinKey
);
binned!(
    Shadow,
    LightKeyCache,
    DrawDepth,
    true,
    None,
    ShadowBatchSetKey {},
    ShadowBinKey,
    fn alpha_key(mode: AlphaMode, _: MeshPipelineKey) -> MeshPipelineKey {
        match mode {
            AlphaMode::Opaque | AlphaMode::Multiply => MeshPipelineKey::NONE,
            _ => MeshPipelineKey::MAY_DISCARD,
        }
    }
);

impl Phase for Transparent3d {
    type Keys = ViewKeyCache;
    type Phases = ViewSortedRenderPhases<Self>;
    type Phase = SortedRenderPhase<Self>;
    type Draw = DrawLit;
    const IS_PREPASS: bool = false;
    const TAKES: Option<Pass> = Some(Pass::Blend);

    fn add(
        phase: &mut Self::Phase,
        item: &Item,
        material: &Material,
        pipeline: CachedRenderPipelineId,
        draw_function: DrawFunctionId,
    ) {
        let center = item.shape.bounds().center.into();
        phase.add_retained(Self {
            sorting_info: TransparentSortingInfo3d::Sorted {
                mesh_center: item.world_from_local.transform_point3(center),
                depth_bias: material.properties.depth_bias,
            },
            distance: 0.0,
            pipeline,
            entity: (Entity::PLACEHOLDER, item.entity),
            draw_function,
            batch_range: 0..1,
            extra_index: PhaseItemExtraIndex::None,
            indexed: true,
        });
    }

    fn remove(phase: &mut Self::Phase, entity: MainEntity) {
        phase.remove(Entity::PLACEHOLDER, entity);
    }
}

/// Puts the surfaces that cameras or shadow maps see into their phases.
pub(crate) fn queue<P: Phase>(
    extracted: Res<Extracted>,
    (mut pipelines, own, device): (ResMut<Pipelines>, Own<'_>, Res<RenderDevice>),
    keys: Res<P::Keys>,
    draw_functions: Res<DrawFunctions<P>>,
    mut phases: ResMut<P::Phases>,
    seen: Seen<'_, '_>,
    mut queued: Local<HashMap<RetainedViewEntity, HashSet<MainEntity>>>,
) {
    let draw_function = draw_functions.read().id::<P::Draw>();
    let takes = |material: &&Material| P::TAKES.is_none_or(|pass| pass == material.pass());
    let known: HashMap<MainEntity, (&Item, &Material)> = extracted
        .items
        .iter()
        .filter_map(|item| Some((item.entity, (item, item.material.as_ref().filter(takes)?))))
        .collect();
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
            P::remove(phase, entity);
        }
        for (_, entity) in all {
            let Some(&(item, material)) = known.get(entity) else { continue };
            let alpha_key = P::alpha_key(material.properties.alpha_mode, key);
            let key = material.key(key | alpha_key);
            let kind = Kind { key, is_prepass: P::IS_PREPASS, wireframe };
            let pipeline = pipelines.get(&item.program, kind, &material.properties, &own);
            P::add(phase, item, material, pipeline, draw_function);
            queued.insert(*entity);
        }
    }
}

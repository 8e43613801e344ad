//! The entities that are drawn, by camera and by shadow map.

use bevy::ecs::prelude::*;
use bevy::ecs::system::SystemParam;
use bevy::mesh::Mesh3d;
use bevy::platform::collections::HashSet;
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{
    ExtractedView, RenderShadowMapVisibleEntities, RenderVisibleEntities, RetainedViewEntity,
};

/// The entities that cameras and shadow maps see, by Bevy's culling.
#[derive(SystemParam)]
pub(crate) struct Seen<'w, 's> {
    cameras: Query<'w, 's, (&'static ExtractedView, &'static RenderVisibleEntities)>,
    lights: Query<'w, 's, &'static RenderShadowMapVisibleEntities>,
}

impl Seen<'_, '_> {
    /// The entities of each camera.
    pub(crate) fn cameras(
        &self,
    ) -> impl Iterator<Item = (RetainedViewEntity, &[(Entity, MainEntity)])> {
        self.cameras.iter().map(|(view, all)| (view.retained_view_entity, meshes(all)))
    }

    /// The entities of each shadow map.
    pub(crate) fn maps(
        &self,
    ) -> impl Iterator<Item = (RetainedViewEntity, &[(Entity, MainEntity)])> {
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

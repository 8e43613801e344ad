//! The render world's copy of a frame's surfaces.

use crate::component::{TessSettings, Tessellated};
use crate::detail::LevelOfDetail;
use crate::is_on_cpu;
use crate::look::Look;
use crate::program::{Program, Programs};
use crate::shape::Shape;
use bevy::asset::AssetServer;
use bevy::ecs::prelude::*;
use bevy::math::Affine3A;
use bevy::render::Extract;
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::MainEntity;
use bevy::transform::components::GlobalTransform;
use std::sync::Arc;

/// A surface of the frame.
#[derive(Debug)]
pub(crate) struct Item {
    pub(crate) entity: MainEntity,
    pub(crate) program: Arc<Program>,
    pub(crate) shape: Arc<dyn Shape>,
    pub(crate) rule: LevelOfDetail,
    pub(crate) look: Look,
    pub(crate) world_from_local: Affine3A,
}

/// The surfaces of the frame, if the GPU tessellates them.
#[derive(Debug, Default, Resource)]
pub(crate) struct Extracted {
    pub(crate) items: Vec<Item>,
    pub(crate) is_on_gpu: bool,
    pub(crate) wireframe: bool,
}

pub(crate) fn extract(
    mut extracted: ResMut<Extracted>,
    device: Res<RenderDevice>,
    settings: Extract<Res<TessSettings>>,
    programs: Extract<Res<Programs>>,
    assets: Extract<Res<AssetServer>>,
    surfaces: Extract<Query<(Entity, &Tessellated, &GlobalTransform)>>,
) {
    extracted.items.clear();
    extracted.wireframe = settings.wireframe;
    extracted.is_on_gpu = !is_on_cpu(&settings, Some(&device));
    if !extracted.is_on_gpu || !programs.are_ready(&assets) {
        return;
    }
    let item = |(entity, tessellated, transform): (Entity, &Tessellated, &GlobalTransform)| {
        Some(Item {
            entity: entity.into(),
            program: Arc::clone(programs.of(entity)?),
            shape: Arc::clone(&tessellated.shape),
            rule: tessellated.detail,
            look: tessellated.look,
            world_from_local: transform.affine(),
        })
    };
    extracted.items.extend(surfaces.iter().filter_map(item));
    extracted.items.sort_unstable_by_key(|item| item.entity);
}

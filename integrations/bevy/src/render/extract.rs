//! The render world's copy of a frame's surfaces.

use super::materials::Material;
use crate::component::{TessSettings, TessValues, Tessellated};
use crate::detail::LevelOfDetail;
use crate::eye::Casting;
use crate::is_on_cpu;
use crate::program::{Program, Programs};
use crate::shape::Shape;
use bevy::asset::{AssetServer, Assets};
use bevy::ecs::prelude::*;
use bevy::light::NotShadowReceiver;
use bevy::math::Affine3A;
use bevy::pbr::{PreparedMaterial, PreviousGlobalTransform, RenderMaterialInstances};
use bevy::render::Extract;
use bevy::render::erased_render_asset::ErasedRenderAssets;
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::MainEntity;
use bevy::shader::Shader;
use bevy::transform::components::GlobalTransform;
use std::sync::Arc;

/// A surface of the frame.
#[derive(Debug)]
pub(crate) struct Item {
    pub(crate) entity: MainEntity,
    pub(crate) program: Arc<Program>,
    pub(crate) shape: Arc<dyn Shape>,
    pub(crate) rule: LevelOfDetail,
    pub(crate) material: Option<Material>,
    pub(crate) values: Vec<f32>,
    pub(crate) world_from_local: Affine3A,
    pub(crate) previous_from_world: Affine3A,
    pub(crate) receives_shadows: bool,
}

/// The surfaces of the frame, if the GPU tessellates them.
#[derive(Debug, Default, Resource)]
pub(crate) struct Extracted {
    pub(crate) items: Vec<Item>,
    pub(crate) casting: Casting,
    pub(crate) is_on_gpu: bool,
    pub(crate) wireframe: bool,
    /// Whether the shaders' imports have been loaded.
    are_ready: bool,
}

type ExtractedSurface<'a> = (
    Entity,
    &'a Tessellated,
    &'a GlobalTransform,
    Option<&'a PreviousGlobalTransform>,
    Option<&'a TessValues>,
    Has<NotShadowReceiver>,
);

pub(crate) fn extract(
    mut extracted: ResMut<Extracted>,
    device: Res<RenderDevice>,
    settings: Extract<Res<TessSettings>>,
    casting: Extract<Res<Casting>>,
    programs: Extract<Res<Programs>>,
    assets: Extract<(Res<AssetServer>, Res<Assets<Shader>>)>,
    surfaces: Extract<Query<ExtractedSurface<'_>>>,
) {
    extracted.items.clear();
    extracted.wireframe = settings.wireframe;
    extracted.casting.clone_from(&casting);
    extracted.is_on_gpu = !is_on_cpu(&settings, Some(&device));
    let (server, shaders) = &*assets;
    extracted.are_ready = extracted.are_ready || programs.are_ready(server, shaders);
    if !extracted.is_on_gpu || !extracted.are_ready {
        return;
    }
    extracted.items.extend(surfaces.iter().filter_map(|surface| {
        let (entity, tessellated, transform, previous, values, not_receiver) = surface;
        let world_from_local = transform.affine();
        let previous = previous.map_or(world_from_local, |previous| previous.0);
        Some(Item {
            entity: entity.into(),
            program: Arc::clone(programs.of(entity)?),
            shape: Arc::clone(&tessellated.shape),
            rule: tessellated.detail,
            material: None,
            values: values.map_or_else(Vec::new, |values| values.0.clone()),
            world_from_local,
            previous_from_world: previous * world_from_local.inverse(),
            receives_shadows: !not_receiver,
        })
    }));
    extracted.items.sort_unstable_by_key(|item| item.entity);
}

/// Finds the materials of the frame's surfaces. A surface without one is not drawn.
pub(crate) fn find_materials(
    mut extracted: ResMut<Extracted>,
    instances: Res<RenderMaterialInstances>,
    prepared: Res<ErasedRenderAssets<PreparedMaterial>>,
) {
    for item in &mut extracted.items {
        item.material = Material::of(item.entity, &instances, &prepared);
    }
}

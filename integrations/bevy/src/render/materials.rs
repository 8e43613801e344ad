//! The materials of surfaces, which Bevy prepares.

use bevy::material::key::{ErasedMaterialPipelineKey, ErasedMeshPipelineKey};
use bevy::material::{AlphaMode, MaterialProperties};
use bevy::pbr::{MeshPipelineKey, PreparedMaterial, RenderMaterialInstances};
use bevy::render::erased_render_asset::ErasedRenderAssets;
use bevy::render::sync_world::MainEntity;
use std::any::TypeId;
use std::fmt;
use std::sync::Arc;

/// A material as Bevy has prepared it.
#[derive(Clone)]
pub(crate) struct Material {
    pub(crate) properties: Arc<MaterialProperties>,
    /// Its place in its bind group.
    pub(crate) slot: u32,
    type_id: TypeId,
}

/// The pass that draws a material, as Bevy chooses it, but without transmission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    Opaque,
    Mask,
    /// From back to front.
    Blend,
}

impl fmt::Debug for Material {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Material").field("slot", &self.slot).finish_non_exhaustive()
    }
}

impl Material {
    /// The material of an entity; `None` while Bevy loads it, or if the entity is hidden.
    pub(crate) fn of(
        entity: MainEntity,
        instances: &RenderMaterialInstances,
        prepared: &ErasedRenderAssets<PreparedMaterial>,
    ) -> Option<Self> {
        let asset = instances.instances.get(&entity)?.asset_id;
        let PreparedMaterial { binding, properties } = prepared.get(asset)?;
        let (properties, slot) = (Arc::clone(properties), binding.slot.into());
        Some(Self { properties, slot, type_id: asset.type_id() })
    }

    pub(crate) fn pass(&self) -> Pass {
        match self.properties.alpha_mode {
            AlphaMode::Opaque | AlphaMode::AlphaToCoverage => Pass::Opaque,
            AlphaMode::Mask(_) => Pass::Mask,
            _ => Pass::Blend,
        }
    }

    /// The key that pipelines depend on.
    pub(crate) fn key(&self, mesh: MeshPipelineKey) -> ErasedMaterialPipelineKey {
        ErasedMaterialPipelineKey {
            mesh_key: ErasedMeshPipelineKey::new(mesh),
            material_key: self.properties.material_key.clone(),
            type_id: self.type_id,
        }
    }
}

#![doc = include_str!("../README.md")]

// The tests run an example.
#[cfg(test)]
extern crate self as bevy_tess;

mod bezier;
mod component;
mod cpu;
mod detail;
mod eye;
mod height_field;
mod images;
#[cfg(feature = "picking")]
mod picking;
mod point_normal;
mod program;
mod render;
mod shape;

pub use bezier::{BezierError, BezierPatches, Net, quad_factors};
pub use component::{TessBackend, TessSettings, TessStats, TessValues, Tessellated};
pub use detail::LevelOfDetail;
pub use eye::Eye;
pub use height_field::{GroundColors, HeightField, HeightFieldError};
pub use point_normal::{PointNormalError, PointNormalMesh};
pub use shape::{CpuShape, DEFAULT_FRAGMENT, Shape, ShapeVertex};
pub use tess_core;
pub use tess_surface;

#[cfg(feature = "picking")]
use bevy::app::PreUpdate;
use bevy::app::{App, Plugin, PostUpdate};
use bevy::asset::{AssetEventSystems, Assets};
use bevy::camera::primitives::Aabb;
use bevy::camera::visibility::VisibilitySystems;
use bevy::ecs::prelude::*;
use bevy::pbr::StandardMaterial;
#[cfg(feature = "picking")]
use bevy::picking::{PickingSystems, backend::ray::RayMap};
use bevy::render::renderer::RenderDevice;
use bevy::transform::TransformSystems;
use component::TessBackend as Chosen;
use eye::Casting;

/// Draws every entity with a [`Tessellated`] for every 3D camera, and into the shadow maps of every
/// light.
#[derive(Clone, Copy, Debug, Default)]
pub struct TessPlugin;

impl Plugin for TessPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<TessSettings>().init_resource::<TessStats>();
        let mut materials = app.world_mut().resource_mut::<Assets<StandardMaterial>>();
        materials.insert(&component::PLAIN, StandardMaterial::default()).expect("no generation");
        app.add_systems(
            PostUpdate,
            (
                images::follow.before(set_bounds).before(program::register),
                set_bounds.before(VisibilitySystems::CalculateBounds),
                program::register.before(VisibilitySystems::CalculateBounds),
                (eye::find_casting, cpu::tessellate)
                    .chain()
                    .after(TransformSystems::Propagate)
                    .before(AssetEventSystems),
            ),
        );
        app.init_resource::<Casting>()
            .init_resource::<program::Programs>()
            .init_resource::<cpu::Tessellators>();
        #[cfg(feature = "picking")]
        app.add_systems(
            PreUpdate,
            picking::pick.in_set(PickingSystems::Backend).run_if(resource_exists::<RayMap>),
        );
        render::build(app);
    }
}

/// Gives new surfaces the boxes by which Bevy culls them.
fn set_bounds(mut commands: Commands, new: Query<(Entity, &Tessellated), Changed<Tessellated>>) {
    for (entity, tessellated) in &new {
        let bounds: Aabb = tessellated.shape.bounds();
        commands.entity(entity).insert(bounds);
    }
}

/// Whether the CPU tessellates, because the user wants it or the device cannot run the compute
/// shaders.
pub(crate) fn is_on_cpu(settings: &TessSettings, device: Option<&RenderDevice>) -> bool {
    let Some(device) = device else { return true };
    let limits = device.limits();
    let can_compute = limits.max_compute_workgroups_per_dimension > 0
        && limits.max_storage_buffers_per_shader_stage >= 8;
    settings.backend == Chosen::Cpu || !can_compute
}

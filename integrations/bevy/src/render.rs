//! The plugin's part in the render world: extraction, one stage for each camera and program, draws.

mod content;
mod draw;
mod extract;
mod layout;
mod materials;
mod mirror;
mod pipelines;
mod places;
mod queue;
mod seen;
mod stages;
#[cfg(test)]
mod tests;

use crate::component::TessStats;
use bevy::app::App;
use bevy::core_pipeline::core_3d::{AlphaMask3d, Opaque3d, Transparent3d};
use bevy::core_pipeline::prepass::{AlphaMask3dPrepass, Opaque3dPrepass};
use bevy::ecs::prelude::*;
use bevy::pbr::Shadow;
use bevy::render::render_phase::AddRenderCommand;
use bevy::render::renderer::{RenderGraph, RenderGraphSystems};
use bevy::render::{ExtractSchedule, GpuResourceAppExt, Render, RenderApp, RenderSystems};

pub(crate) fn build(app: &mut App) {
    let stats = app.world().resource::<TessStats>().clone();
    let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
    render_app
        .insert_resource(stats)
        .init_resource::<extract::Extracted>()
        .init_gpu_resource::<pipelines::Pipelines>()
        .init_gpu_resource::<stages::Stages>()
        .add_render_command::<Opaque3d, draw::DrawLit>()
        .add_render_command::<AlphaMask3d, draw::DrawLit>()
        .add_render_command::<Transparent3d, draw::DrawLit>()
        .add_render_command::<Opaque3dPrepass, draw::DrawDepth>()
        .add_render_command::<AlphaMask3dPrepass, draw::DrawDepth>()
        .add_render_command::<Shadow, draw::DrawDepth>()
        .add_systems(ExtractSchedule, extract::extract)
        .add_systems(Render, extract::find_materials.in_set(RenderSystems::Specialize))
        .add_systems(
            Render,
            (
                queue::queue::<Opaque3d>,
                queue::queue::<AlphaMask3d>,
                queue::queue::<Transparent3d>,
                queue::queue::<Opaque3dPrepass>,
                queue::queue::<AlphaMask3dPrepass>,
                queue::queue::<Shadow>,
            )
                .in_set(RenderSystems::Queue),
        )
        .add_systems(Render, stages::forget.in_set(RenderSystems::Cleanup))
        .add_systems(RenderGraph, stages::prepare.in_set(RenderGraphSystems::Begin));
}

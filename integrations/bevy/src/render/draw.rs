//! The draw of one entity.

use super::pipelines::Pipelines;
use super::stages::Stages;
use crate::program::DRAW_GROUP;
use bevy::ecs::query::ROQueryItem;
use bevy::ecs::system::SystemParamItem;
use bevy::ecs::system::lifetimeless::{Read, SRes};
use bevy::pbr::MeshViewBindGroup;
use bevy::render::render_phase::{
    PhaseItem, RenderCommand, RenderCommandResult, TrackedRenderPass,
};
use bevy::render::render_resource::{IndexFormat, PipelineCache};
use bevy::render::view::ExtractedView;
use tess_wgpu::stage::DrawBuffers;

/// Draws the group of an entity.
pub(crate) struct DrawTessellated;

impl<P: PhaseItem> RenderCommand<P> for DrawTessellated {
    type Param = (SRes<Stages>, SRes<Pipelines>, SRes<PipelineCache>);
    type ViewQuery = (Read<ExtractedView>, Read<MeshViewBindGroup>);
    type ItemQuery = ();

    fn render<'w>(
        item: &P,
        (view, of_view): ROQueryItem<'w, '_, Self::ViewQuery>,
        _: Option<()>,
        (stages, pipelines, cache): SystemParamItem<'w, '_, Self::Param>,
        pass: &mut TrackedRenderPass<'w>,
    ) -> RenderCommandResult {
        let view = view.retained_view_entity;
        let Some((program, prepared, group)) = stages.into_inner().find(view, item.main_entity())
        else {
            return RenderCommandResult::Skip;
        };
        let pipeline =
            pipelines.of(program, view).and_then(|id| cache.into_inner().get_render_pipeline(id));
        let (Some(pipeline), Some(drawn)) = (pipeline, prepared.drawn()) else {
            return RenderCommandResult::Skip;
        };
        pass.set_render_pipeline(pipeline);
        pass.set_bind_group(0, &of_view.main, &of_view.main_offsets);
        pass.set_bind_group(1, &of_view.binding_array, &[]);
        pass.set_bind_group(DRAW_GROUP, prepared.bind_group(), &[]);
        pass.set_vertex_buffer(0, drawn.points.slice(..));
        pass.set_index_buffer(drawn.indices.slice(..), IndexFormat::Uint32);
        pass.draw_indexed_indirect(&drawn.arguments, DrawBuffers::GROUP_BYTES * u64::from(group));
        RenderCommandResult::Success
    }
}

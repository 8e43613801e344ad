//! The draw of one entity.

use super::stages::Stages;
use crate::program::DRAW_GROUP;
use bevy::ecs::query::ROQueryItem;
use bevy::ecs::system::SystemParamItem;
use bevy::ecs::system::lifetimeless::{Read, SRes};
use bevy::pbr::{
    MATERIAL_BIND_GROUP_INDEX, SetMaterialBindGroup, SetMeshViewBindGroup,
    SetMeshViewBindingArrayBindGroup, SetPrepassViewBindGroup, SetPrepassViewEmptyBindGroup,
};
use bevy::render::render_phase::{
    PhaseItem, RenderCommand, RenderCommandResult, SetItemPipeline, TrackedRenderPass,
};
use bevy::render::render_resource::IndexFormat;
use bevy::render::view::ExtractedView;
use tess_wgpu::TessellationStage;

/// The draw in the main pass.
pub(crate) type DrawLit = (
    SetItemPipeline,
    SetMeshViewBindGroup<0>,
    SetMeshViewBindingArrayBindGroup<1>,
    SetMaterialBindGroup<MATERIAL_BIND_GROUP_INDEX>,
    DrawTessellated,
);

/// The draw in a prepass or a shadow map.
pub(crate) type DrawDepth = (
    SetItemPipeline,
    SetPrepassViewBindGroup<0>,
    SetPrepassViewEmptyBindGroup<1>,
    SetMaterialBindGroup<MATERIAL_BIND_GROUP_INDEX>,
    DrawTessellated,
);

/// Draws the group of an entity.
pub(crate) struct DrawTessellated;

impl<P: PhaseItem> RenderCommand<P> for DrawTessellated {
    type Param = SRes<Stages>;
    type ViewQuery = Read<ExtractedView>;
    type ItemQuery = ();

    fn render<'w>(
        item: &P,
        view: ROQueryItem<'w, '_, Self::ViewQuery>,
        _: Option<()>,
        stages: SystemParamItem<'w, '_, Self::Param>,
        pass: &mut TrackedRenderPass<'w>,
    ) -> RenderCommandResult {
        let found = stages.into_inner().find(view.retained_view_entity, item.main_entity());
        let Some((bind_group, drawn, group)) = found else {
            return RenderCommandResult::Skip;
        };
        pass.set_bind_group(DRAW_GROUP, bind_group, &[]);
        pass.set_vertex_buffer(0, drawn.points.slice(..));
        pass.set_index_buffer(drawn.indices.slice(..), IndexFormat::Uint32);
        let at = TessellationStage::GROUP_BYTES * u64::from(group);
        pass.draw_indexed_indirect(&drawn.arguments, at);
        RenderCommandResult::Success
    }
}

//! One tessellation stage for each camera and program: all its entities are prepared in one call.

use super::content::Content;
use super::extract::{Extracted, Item};
use super::layout;
use crate::component::{TessStats, Tessellated};
use crate::eye::View;
use crate::program::Key;
use crate::shape::Shape;
use bevy::ecs::prelude::*;
use bevy::log::error;
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::render_resource::{BindGroup, Buffer, PipelineCache};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RenderVisibleEntities, RetainedViewEntity};
use std::sync::Arc;
use tess_wgpu::TessellationStage;

/// The stages of all cameras.
#[derive(Debug, Default, Resource)]
pub(crate) struct Stages {
    /// By the program's number.
    of_views: HashMap<RetainedViewEntity, HashMap<usize, Prepared>>,
}

impl Stages {
    /// The stage of some camera and program.
    #[cfg(test)]
    pub(crate) fn first(&self) -> Option<&TessellationStage> {
        let prepared = self.of_views.values().flat_map(HashMap::values).next()?;
        prepared.stage.as_ref().map(|(stage, _)| stage)
    }

    /// The number of an entity's program, its stage, and the entity's group in it.
    pub(crate) fn find(
        &self,
        view: RetainedViewEntity,
        entity: MainEntity,
    ) -> Option<(usize, &Prepared, u32)> {
        self.of_views.get(&view)?.iter().find_map(|(&program, prepared)| {
            Some((program, prepared, *prepared.content.as_ref()?.groups.get(&entity)?))
        })
    }
}

/// A stage, and what its shaders read.
#[derive(Debug, Default)]
pub(crate) struct Prepared {
    /// The entities, in the order of their groups.
    entities: Vec<(MainEntity, Arc<dyn Shape>)>,
    content: Option<Content>,
    stage: Option<(TessellationStage, u32)>,
    drawn: Option<Drawn>,
    /// An error is logged once; the program is then not drawn until its entities change.
    has_failed: bool,
    is_used: bool,
}

/// The buffers of a draw.
#[derive(Debug)]
pub(crate) struct Drawn {
    pub(crate) points: Buffer,
    pub(crate) indices: Buffer,
    pub(crate) arguments: Buffer,
}

impl Prepared {
    pub(crate) const fn drawn(&self) -> Option<&Drawn> {
        self.drawn.as_ref()
    }

    pub(crate) fn bind_group(&self) -> &BindGroup {
        &self.content.as_ref().expect("what is drawn has content").bind_group
    }
}

/// Prepares the stages of a camera, in front of its main pass.
pub(crate) fn prepare(
    camera: ViewQuery<(&ExtractedView, &RenderVisibleEntities)>,
    extracted: Res<Extracted>,
    mut stages: ResMut<Stages>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    cache: Res<PipelineCache>,
    mut context: RenderContext,
) {
    let (camera, visible) = camera.into_inner();
    let clip_from_view = camera.clip_from_view;
    let view = View::new(&camera.world_from_view, clip_from_view, camera.viewport.w);
    let visible = visible.get::<Tessellated>();
    let visible: HashSet<MainEntity> =
        visible.iter().flat_map(|class| &class.entities_cpu_culling).map(|pair| pair.1).collect();
    let mut programs: HashMap<usize, Vec<&Item>> = HashMap::default();
    for item in &extracted.items {
        programs.entry(item.program.number).or_default().push(item);
    }
    let of_view = stages.of_views.entry(camera.retained_view_entity).or_default();
    for (number, items) in programs {
        let prepared = of_view.entry(number).or_default();
        prepared.is_used = true;
        prepared.refresh(&items, &device, &cache);
        let Some(content) = &prepared.content else { continue };
        content.update(&items, view, &visible, &queue);
        if let Err(problem) =
            prepared.tessellate(&items[0].program.key, &device, &cache, &mut context)
        {
            error!("surfaces cannot be tessellated: {problem}");
            prepared.has_failed = true;
            prepared.drawn = None;
        }
    }
}

impl Prepared {
    /// Takes other entities than the frame before.
    fn refresh(&mut self, items: &[&Item], device: &RenderDevice, cache: &PipelineCache) {
        let is_same = |(own, item): (&(MainEntity, Arc<dyn Shape>), &&Item)| {
            own.0 == item.entity && Arc::ptr_eq(&own.1, &item.shape)
        };
        if self.entities.len() == items.len() && self.entities.iter().zip(items).all(is_same) {
            return;
        }
        self.entities = items.iter().map(|item| (item.entity, Arc::clone(&item.shape))).collect();
        let content = Content::new(items, device, cache);
        self.has_failed = content.is_err();
        self.content =
            content.inspect_err(|problem| error!("surfaces cannot be tessellated: {problem}")).ok();
        self.drawn = None;
    }

    fn tessellate(
        &mut self,
        key: &Key,
        device: &RenderDevice,
        cache: &PipelineCache,
        context: &mut RenderContext,
    ) -> Result<(), tess_wgpu::Error> {
        let Some(content) = self.content.as_ref().filter(|_| !self.has_failed) else {
            return Ok(());
        };
        let room = self.stage.as_ref().map_or(0, |(_, room)| *room);
        if room < content.patches || self.stage.is_none() {
            let room = content.patches.checked_next_power_of_two().unwrap_or(u32::MAX);
            self.stage = Some((stage(key, room, content, device, cache)?, room));
        } else if let (None, Some((stage, _))) = (&self.drawn, &mut self.stage) {
            stage.set_bind_group(0, &content.bind_group)?;
            stage.set_groups(&content.first_patches())?;
        }
        let Some((stage, _)) = &mut self.stage else { return Ok(()) };
        stage.prepare(context.command_encoder(), content.patches)?;
        let buffers = stage.buffers()?;
        self.drawn = Some(Drawn {
            points: buffers.points.clone().into(),
            indices: buffers.indices.clone().into(),
            arguments: buffers.group_arguments.clone().into(),
        });
        Ok(())
    }
}

/// A stage for up to `patches` patches; Bevy makes its render pipeline.
fn stage(
    key: &Key,
    patches: u32,
    content: &Content,
    device: &RenderDevice,
    cache: &PipelineCache,
) -> Result<TessellationStage, tess_wgpu::Error> {
    let source = key.hull_source();
    let layout = cache.get_bind_group_layout(&layout::bind_group_layout());
    TessellationStage::builder(&source, key.domain, key.config, patches)
        .bind_group(&layout, &content.bind_group)
        .groups(&content.first_patches())
        .without_pipeline()
        .build(device.wgpu_device())
}

/// Drops the stages of cameras and programs that are gone, and counts what was drawn.
pub(crate) fn forget(mut stages: ResMut<Stages>, extracted: Res<Extracted>, stats: Res<TessStats>) {
    let mut triangles = 0;
    for of_view in stages.of_views.values_mut() {
        of_view.retain(|_, prepared| std::mem::take(&mut prepared.is_used));
        let feedbacks =
            of_view.values().filter_map(|prepared| prepared.stage.as_ref()?.0.feedback());
        triangles += feedbacks.map(|feedback| feedback.drawn).sum::<u64>();
    }
    stages.of_views.retain(|_, of_view| !of_view.is_empty());
    if extracted.is_on_gpu {
        stats.set(triangles);
    }
}

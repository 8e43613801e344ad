//! One tessellation stage for each camera and program: all its entities are prepared in one call.

use super::content::Content;
use super::extract::{Extracted, Item};
use super::layout;
use super::queue::Seen;
use crate::component::TessStats;
use crate::eye::View;
use crate::program::Key;
use crate::shape::Shape;
use bevy::camera::Camera3d;
use bevy::ecs::prelude::*;
use bevy::log::error;
use bevy::platform::collections::HashMap;
use bevy::render::camera::SortedCameras;
use bevy::render::render_resource::{BindGroup, Buffer, CommandEncoder, PipelineCache};
use bevy::render::renderer::{PendingCommandBuffers, RenderDevice, RenderQueue};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RetainedViewEntity};
use std::sync::Arc;
use tess_wgpu::TessellationStage;

/// The stages of all cameras.
#[derive(Debug, Default, Resource)]
pub(crate) struct Stages {
    /// By the program's number.
    of_views: HashMap<RetainedViewEntity, HashMap<usize, Prepared>>,
    /// The camera by which surfaces are tessellated for lights that all cameras share.
    first: Option<RetainedViewEntity>,
}

impl Stages {
    /// The stage of some camera and program.
    #[cfg(test)]
    pub(crate) fn first(&self) -> Option<&TessellationStage> {
        let prepared = self.of_views.values().flat_map(HashMap::values).next()?;
        prepared.stage.as_ref().map(|(stage, _)| stage)
    }

    /// What the draw of an entity takes, and its group, for a camera or for a shadow map.
    pub(crate) fn find(
        &self,
        view: RetainedViewEntity,
        entity: MainEntity,
    ) -> Option<(&BindGroup, &Drawn, u32)> {
        let of_camera = |camera| RetainedViewEntity::new(camera, None, 0);
        let camera = view.auxiliary_entity.map_or(view, of_camera);
        let of_view = self.of_views.get(&camera).or_else(|| self.of_views.get(&self.first?))?;
        of_view.values().find_map(|Prepared { content, drawn, .. }| {
            let content = content.as_ref()?;
            Some((&content.bind_group, drawn.as_ref()?, *content.groups.get(&entity)?))
        })
    }
}

/// A stage, and what its shaders read.
#[derive(Debug, Default)]
pub(crate) struct Prepared {
    /// The entities, in the order of their groups, with their shapes and numbers of values.
    entities: Vec<(MainEntity, Arc<dyn Shape>, usize)>,
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

/// Prepares the stages of all cameras, in front of every pass.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are what it uses")]
pub(crate) fn prepare(
    cameras: Res<SortedCameras>,
    views: Query<&ExtractedView, With<Camera3d>>,
    seen: Seen<'_, '_>,
    extracted: Res<Extracted>,
    mut stages: ResMut<Stages>,
    device: Res<RenderDevice>,
    queue: Res<RenderQueue>,
    cache: Res<PipelineCache>,
    mut pending: ResMut<PendingCommandBuffers>,
) {
    let mut programs: HashMap<usize, Vec<&Item>> = HashMap::default();
    for item in &extracted.items {
        programs.entry(item.program.number).or_default().push(item);
    }
    let mut encoder = device.create_command_encoder(&Default::default());
    stages.first = None;
    for view in cameras.0.iter().filter_map(|camera| views.get(camera.entity).ok()) {
        let camera = view.retained_view_entity;
        stages.first.get_or_insert(camera);
        let of_view = stages.of_views.entry(camera).or_default();
        let visible = seen.by(camera);
        let height = view.viewport.w;
        let view =
            View::new(&view.world_from_view, view.clip_from_view, height, &extracted.casting);
        for (number, items) in &programs {
            let prepared = of_view.entry(*number).or_default();
            prepared.is_used = true;
            prepared.refresh(items, &device, &cache);
            let Some(content) = &mut prepared.content else { continue };
            content.update(items, view, &visible, &queue);
            let key = &items[0].program.key;
            if let Err(problem) = prepared.tessellate(key, &device, &cache, &mut encoder) {
                error!("surfaces cannot be tessellated: {problem}");
                prepared.has_failed = true;
                prepared.drawn = None;
            }
        }
    }
    pending.push([encoder.finish()]);
}

impl Prepared {
    /// Takes other entities than the frame before.
    fn refresh(&mut self, items: &[&Item], device: &RenderDevice, cache: &PipelineCache) {
        let is_same = |((entity, shape, values), item): (&(_, _, _), &&Item)| {
            *entity == item.entity
                && Arc::ptr_eq(shape, &item.shape)
                && *values == item.values.len()
        };
        if self.entities.len() == items.len() && self.entities.iter().zip(items).all(is_same) {
            return;
        }
        let own = |item: &&Item| (item.entity, Arc::clone(&item.shape), item.values.len());
        self.entities = items.iter().map(own).collect();
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
        encoder: &mut CommandEncoder,
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
        stage.prepare(encoder, content.patches)?;
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

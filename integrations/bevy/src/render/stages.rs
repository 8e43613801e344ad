//! One tessellation stage for each camera and program: all its entities are prepared in one call.

use super::content::Content;
use super::extract::{Extracted, Item};
use super::layout;
use super::mirror::Gpu;
use super::places::Places;
use super::seen::Seen;
use crate::component::TessStats;
use crate::eye::View;
use crate::program::Key;
use bevy::camera::Camera3d;
use bevy::ecs::prelude::*;
use bevy::log::error;
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::camera::SortedCameras;
use bevy::render::render_resource::{BindGroup, Buffer, CommandEncoder, PipelineCache};
use bevy::render::renderer::{PendingCommandBuffers, RenderDevice, RenderQueue};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RetainedViewEntity};
use std::cell::Cell;
use std::mem::replace;
use tess_wgpu::tess_gpu::Capacity;
use tess_wgpu::tess_gpu::sizes::{CATALOGUE_PATCHES, SHORT_PATCHES};
use tess_wgpu::{TessellationStage, Tessellator};

/// The stages of all cameras.
#[derive(Debug, Default, Resource)]
pub(crate) struct Stages {
    /// The places of each program's entities, by the program's number.
    places: HashMap<usize, Places>,
    of_views: HashMap<RetainedViewEntity, HashMap<usize, Prepared>>,
    /// The camera whose tessellation is drawn for lights that all cameras share.
    first: Option<RetainedViewEntity>,
    /// The pipelines that all stages share.
    tessellator: Option<Tessellator>,
    uploaded: u64,
}

impl Stages {
    /// The stage of some camera and program.
    #[cfg(test)]
    pub(crate) fn first(&self) -> Option<&TessellationStage> {
        let prepared = self.of_views.values().flat_map(HashMap::values).next()?;
        prepared.stage.as_ref().map(|(stage, _)| stage)
    }

    /// The bind group, buffers and group number of an entity's draw, for a camera or for a shadow
    /// map.
    pub(crate) fn find(
        &self,
        view: RetainedViewEntity,
        entity: MainEntity,
    ) -> Option<(&BindGroup, &Drawn, u32)> {
        let of_camera = |camera| RetainedViewEntity::new(camera, None, 0);
        let camera = view.auxiliary_entity.map_or(view, of_camera);
        let of_view = self.of_views.get(&camera).or_else(|| self.of_views.get(&self.first?))?;
        of_view.iter().find_map(|(number, Prepared { content, drawn, .. })| {
            let group = *self.places.get(number)?.groups.get(&entity)?;
            Some((content.as_ref()?.bind_group()?, drawn.as_ref()?, group))
        })
    }
}

/// A stage, and what its shaders read.
#[derive(Debug, Default)]
pub(crate) struct Prepared {
    content: Option<Content>,
    /// The stage, and the most patches that it takes.
    stage: Option<(TessellationStage, u32)>,
    drawn: Option<Drawn>,
    /// [`Places::changes`] when the stage was last prepared.
    changes: u64,
    /// An error is logged once; the program is then not drawn until its entities change.
    has_failed: bool,
    /// The frames since it was last prepared.
    idle: u32,
}

/// The frames for which a stage and its buffers are kept without entities: 17 seconds at 60 frames
/// per second.
const PATIENCE: u32 = 1024;
/// Numbers of patches at which stages begin to need other pipelines. These are made with the first
/// stage, so that growth never waits for one.
const OTHER_KINDS: [u32; 2] = [SHORT_PATCHES + 1, CATALOGUE_PATCHES];
/// The fewest patches for which a stage is made.
const LEAST_PATCHES: u32 = 1024;

/// The buffers of a draw.
#[derive(Debug)]
pub(crate) struct Drawn {
    pub(crate) points: Buffer,
    pub(crate) indices: Buffer,
    pub(crate) arguments: Buffer,
}

/// Prepares the stages of all cameras, before every pass.
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
        stages.places.entry(item.program.number).or_default();
    }
    let gpu = Gpu { device: &device, queue: &queue, uploaded: Cell::new(0) };
    let Stages { places, of_views, first, tessellator, uploaded } = &mut *stages;
    for (number, places) in places.iter_mut() {
        places.refresh(programs.get(number).map_or(&[], Vec::as_slice), &gpu);
    }
    let tessellator = tessellator.get_or_insert_with(|| Tessellator::new(device.wgpu_device()));
    let own = (&gpu, &*cache, &*tessellator);
    let mut encoder = device.create_command_encoder(&Default::default());
    let views: Vec<_> = cameras.0.iter().filter_map(|one| views.get(one.entity).ok()).collect();
    *first = views.first().map(|view| view.retained_view_entity);
    of_views.retain(|camera, _| views.iter().any(|view| view.retained_view_entity == *camera));
    for view in views {
        let camera = view.retained_view_entity;
        let of_view = of_views.entry(camera).or_default();
        let visible = seen.by(camera);
        let height = view.viewport.w;
        let view =
            View::new(&view.world_from_view, view.clip_from_view, height, &extracted.casting);
        for (number, items) in &programs {
            let prepared = of_view.entry(*number).or_default();
            let of = (&places[number], items.as_slice());
            if let Err(problem) = prepared.tessellate(of, (view, &visible), own, &mut encoder) {
                error!("surfaces cannot be tessellated: {problem}");
                prepared.has_failed = true;
                prepared.drawn = None;
            }
        }
    }
    *uploaded = gpu.uploaded.get();
    pending.push([encoder.finish()]);
}

impl Prepared {
    fn tessellate(
        &mut self,
        (places, items): (&Places, &[&Item]),
        (view, visible): (View, &HashSet<MainEntity>),
        (gpu, cache, tessellator): (&Gpu<'_>, &PipelineCache, &Tessellator),
        encoder: &mut CommandEncoder,
    ) -> Result<(), String> {
        self.idle = 0;
        let is_changed = replace(&mut self.changes, places.changes) != places.changes;
        self.has_failed &= !is_changed;
        if self.has_failed {
            return Ok(());
        }
        let content = self.content.get_or_insert_with(|| Content::new(gpu.device));
        content.update((places, items), view, visible, gpu)?;
        let Some(group) = content.bind(places, gpu.device, cache) else { return Ok(()) };
        let told = |error: tess_wgpu::Error| error.to_string();
        let fits = self.stage.as_ref().is_some_and(|(_, most)| *most >= places.patches());
        if !fits {
            let most = places.patches().checked_next_power_of_two().unwrap_or(u32::MAX);
            let most = most.max(LEAST_PATCHES);
            let room = self.stage.as_ref().map(|(stage, _)| stage.capacity());
            let own = (gpu, cache, tessellator);
            let new = |patches, room: Option<Capacity>, begins: &[u32]| {
                let like = (patches, room.unwrap_or_default());
                stage(&items[0].program.key, like, (group, begins), own).map_err(told)
            };
            if room.is_none() {
                for patches in OTHER_KINDS {
                    new(patches, None, &[0])?;
                }
            }
            self.stage = Some((new(most, room, &places.begins)?, most));
        }
        let Some((stage, _)) = &mut self.stage else { return Ok(()) };
        stage.set_bind_group(0, group).map_err(told)?;
        if fits && is_changed {
            stage.set_groups(&places.begins).map_err(told)?;
        }
        stage.prepare(encoder, places.patches()).map_err(told)?;
        self.drawn = stage.vertices().zip(stage.indices()).map(|(points, indices)| Drawn {
            points: points.into(),
            indices: indices.into(),
            arguments: stage.group_indirect().into(),
        });
        Ok(())
    }
}

/// A stage for this many patches that begins with this room; Bevy makes its render pipeline.
fn stage(
    key: &Key,
    (patches, room): (u32, Capacity),
    (group, begins): (&BindGroup, &[u32]),
    (gpu, cache, tessellator): (&Gpu<'_>, &PipelineCache, &Tessellator),
) -> Result<TessellationStage, tess_wgpu::Error> {
    let source = key.hull_source();
    let layout = cache.get_bind_group_layout(&layout::bind_group_layout());
    TessellationStage::builder(&source, key.domain, key.config, patches)
        .bind_group(&layout, group)
        .groups(begins)
        .first_room(room)
        .tessellator(tessellator)
        .build(gpu.device.wgpu_device())
}

/// Drops stages and places that no entity has used for long, and counts the drawn triangles.
pub(crate) fn forget(mut stages: ResMut<Stages>, extracted: Res<Extracted>, stats: Res<TessStats>) {
    let mut triangles = 0;
    let Stages { places, of_views, uploaded, .. } = &mut *stages;
    for prepared in of_views.values_mut().flat_map(HashMap::values_mut) {
        if let (0, Some((stage, _))) = (prepared.idle, &prepared.stage) {
            triangles += stage.feedback().map_or(0, |feedback| feedback.drawn);
        }
        prepared.idle += 1;
    }
    of_views.values_mut().for_each(|all| all.retain(|_, prepared| prepared.idle < PATIENCE));
    places.retain(|number, own| {
        own.patches() > 0 || of_views.values().any(|all| all.contains_key(number))
    });
    if extracted.is_on_gpu {
        stats.set(triangles, *uploaded);
    }
}

//! One tessellation stage for each camera and setup: all its entities are prepared in one call.

use super::extract::{Extracted, Item};
use super::layout::{self, GpuInstance, GpuView};
use crate::component::{TessStats, Tessellated};
use crate::eye::View;
use crate::setup::Key;
use crate::shape::Shape;
use bevy::ecs::prelude::*;
use bevy::log::error;
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntry, Buffer, BufferInitDescriptor, BufferUsages, PipelineCache,
};
use bevy::render::renderer::{RenderContext, RenderDevice, RenderQueue, ViewQuery};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RenderVisibleEntities, RetainedViewEntity};
use std::sync::Arc;
use tess_wgpu::TessellationStage;

/// The stages of all cameras.
#[derive(Debug, Default, Resource)]
pub(crate) struct Stages {
    of_views: HashMap<RetainedViewEntity, HashMap<Key, Prepared>>,
}

impl Stages {
    /// The stage of an entity, and the entity's group in it.
    pub(crate) fn find(
        &self,
        view: RetainedViewEntity,
        entity: MainEntity,
    ) -> Option<(&Key, &Prepared, u32)> {
        self.of_views.get(&view)?.iter().find_map(|(key, prepared)| {
            Some((key, prepared, *prepared.content.as_ref()?.groups.get(&entity)?))
        })
    }
}

/// A stage, and what its shaders read.
#[derive(Debug, Default)]
pub(crate) struct Prepared {
    content: Option<Content>,
    stage: Option<(TessellationStage, u32)>,
    drawn: Option<Drawn>,
    /// What went wrong is logged once; the setup is then not drawn until its entities change.
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

/// The entities of a setup, in the order of their groups.
#[derive(Debug)]
struct Content {
    entities: Vec<(MainEntity, Arc<dyn Shape>)>,
    groups: HashMap<MainEntity, u32>,
    /// First patch and first word of each.
    firsts: Vec<[u32; 2]>,
    patches: u32,
    view: Buffer,
    instances: Buffer,
    bind_group: BindGroup,
}

impl Prepared {
    pub(crate) const fn drawn(&self) -> Option<&Drawn> {
        self.drawn.as_ref()
    }

    pub(crate) fn bind_group(&self) -> &BindGroup {
        &self.content.as_ref().expect("what is drawn has content").bind_group
    }
}

impl Content {
    fn is_of(&self, items: &[&Item]) -> bool {
        let is_same = |(own, item): (&(MainEntity, Arc<dyn Shape>), &&Item)| {
            own.0 == item.entity && Arc::ptr_eq(&own.1, &item.shape)
        };
        self.entities.len() == items.len() && self.entities.iter().zip(items).all(is_same)
    }

    /// Uploads the shapes, each once however many entities have it.
    fn new(items: &[&Item], device: &RenderDevice, cache: &PipelineCache) -> Option<Self> {
        let (mut owners, mut words) = (Vec::new(), Vec::new());
        let mut firsts = Vec::new();
        let mut first_words = HashMap::<*const (), u32>::default();
        for (number, item) in (0_u32..).zip(items) {
            let first_word = match first_words.get(&Arc::as_ptr(&item.shape).cast()) {
                Some(&first) => first,
                None => {
                    let first = u32::try_from(words.len()).ok()?;
                    words.extend(item.shape.words());
                    first_words.insert(Arc::as_ptr(&item.shape).cast(), first);
                    first
                }
            };
            firsts.push([u32::try_from(owners.len()).ok()?, first_word]);
            owners.resize(owners.len() + item.shape.patches() as usize, number);
        }
        let patches = u32::try_from(owners.len()).ok()?;
        let upload = |label, contents: &[u8], usage| {
            // A binding is never empty.
            let contents = if contents.is_empty() { &[0; 4] } else { contents };
            device.create_buffer_with_data(&BufferInitDescriptor {
                label: Some(label),
                contents,
                usage,
            })
        };
        let usage = BufferUsages::STORAGE;
        let owners = upload("owners of patches", bytemuck::cast_slice(&owners), usage);
        let words = upload("words of shapes", bytemuck::cast_slice(&words), usage);
        let empty = vec![0; size_of::<GpuInstance>() * items.len()];
        let instances = upload("instances", &empty, usage | BufferUsages::COPY_DST);
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let view = upload("view", &[0; size_of::<GpuView>()], usage);
        let buffers = [&view, &instances, &owners, &words];
        let entries = [0, 1, 2, 3].map(|binding| BindGroupEntry {
            binding,
            resource: buffers[binding as usize].as_entire_binding(),
        });
        let layout = cache.get_bind_group_layout(&layout::bind_group_layout());
        let bind_group = device.create_bind_group("bevy_tess", &layout, &entries);
        let entities = items.iter().map(|item| (item.entity, Arc::clone(&item.shape))).collect();
        let groups = items.iter().map(|item| item.entity).zip(0..).collect();
        Some(Self { entities, groups, firsts, patches, view, instances, bind_group })
    }

    /// Writes what changes from frame to frame.
    fn update(
        &self,
        items: &[&Item],
        view: View,
        visible: &HashSet<MainEntity>,
        queue: &RenderQueue,
    ) {
        queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&GpuView::from(view)));
        let instance = |(item, &firsts): (&&Item, &[u32; 2])| {
            GpuInstance::new(item, firsts, visible.contains(&item.entity))
        };
        let instances: Vec<_> = items.iter().zip(&self.firsts).map(instance).collect();
        queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&instances));
    }

    fn first_patches(&self) -> Vec<u32> {
        self.firsts.iter().map(|&[patch, _]| patch).collect()
    }
}

/// Prepares the stages of a camera, in front of its main pass.
#[expect(clippy::too_many_arguments, reason = "a system's parameters are what it uses")]
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
    let mut setups: HashMap<&Key, Vec<&Item>> = HashMap::default();
    for item in &extracted.items {
        setups.entry(&item.setup.key).or_default().push(item);
    }
    let of_view = stages.of_views.entry(camera.retained_view_entity).or_default();
    for (key, items) in setups {
        let prepared = match of_view.get_mut(key) {
            Some(prepared) => prepared,
            None => of_view.entry(key.clone()).or_default(),
        };
        prepared.is_used = true;
        prepared.refresh(&items, &device, &cache);
        let Some(content) = &prepared.content else { continue };
        content.update(&items, view, &visible, &queue);
        if let Err(problem) = prepared.tessellate(key, &device, &cache, &mut context) {
            error!("surfaces cannot be tessellated: {problem}");
            prepared.has_failed = true;
            prepared.drawn = None;
        }
    }
}

impl Prepared {
    /// Takes other entities than those of the frame before.
    fn refresh(&mut self, items: &[&Item], device: &RenderDevice, cache: &PipelineCache) {
        if self.content.as_ref().is_some_and(|content| content.is_of(items)) {
            return;
        }
        self.content = Content::new(items, device, cache);
        self.has_failed = self.content.is_none();
        if self.has_failed {
            error!("surfaces with more than 2^32 patches or words cannot be tessellated");
        }
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
            let room = content.patches.next_power_of_two();
            self.stage = Some((stage(key, room, content, device, cache)?, room));
        } else if let (None, Some((stage, _))) = (&self.drawn, &mut self.stage) {
            stage.set_bind_group(0, &content.bind_group)?;
            stage.set_groups(&content.first_patches())?;
        }
        let Some((stage, _)) = &mut self.stage else { return Ok(()) };
        stage.prepare(context.command_encoder(), content.patches)?;
        self.drawn = stage.buffers().map(|buffers| Drawn {
            points: buffers.points.clone().into(),
            indices: buffers.indices.clone().into(),
            arguments: buffers.group_arguments.clone().into(),
        });
        Ok(())
    }
}

/// A stage for up to so many patches; Bevy makes its render pipeline.
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

/// Drops the stages of cameras and setups that are gone, and counts what was drawn.
pub(crate) fn forget(mut stages: ResMut<Stages>, extracted: Res<Extracted>, stats: Res<TessStats>) {
    let mut triangles = 0;
    for of_view in stages.of_views.values_mut() {
        of_view.retain(|_, prepared| std::mem::take(&mut prepared.is_used));
        let feedbacks =
            of_view.values().filter_map(|prepared| prepared.stage.as_ref()?.0.feedback());
        triangles += feedbacks.map(|feedback| feedback.drawn).sum::<u64>();
    }
    stages.of_views.retain(|_, of_view| !of_view.is_empty());
    if !extracted.items.is_empty() {
        stats.set(triangles);
    }
}

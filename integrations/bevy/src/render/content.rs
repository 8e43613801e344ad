//! The buffers that a camera's shaders read for the entities of a program.

use super::extract::Item;
use super::layout::{self, GpuInstance, GpuView};
use super::mirror::{Gpu, Mirror};
use super::places::Places;
use crate::eye::View;
use bevy::platform::collections::HashSet;
use bevy::render::render_resource::{
    BindGroup, BindGroupEntry, Buffer, BufferId, BufferInitDescriptor, BufferUsages, PipelineCache,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::sync_world::MainEntity;
use bytemuck::Zeroable;

#[derive(Debug)]
pub(crate) struct Content {
    view: Buffer,
    instances: Mirror,
    meshes: Mirror,
    values: Mirror,
    /// The bind group, and the buffers that it binds.
    bound: Option<(Vec<BufferId>, BindGroup)>,
}

impl Content {
    pub(crate) fn new(device: &RenderDevice) -> Self {
        let view = device.create_buffer_with_data(&BufferInitDescriptor {
            label: Some("view"),
            contents: &[0; size_of::<GpuView>()],
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        });
        let [instances, meshes, values] = Default::default();
        Self { view, instances, meshes, values, bound: None }
    }

    /// Writes the values that change from frame to frame. Instances without an entity are hidden.
    pub(crate) fn update(
        &mut self,
        (places, items): (&Places, &[&Item]),
        view: View,
        visible: &HashSet<MainEntity>,
        gpu: &Gpu<'_>,
    ) -> Result<(), String> {
        gpu.queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&GpuView::from(view)));
        let [slots, words] = places.sizes();
        let mut instances: Vec<GpuInstance> = bytemuck::pod_collect_to_vec(&self.instances.words);
        let mut values = self.values.words.clone();
        let mut meshes = self.meshes.words.clone();
        let new_meshes = layout::meshes(items);
        let size = new_meshes.len() / items.len();
        instances.resize(slots.max(instances.len()), GpuInstance::zeroed());
        values.resize(words.max(values.len()), 0);
        meshes.resize((size * slots).max(meshes.len()), 0);
        instances.iter_mut().for_each(GpuInstance::hide);
        for (item, mesh) in items.iter().zip(new_meshes.chunks_exact(size)) {
            let Some((slot, firsts)) = places.of(item.entity) else { continue };
            instances[slot] = GpuInstance::new(item, firsts, visible.contains(&item.entity));
            meshes[size * slot..][..size].copy_from_slice(mesh);
            let own = &mut values[firsts[2] as usize..][..=item.values.len()];
            own[0] = item.values.len() as u32;
            own[1..].copy_from_slice(bytemuck::cast_slice(&item.values));
        }
        self.instances.update(bytemuck::pod_collect_to_vec(&instances), gpu)?;
        self.meshes.update(meshes, gpu)?;
        self.values.update(values, gpu)
    }

    /// The bind group, which is made again whenever one of the buffers was replaced.
    pub(crate) fn bind(
        &mut self,
        places: &Places,
        device: &RenderDevice,
        cache: &PipelineCache,
    ) -> Option<&BindGroup> {
        let [meshes, instances, values] =
            [&self.meshes, &self.instances, &self.values].map(|mirror| mirror.buffer.0.clone());
        let (owners, shapes) = (places.owners.0.clone()?, places.shapes.0.clone()?);
        let buffers = [meshes?, self.view.clone(), instances?, owners, shapes, values?];
        let ids: Vec<_> = buffers.iter().map(Buffer::id).collect();
        if self.bound.as_ref().is_none_or(|(bound, _)| *bound != ids) {
            let bindings = buffers.iter().map(|buffer| buffer.as_entire_binding());
            let entries: Vec<_> = (0..)
                .zip(bindings)
                .map(|(binding, resource)| BindGroupEntry { binding, resource })
                .collect();
            let layout = cache.get_bind_group_layout(&layout::bind_group_layout());
            self.bound = Some((ids, device.create_bind_group("bevy_tess", &layout, &entries)));
        }
        self.bind_group()
    }

    pub(crate) fn bind_group(&self) -> Option<&BindGroup> {
        self.bound.as_ref().map(|(_, group)| group)
    }
}

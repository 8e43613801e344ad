//! The entities of a program, on the device.

use super::extract::Item;
use super::layout::{self, GpuInstance, GpuView};
use super::mirror::Mirror;
use crate::eye::View;
use crate::shape::Shape;
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::render_resource::{
    BindGroup, BindGroupEntry, Buffer, BufferInitDescriptor, BufferUsages, PipelineCache,
};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy::render::sync_world::MainEntity;
use std::iter;
use std::sync::Arc;

/// The entities of a program, in the order of their groups, and what their shaders read.
#[derive(Debug)]
pub(crate) struct Content {
    pub(crate) groups: HashMap<MainEntity, u32>,
    /// First patch and first word of each.
    firsts: Vec<[u32; 2]>,
    pub(crate) patches: u32,
    view: Buffer,
    instances: Mirror,
    meshes: Mirror,
    values: Mirror,
    pub(crate) bind_group: BindGroup,
}

/// Patches and words of entities, one behind another; a shape's words once however many entities have it.
#[derive(Debug, Default, PartialEq)]
struct Packed {
    /// The entity of each patch.
    owners: Vec<u32>,
    words: Vec<u32>,
    /// First patch and first word of each entity.
    firsts: Vec<[u32; 2]>,
}

impl Packed {
    fn new<'a>(shapes: impl Iterator<Item = &'a Arc<dyn Shape>>) -> Result<Self, String> {
        let number = |count: usize| {
            u32::try_from(count).map_err(|_| "there are more than 2^32 patches or words".to_owned())
        };
        let mut packed = Self::default();
        let mut known = HashMap::<*const (), u32>::default();
        for (owner, shape) in (0..).zip(shapes) {
            let first_word = match known.get(&Arc::as_ptr(shape).cast()) {
                Some(&first) => first,
                None => {
                    let first = number(packed.words.len())?;
                    packed.words.extend(shape.words());
                    known.insert(Arc::as_ptr(shape).cast(), first);
                    first
                }
            };
            packed.firsts.push([number(packed.owners.len())?, first_word]);
            packed.owners.resize(packed.owners.len() + shape.patches() as usize, owner);
        }
        number(packed.owners.len())?;
        Ok(packed)
    }
}

/// The values of each frame: their number, then themselves, of each entity.
fn packed_values(items: &[&Item]) -> Vec<u32> {
    let of = |item: &&Item| {
        let count = u32::try_from(item.values.len()).unwrap_or(u32::MAX);
        iter::once(count).chain(item.values.iter().map(|value| value.to_bits())).collect::<Vec<_>>()
    };
    items.iter().flat_map(of).collect()
}

/// A buffer with these bytes; an error if it exceeds one binding. A binding is never empty.
fn upload(
    device: &RenderDevice,
    label: &str,
    contents: &[u8],
    usage: BufferUsages,
) -> Result<Buffer, String> {
    let contents = if contents.is_empty() { &[0; 4] } else { contents };
    let limits = device.limits();
    let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    if contents.len() as u64 > limit {
        let got = contents.len();
        return Err(format!("{label} take {got} bytes, and the device binds {limit}; use less"));
    }
    let label = Some(label);
    Ok(device.create_buffer_with_data(&BufferInitDescriptor { label, contents, usage }))
}

impl Content {
    /// Uploads the shapes. Errors say what is too much.
    pub(crate) fn new(
        items: &[&Item],
        device: &RenderDevice,
        cache: &PipelineCache,
    ) -> Result<Self, String> {
        let Packed { owners, words, firsts } = Packed::new(items.iter().map(|item| &item.shape))?;
        let patches = u32::try_from(owners.len()).unwrap_or(u32::MAX);
        let usage = BufferUsages::STORAGE;
        let owners = upload(device, "owners of patches", bytemuck::cast_slice(&owners), usage)?;
        let words = upload(device, "words of shapes", bytemuck::cast_slice(&words), usage)?;
        let mirror = |label, words: Vec<u32>| {
            let usage = usage | BufferUsages::COPY_DST;
            let buffer = upload(device, label, bytemuck::cast_slice(&words), usage)?;
            Ok::<_, String>(Mirror::new(buffer, words))
        };
        let instances = mirror("instances", vec![0; size_of::<GpuInstance>() / 4 * items.len()])?;
        let meshes = mirror("meshes", layout::meshes(items))?;
        let values = mirror("values", packed_values(items))?;
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let view = upload(device, "view", &[0; size_of::<GpuView>()], usage)?;
        let mut binding = 0..;
        let entries = [&meshes.buffer, &view, &instances.buffer, &owners, &words, &values.buffer]
            .map(|buffer| {
                let binding = binding.next().unwrap_or(0);
                BindGroupEntry { binding, resource: buffer.as_entire_binding() }
            });
        let layout = cache.get_bind_group_layout(&layout::bind_group_layout());
        let bind_group = device.create_bind_group("bevy_tess", &layout, &entries);
        let groups = items.iter().map(|item| item.entity).zip(0..).collect();
        Ok(Self { groups, firsts, patches, view, instances, meshes, values, bind_group })
    }

    /// Writes what changes from frame to frame.
    pub(crate) fn update(
        &mut self,
        items: &[&Item],
        view: View,
        visible: &HashSet<MainEntity>,
        queue: &RenderQueue,
    ) {
        queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&GpuView::from(view)));
        let mut first_value = 0;
        let instance = |(item, &[patch, word]): (&&Item, &[u32; 2])| {
            let firsts = [patch, word, first_value];
            first_value += 1 + item.values.len() as u32;
            GpuInstance::new(item, firsts, visible.contains(&item.entity))
        };
        let instances: Vec<_> = items.iter().zip(&self.firsts).map(instance).collect();
        self.instances.update(bytemuck::cast_slice(&instances).to_vec(), queue);
        self.meshes.update(layout::meshes(items), queue);
        self.values.update(packed_values(items), queue);
    }

    pub(crate) fn first_patches(&self) -> Vec<u32> {
        self.firsts.iter().map(|&[patch, _]| patch).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::height_field::HeightField;
    use bevy::math::UVec2;

    #[test]
    fn a_shared_shape_is_packed_once() {
        let map = |height| -> Arc<dyn Shape> {
            let map = HeightField::new(UVec2::ONE, vec![height]).expect("one texel");
            Arc::new(map.with_patches(UVec2::new(2, 1)).expect("two patches"))
        };
        let (a, b) = (map(1.0), map(2.0));
        let words = a.words().len() as u32;
        let packed = Packed::new([&a, &b, &a].into_iter()).expect("it fits");
        assert_eq!(packed.owners, [0, 0, 1, 1, 2, 2], "two patches each");
        assert_eq!(packed.firsts, [[0, 0], [2, words], [4, 0]], "a's words are there once");
        assert_eq!(packed.words, [a.words(), b.words()].concat(), "in their order");
    }
}

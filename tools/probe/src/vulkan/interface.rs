//! The interface of shaders, and the buffers bound to it.

use super::{Gpu, Owned};
use crate::error::Error;
use ash::vk;
use std::sync::Arc;

/// Buffers in set 0, numbered from 0, and push constants.
#[derive(Debug)]
pub(crate) struct Interface {
    pub(crate) layout: Owned<vk::PipelineLayout>,
    set_layout: Owned<vk::DescriptorSetLayout>,
}

impl Interface {
    /// An interface of buffers of these types, and this many bytes of constants, for these stages.
    pub(crate) fn new(
        gpu: &Arc<Gpu>,
        stages: vk::ShaderStageFlags,
        types: impl IntoIterator<Item = vk::DescriptorType>,
        constants: u32,
    ) -> Result<Self, Error> {
        let binding = |(number, ty)| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(number)
                .descriptor_type(ty)
                .descriptor_count(1)
                .stage_flags(stages)
        };
        let bindings: Vec<_> = (0..).zip(types).map(binding).collect();
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let calls = (
            ash::Device::create_descriptor_set_layout as _,
            ash::Device::destroy_descriptor_set_layout as _,
        );
        // SAFETY: the structures live through the call.
        let set_layout = unsafe { Owned::new(gpu, "vkCreateDescriptorSetLayout", calls, &create) }?;
        let layouts = [*set_layout];
        let ranges = [vk::PushConstantRange::default().stage_flags(stages).size(constants)];
        let create = vk::PipelineLayoutCreateInfo::default()
            .set_layouts(&layouts)
            .push_constant_ranges(&ranges[..usize::from(constants > 0)]);
        let calls =
            (ash::Device::create_pipeline_layout as _, ash::Device::destroy_pipeline_layout as _);
        // SAFETY: as above; the layout of the set is the device's.
        let layout = unsafe { Owned::new(gpu, "vkCreatePipelineLayout", calls, &create) }?;
        Ok(Self { layout, set_layout })
    }
}

/// A pool for sets.
#[derive(Debug)]
pub(crate) struct Sets {
    pool: Owned<vk::DescriptorPool>,
    gpu: Arc<Gpu>,
}

impl Sets {
    /// A pool for this many sets, and for the buffers of all of them.
    pub(crate) fn new(gpu: &Arc<Gpu>, sets: usize, buffers: usize) -> Result<Self, Error> {
        let count = |number| u32::try_from(number).unwrap_or(u32::MAX).max(1);
        let sizes = [vk::DescriptorType::UNIFORM_BUFFER, vk::DescriptorType::STORAGE_BUFFER]
            .map(|ty| vk::DescriptorPoolSize::default().ty(ty).descriptor_count(count(buffers)));
        let create =
            vk::DescriptorPoolCreateInfo::default().max_sets(count(sets)).pool_sizes(&sizes);
        let calls =
            (ash::Device::create_descriptor_pool as _, ash::Device::destroy_descriptor_pool as _);
        // SAFETY: the structures live through the call.
        let pool = unsafe { Owned::new(gpu, "vkCreateDescriptorPool", calls, &create) }?;
        Ok(Self { pool, gpu: Arc::clone(gpu) })
    }

    /// A set with these buffers bound; each has a type, an offset and a size in bytes.
    pub(crate) fn bind(
        &self,
        interface: &Interface,
        buffers: impl IntoIterator<Item = (vk::DescriptorType, vk::Buffer, u64, u64)>,
    ) -> Result<vk::DescriptorSet, Error> {
        let device = &self.gpu.device;
        let layouts = [*interface.set_layout];
        let allocate = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(*self.pool)
            .set_layouts(&layouts);
        // SAFETY: the pool has room for this set.
        let sets = unsafe { device.allocate_descriptor_sets(&allocate) }
            .map_err(Error::of("vkAllocateDescriptorSets"))?;
        for (number, (ty, buffer, offset, size)) in (0..).zip(buffers) {
            let bound =
                [vk::DescriptorBufferInfo::default().buffer(buffer).offset(offset).range(size)];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(sets[0])
                .dst_binding(number)
                .descriptor_type(ty)
                .buffer_info(&bound);
            // SAFETY: nothing that uses the set is running.
            unsafe { device.update_descriptor_sets(&[write], &[]) };
        }
        Ok(sets[0])
    }
}

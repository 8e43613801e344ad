//! The compute shaders of `tess-gpu` for one batch: the work of a host that follows a plan.

use super::pipeline::module;
use super::{Commands, DeviceBuffer, Gpu, Interface, Owned, Sets};
use crate::error::Error;
use crate::shaders::words;
use ash::prelude::VkResult;
use ash::vk;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;
use tess_gpu::tables;
use tess_gpu::{Plan, Resource, Setup, Stage, Workgroups};

/// Provides a stage in SPIR-V; an error gives the reason why it cannot.
pub type Spirv<'a> = &'a dyn Fn(Stage, Setup) -> Result<Vec<u8>, String>;

/// A batch with its buffers, pipelines and sets.
#[derive(Debug)]
pub(crate) struct Compute {
    dispatches: Vec<(Stage, vk::DescriptorSet, Workgroups)>,
    _sets: Sets,
    stages: HashMap<Stage, (Owned<vk::Pipeline>, Interface)>,
    buffers: HashMap<Resource, DeviceBuffer>,
}

impl Compute {
    /// Prepares a batch of these raw factors.
    pub(crate) fn new(
        gpu: &Arc<Gpu>,
        commands: &Commands,
        setup: Setup,
        plan: &Plan,
        factors: &[u32],
        spirv: Spirv<'_>,
    ) -> Result<Self, Error> {
        let buffers = buffers(gpu, commands, setup, plan, factors)?;
        let bound = plan.dispatches().map(|dispatch| dispatch.bindings().len()).sum();
        let sets = Sets::new(gpu, plan.dispatches().count(), bound)?;
        let (mut stages, mut dispatches) = (HashMap::new(), Vec::new());
        for dispatch in plan.dispatches() {
            let of = dispatch.stage();
            let (_, interface) = match stages.entry(of) {
                Entry::Occupied(made) => made.into_mut(),
                Entry::Vacant(place) => place.insert(stage(gpu, of, setup, spirv)?),
            };
            let bindings = dispatch.bindings();
            let bound = bindings.map(|(of, span)| {
                (descriptor_type(of), *buffers[&of].handle, span.offset, span.size.max(4))
            });
            dispatches.push((of, sets.bind(interface, bound)?, dispatch.workgroups()));
        }
        Ok(Self { dispatches, _sets: sets, stages, buffers })
    }

    /// The buffer of a resource.
    pub(crate) fn buffer(&self, resource: Resource) -> &DeviceBuffer {
        &self.buffers[&resource]
    }

    /// Records everything from factors to draw arguments; later commands see the results.
    pub(crate) fn record(&self, device: &ash::Device, to: vk::CommandBuffer) {
        let compute = vk::PipelineBindPoint::COMPUTE;
        let status = *self.buffer(Resource::Status).handle;
        // SAFETY: the command buffer is being recorded, outside of a pass; everything outlives the
        // submission, which is waited for.
        unsafe {
            device.cmd_fill_buffer(to, status, 0, vk::WHOLE_SIZE, 0);
            barrier(device, to);
            for &(stage, set, workgroups) in &self.dispatches {
                let (pipeline, interface) = &self.stages[&stage];
                device.cmd_bind_pipeline(to, compute, **pipeline);
                device.cmd_bind_descriptor_sets(to, compute, *interface.layout, 0, &[set], &[]);
                match workgroups {
                    Workgroups::Direct([x, y, z]) => device.cmd_dispatch(to, x, y, z),
                    Workgroups::Indirect(at) => {
                        let arguments = *self.buffer(Resource::Arguments).handle;
                        device.cmd_dispatch_indirect(to, arguments, at);
                    }
                }
                barrier(device, to);
            }
        }
    }
}

const fn descriptor_type(resource: Resource) -> vk::DescriptorType {
    match resource {
        Resource::Job => vk::DescriptorType::UNIFORM_BUFFER,
        _ => vk::DescriptorType::STORAGE_BUFFER,
    }
}

fn buffers(
    gpu: &Arc<Gpu>,
    commands: &Commands,
    setup: Setup,
    plan: &Plan,
    factors: &[u32],
) -> Result<HashMap<Resource, DeviceBuffer>, Error> {
    let usage = vk::BufferUsageFlags::STORAGE_BUFFER
        | vk::BufferUsageFlags::UNIFORM_BUFFER
        | vk::BufferUsageFlags::INDIRECT_BUFFER
        | vk::BufferUsageFlags::VERTEX_BUFFER
        | vk::BufferUsageFlags::INDEX_BUFFER
        | vk::BufferUsageFlags::TRANSFER_SRC
        | vk::BufferUsageFlags::TRANSFER_DST;
    let buffer = |resource| {
        let filled = match resource {
            Resource::Job => words(&plan.jobs()),
            Resource::Factors => factors.to_vec(),
            Resource::Tables => tables(setup.config.split),
            _ => {
                let local = DeviceBuffer::local(gpu, plan.buffer_size(resource), usage)?;
                return Ok((resource, local));
            }
        };
        Ok((resource, DeviceBuffer::uploaded(gpu, commands, &filled, usage)?))
    };
    Resource::ALL.into_iter().map(buffer).collect()
}

/// The pipeline of a stage, and its interface.
fn stage(
    gpu: &Arc<Gpu>,
    stage: Stage,
    setup: Setup,
    spirv: Spirv<'_>,
) -> Result<(Owned<vk::Pipeline>, Interface), Error> {
    let module = module(gpu, &words(&spirv(stage, setup).map_err(Error::Capture)?))?;
    let types = stage.bindings().iter().map(|binding| descriptor_type(binding.0));
    let interface = Interface::new(gpu, vk::ShaderStageFlags::COMPUTE, types, 0)?;
    let name = std::ffi::CString::new(stage.entry_point()).unwrap_or_default();
    let of_stage = vk::PipelineShaderStageCreateInfo::default()
        .stage(vk::ShaderStageFlags::COMPUTE)
        .module(*module)
        .name(&name);
    let create = vk::ComputePipelineCreateInfo::default().stage(of_stage).layout(*interface.layout);
    let calls = (compute_pipeline as _, ash::Device::destroy_pipeline as _);
    // SAFETY: all handles are the device's, and the structures live through the call.
    let pipeline = unsafe { Owned::new(gpu, "vkCreateComputePipelines", calls, &create) }?;
    Ok((pipeline, interface))
}

/// `vkCreateComputePipelines` for one pipeline.
///
/// # Safety
/// As for that function.
unsafe fn compute_pipeline(
    device: &ash::Device,
    create: &vk::ComputePipelineCreateInfo<'_>,
    callbacks: Option<&vk::AllocationCallbacks<'_>>,
) -> VkResult<vk::Pipeline> {
    let (cache, create) = (vk::PipelineCache::null(), [*create]);
    // SAFETY: the caller guarantees it.
    let made = unsafe { device.create_compute_pipelines(cache, &create, callbacks) };
    made.map(|pipelines| pipelines[0]).map_err(|(_, result)| result)
}

/// Makes the writes of earlier commands visible to every later one.
///
/// # Safety
/// The command buffer is being recorded, outside of a pass.
unsafe fn barrier(device: &ash::Device, to: vk::CommandBuffer) {
    let all = vk::PipelineStageFlags::ALL_COMMANDS;
    let memory = vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
        .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE);
    let none = vk::DependencyFlags::empty();
    // SAFETY: the caller guarantees it.
    unsafe { device.cmd_pipeline_barrier(to, all, all, none, &[memory], &[], &[]) };
}

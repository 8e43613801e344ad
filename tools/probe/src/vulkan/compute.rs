//! The compute shaders of `tess-gpu` for one batch: what a host does with a plan.

use super::{Buffer, Commands, Gpu};
use crate::error::Error;
use crate::shaders::words;
use ash::vk;
use std::collections::HashMap;
use std::sync::Arc;
use tess_gpu::tables;
use tess_gpu::{Plan, Resource, Setup, Stage, Workgroups};

/// Gives a stage in SPIR-V; an error says why it cannot.
pub type Spirv<'a> = &'a dyn Fn(Stage, Setup) -> Result<Vec<u8>, String>;

/// A batch with its buffers, pipelines and sets.
#[derive(Debug)]
pub(crate) struct Compute {
    gpu: Arc<Gpu>,
    buffers: HashMap<Resource, Buffer>,
    stages: Vec<(Stage, Made)>,
    pool: vk::DescriptorPool,
    dispatches: Vec<(Stage, vk::DescriptorSet, Workgroups)>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Made {
    set_layout: vk::DescriptorSetLayout,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
}

const fn descriptor_type(resource: Resource) -> vk::DescriptorType {
    match resource {
        Resource::Job => vk::DescriptorType::UNIFORM_BUFFER,
        _ => vk::DescriptorType::STORAGE_BUFFER,
    }
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
        let (buffers, stages) = (HashMap::new(), Vec::new());
        let pool = vk::DescriptorPool::null();
        let gpu = Arc::clone(gpu);
        let mut compute = Self { gpu, buffers, stages, pool, dispatches: Vec::new() };
        compute.make_buffers(commands, setup, plan, factors)?;
        for dispatch in plan.dispatches() {
            let stage = dispatch.stage();
            if compute.made(stage).is_none() {
                compute.make_stage(stage, setup, spirv)?;
            }
        }
        compute.make_sets(plan)?;
        Ok(compute)
    }

    /// The buffer of a resource.
    pub(crate) fn buffer(&self, resource: Resource) -> &Buffer {
        &self.buffers[&resource]
    }

    fn made(&self, stage: Stage) -> Option<Made> {
        self.stages.iter().find(|(own, _)| *own == stage).map(|(_, made)| *made)
    }

    fn make_buffers(
        &mut self,
        commands: &Commands,
        setup: Setup,
        plan: &Plan,
        factors: &[u32],
    ) -> Result<(), Error> {
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::UNIFORM_BUFFER
            | vk::BufferUsageFlags::INDIRECT_BUFFER
            | vk::BufferUsageFlags::VERTEX_BUFFER
            | vk::BufferUsageFlags::INDEX_BUFFER
            | vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST;
        for resource in Resource::ALL {
            let filled = match resource {
                Resource::Job => Some(words(&plan.jobs())),
                Resource::Factors => Some(factors.to_vec()),
                Resource::Tables => Some(tables(setup.config.split)),
                _ => None,
            };
            let buffer = match filled {
                Some(words) => Buffer::uploaded(&self.gpu, commands, &words, usage)?,
                None => Buffer::local(&self.gpu, plan.buffer_size(resource), usage)?,
            };
            self.buffers.insert(resource, buffer);
        }
        Ok(())
    }

    fn make_stage(&mut self, stage: Stage, setup: Setup, spirv: Spirv<'_>) -> Result<(), Error> {
        let mut made = Made::default();
        let result = self.fill_stage(&mut made, stage, setup, spirv);
        self.stages.push((stage, made));
        result
    }

    fn fill_stage(
        &self,
        made: &mut Made,
        stage: Stage,
        setup: Setup,
        spirv: Spirv<'_>,
    ) -> Result<(), Error> {
        let device = &self.gpu.device;
        let code = words(&spirv(stage, setup).map_err(Error::Capture)?);
        let binding = |(number, binding): (u32, &tess_gpu::Binding)| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(number)
                .descriptor_type(descriptor_type(binding.0))
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)
        };
        let bindings: Vec<_> = (0..).zip(stage.bindings()).map(binding).collect();
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the structures live through the call.
        made.set_layout = unsafe { device.create_descriptor_set_layout(&create, None) }
            .map_err(Error::of("vkCreateDescriptorSetLayout"))?;
        let layouts = [made.set_layout];
        let create = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
        // SAFETY: as above.
        made.layout = unsafe { device.create_pipeline_layout(&create, None) }
            .map_err(Error::of("vkCreatePipelineLayout"))?;
        let create = vk::ShaderModuleCreateInfo::default().code(&code);
        // SAFETY: the words are naga's SPIR-V, which tests validate.
        let module = unsafe { device.create_shader_module(&create, None) }
            .map_err(Error::of("vkCreateShaderModule"))?;
        let name = std::ffi::CString::new(stage.entry_point()).unwrap_or_default();
        let of_stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(&name);
        let create = [vk::ComputePipelineCreateInfo::default().stage(of_stage).layout(made.layout)];
        // SAFETY: all handles are the device's, and the structures live through the call.
        let pipelines =
            unsafe { device.create_compute_pipelines(vk::PipelineCache::null(), &create, None) };
        // SAFETY: a pipeline needs its module only while it is made.
        unsafe { device.destroy_shader_module(module, None) };
        let pipelines =
            pipelines.map_err(|(_, result)| Error::of("vkCreateComputePipelines")(result))?;
        made.pipeline = pipelines[0];
        Ok(())
    }

    fn make_sets(&mut self, plan: &Plan) -> Result<(), Error> {
        let device = &self.gpu.device;
        let bound: u32 =
            plan.dispatches().map(|d| u32::try_from(d.bindings().len()).unwrap_or(0)).sum();
        let count = u32::try_from(plan.dispatches().count()).unwrap_or(u32::MAX);
        let sizes = [vk::DescriptorType::UNIFORM_BUFFER, vk::DescriptorType::STORAGE_BUFFER]
            .map(|ty| vk::DescriptorPoolSize::default().ty(ty).descriptor_count(bound));
        let create = vk::DescriptorPoolCreateInfo::default().max_sets(count).pool_sizes(&sizes);
        // SAFETY: the structures live through the call.
        self.pool = unsafe { device.create_descriptor_pool(&create, None) }
            .map_err(Error::of("vkCreateDescriptorPool"))?;
        for dispatch in plan.dispatches() {
            let stage = dispatch.stage();
            let layouts = [self.made(stage).unwrap_or_default().set_layout];
            let allocate = vk::DescriptorSetAllocateInfo::default()
                .descriptor_pool(self.pool)
                .set_layouts(&layouts);
            // SAFETY: the pool has room for a set of each dispatch.
            let sets = unsafe { device.allocate_descriptor_sets(&allocate) }
                .map_err(Error::of("vkAllocateDescriptorSets"))?;
            for (number, (resource, span)) in (0..).zip(dispatch.bindings()) {
                let info = [vk::DescriptorBufferInfo::default()
                    .buffer(self.buffers[&resource].handle)
                    .offset(span.offset)
                    .range(span.size.max(4))];
                let write = vk::WriteDescriptorSet::default()
                    .dst_set(sets[0])
                    .dst_binding(number)
                    .descriptor_type(descriptor_type(resource))
                    .buffer_info(&info);
                // SAFETY: nothing runs that uses the set.
                unsafe { device.update_descriptor_sets(&[write], &[]) };
            }
            self.dispatches.push((stage, sets[0], dispatch.workgroups()));
        }
        Ok(())
    }

    /// Records everything from factors to draw arguments; what comes after sees it.
    pub(crate) fn record(&self, device: &ash::Device, to: vk::CommandBuffer) {
        let compute = vk::PipelineBindPoint::COMPUTE;
        let status = self.buffer(Resource::Status).handle;
        // SAFETY: the command buffer is being recorded, outside of a pass; everything outlives the
        // submission, which is waited for.
        unsafe {
            device.cmd_fill_buffer(to, status, 0, vk::WHOLE_SIZE, 0);
            barrier(device, to);
            for &(stage, set, workgroups) in &self.dispatches {
                let made = self.made(stage).unwrap_or_default();
                device.cmd_bind_pipeline(to, compute, made.pipeline);
                device.cmd_bind_descriptor_sets(to, compute, made.layout, 0, &[set], &[]);
                match workgroups {
                    Workgroups::Direct([x, y, z]) => device.cmd_dispatch(to, x, y, z),
                    Workgroups::Indirect(at) => {
                        let arguments = self.buffer(Resource::Arguments).handle;
                        device.cmd_dispatch_indirect(to, arguments, at);
                    }
                }
                barrier(device, to);
            }
        }
    }
}

/// Lets every later command see what earlier ones wrote.
///
/// # Safety
/// The command buffer is being recorded, outside of a pass.
unsafe fn barrier(device: &ash::Device, to: vk::CommandBuffer) {
    let all = vk::PipelineStageFlags::ALL_COMMANDS;
    let memory = vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
        .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE);
    let none = vk::DependencyFlags::empty();
    // SAFETY: as the caller says.
    unsafe { device.cmd_pipeline_barrier(to, all, all, none, &[memory], &[], &[]) };
}

impl Drop for Compute {
    fn drop(&mut self) {
        let device = &self.gpu.device;
        // SAFETY: nothing runs, as each submission is waited for; null is allowed.
        unsafe {
            device.destroy_descriptor_pool(self.pool, None);
            for (_, made) in &self.stages {
                device.destroy_pipeline(made.pipeline, None);
                device.destroy_pipeline_layout(made.layout, None);
                device.destroy_descriptor_set_layout(made.set_layout, None);
            }
        }
    }
}

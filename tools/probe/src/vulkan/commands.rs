//! Records commands and waits for them.

use super::{Gpu, Owned};
use crate::error::Error;
use ash::vk;
use std::sync::Arc;

/// A command buffer that is recorded again for each submission, and queries.
#[derive(Debug)]
pub(crate) struct Commands {
    gpu: Arc<Gpu>,
    queries: Owned<vk::QueryPool>,
    buffer: vk::CommandBuffer,
    _pool: Owned<vk::CommandPool>,
    count: u32,
}

impl Commands {
    /// A command buffer with `count` queries of this type.
    pub(crate) fn new(gpu: &Arc<Gpu>, queries: vk::QueryType, count: u32) -> Result<Self, Error> {
        let create = vk::CommandPoolCreateInfo::default()
            .queue_family_index(gpu.family)
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
        let calls = (ash::Device::create_command_pool as _, ash::Device::destroy_command_pool as _);
        // SAFETY: the device has this family.
        let pool = unsafe { Owned::new(gpu, "vkCreateCommandPool", calls, &create) }?;
        let allocate =
            vk::CommandBufferAllocateInfo::default().command_pool(*pool).command_buffer_count(1);
        // SAFETY: the pool is the device's.
        let buffers = unsafe { gpu.device.allocate_command_buffers(&allocate) }
            .map_err(Error::of("vkAllocateCommandBuffers"))?;
        let create = vk::QueryPoolCreateInfo::default().query_type(queries).query_count(count);
        let calls = (ash::Device::create_query_pool as _, ash::Device::destroy_query_pool as _);
        // SAFETY: the type is core, or that of an extension that the caller has made sure of.
        let queries = unsafe { Owned::new(gpu, "vkCreateQueryPool", calls, &create) }?;
        Ok(Self { gpu: Arc::clone(gpu), queries, buffer: buffers[0], _pool: pool, count })
    }

    /// The pool of queries; all are reset at the beginning of a submission.
    pub(crate) fn queries(&self) -> vk::QueryPool {
        *self.queries
    }

    /// Records the commands of `record`, submits them and waits for their end.
    ///
    /// # Errors
    /// The device is lost or out of memory.
    pub(crate) fn run(
        &self,
        record: impl FnOnce(&ash::Device, vk::CommandBuffer),
    ) -> Result<(), Error> {
        let device = &self.gpu.device;
        let begin = vk::CommandBufferBeginInfo::default()
            .flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the buffer is not in use, because the previous submission was waited for;
        // beginning resets it. The queries are the device's.
        unsafe {
            device
                .begin_command_buffer(self.buffer, &begin)
                .map_err(Error::of("vkBeginCommandBuffer"))?;
            device.cmd_reset_query_pool(self.buffer, *self.queries, 0, self.count);
        }
        record(device, self.buffer);
        let buffers = [self.buffer];
        let submit = [vk::SubmitInfo::default().command_buffers(&buffers)];
        // SAFETY: only this thread uses the queue, because `Prober` and `Bench` are not shared
        // between threads; everything that the commands use outlives the wait.
        unsafe {
            device.end_command_buffer(self.buffer).map_err(Error::of("vkEndCommandBuffer"))?;
            device
                .queue_submit(self.gpu.queue, &submit, vk::Fence::null())
                .map_err(Error::of("vkQueueSubmit"))?;
            device.queue_wait_idle(self.gpu.queue).map_err(Error::of("vkQueueWaitIdle"))
        }
    }

    /// The results of the queries, each as `N` 64-bit numbers.
    pub(crate) fn results<const N: usize>(&self) -> Result<Vec<[u64; N]>, Error> {
        let mut results = vec![[0; N]; self.count as usize];
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
        // SAFETY: the previous submission began and ended every query of the pool.
        unsafe { self.gpu.device.get_query_pool_results(*self.queries, 0, &mut results, flags) }
            .map_err(Error::of("vkGetQueryPoolResults"))?;
        Ok(results)
    }
}

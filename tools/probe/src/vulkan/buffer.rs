//! Buffers in memory near the host or the device.

use super::{Commands, Gpu, Owned};
use crate::error::Error;
use ash::vk;
use std::sync::Arc;

/// A buffer with its own memory.
#[derive(Debug)]
pub(crate) struct DeviceBuffer {
    gpu: Arc<Gpu>,
    pub(crate) handle: Owned<vk::Buffer>,
    memory: Owned<vk::DeviceMemory>,
    pub(crate) bytes: u64,
    is_mapped: bool,
}

impl DeviceBuffer {
    /// A buffer that the host reads and writes.
    pub(crate) fn shared(
        gpu: &Arc<Gpu>,
        bytes: u64,
        usage: vk::BufferUsageFlags,
    ) -> Result<Self, Error> {
        let visible =
            vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        // Reading uncached memory is slow.
        let cached = visible | vk::MemoryPropertyFlags::HOST_CACHED;
        Self::new(gpu, bytes, usage, &[cached, visible], true)
    }

    /// A buffer that only the device uses.
    pub(crate) fn local(
        gpu: &Arc<Gpu>,
        bytes: u64,
        usage: vk::BufferUsageFlags,
    ) -> Result<Self, Error> {
        let local = vk::MemoryPropertyFlags::DEVICE_LOCAL;
        Self::new(gpu, bytes, usage, &[local, vk::MemoryPropertyFlags::empty()], false)
    }

    /// A buffer that only the device uses, filled with these words.
    pub(crate) fn uploaded(
        gpu: &Arc<Gpu>,
        commands: &Commands,
        words: &[u32],
        usage: vk::BufferUsageFlags,
    ) -> Result<Self, Error> {
        let bytes = 4 * words.len() as u64;
        let staging = Self::shared(gpu, bytes, vk::BufferUsageFlags::TRANSFER_SRC)?;
        staging.write(words)?;
        let buffer = Self::local(gpu, bytes, usage | vk::BufferUsageFlags::TRANSFER_DST)?;
        let region = [vk::BufferCopy::default().size(bytes.max(4))];
        // SAFETY: the command buffer is being recorded; both buffers have this many bytes and
        // outlive the submission, which is waited for.
        commands.run(|device, to| unsafe {
            device.cmd_copy_buffer(to, *staging.handle, *buffer.handle, &region);
        })?;
        Ok(buffer)
    }

    /// Reads the first words of a buffer that only the device uses.
    pub(crate) fn download(&self, commands: &Commands, words: usize) -> Result<Vec<u32>, Error> {
        let bytes = 4 * words as u64;
        let staging = Self::shared(&self.gpu, bytes, vk::BufferUsageFlags::TRANSFER_DST)?;
        let region = [vk::BufferCopy::default().size(bytes)];
        // SAFETY: the command buffer is being recorded; both buffers have this many bytes and
        // outlive the submission, which is waited for.
        commands.run(|device, to| unsafe {
            device.cmd_copy_buffer(to, *self.handle, *staging.handle, &region);
        })?;
        staging.read(words)
    }

    fn new(
        gpu: &Arc<Gpu>,
        bytes: u64,
        usage: vk::BufferUsageFlags,
        wanted: &[vk::MemoryPropertyFlags],
        is_mapped: bool,
    ) -> Result<Self, Error> {
        let bytes = bytes.max(16).next_multiple_of(16);
        let create = vk::BufferCreateInfo::default().size(bytes).usage(usage);
        let calls = (ash::Device::create_buffer as _, ash::Device::destroy_buffer as _);
        // SAFETY: every device can make such buffers.
        let handle = unsafe { Owned::new(gpu, "vkCreateBuffer", calls, &create) }?;
        // SAFETY: the buffer is the device's.
        let needs = unsafe { gpu.device.get_buffer_memory_requirements(*handle) };
        let memory_type = wanted
            .iter()
            .find_map(|&wanted| memory_type(gpu, needs.memory_type_bits, wanted))
            .ok_or(Error::Missing("memory of the kind"))?;
        let allocate = vk::MemoryAllocateInfo::default()
            .allocation_size(needs.size)
            .memory_type_index(memory_type);
        let calls = (ash::Device::allocate_memory as _, ash::Device::free_memory as _);
        // SAFETY: the type is one of the device's.
        let memory = unsafe { Owned::new(gpu, "vkAllocateMemory", calls, &allocate) }?;
        // SAFETY: both are new, of this device, and the memory is as large as the buffer needs.
        unsafe { gpu.device.bind_buffer_memory(*handle, *memory, 0) }
            .map_err(Error::of("vkBindBufferMemory"))?;
        Ok(Self { gpu: Arc::clone(gpu), handle, memory, bytes, is_mapped })
    }

    /// Writes words at the beginning of the buffer.
    ///
    /// # Panics
    /// If the words do not fit, or the buffer is not shared.
    pub(crate) fn write(&self, words: &[u32]) -> Result<(), Error> {
        self.mapped(words.len(), |mapped| mapped.copy_from_slice(words))
    }

    /// Reads the first words.
    ///
    /// # Panics
    /// If the buffer has fewer words, or is not shared.
    pub(crate) fn read(&self, words: usize) -> Result<Vec<u32>, Error> {
        self.mapped(words, |mapped| mapped.to_vec())
    }

    fn mapped<T>(&self, words: usize, with: impl FnOnce(&mut [u32]) -> T) -> Result<T, Error> {
        assert!(self.is_mapped && 4 * words as u64 <= self.bytes, "words of a shared buffer");
        let flags = vk::MemoryMapFlags::empty();
        // SAFETY: the memory is visible to the host and not mapped: this is the only place that
        // maps it, and it unmaps it below.
        let start = unsafe { self.gpu.device.map_memory(*self.memory, 0, vk::WHOLE_SIZE, flags) }
            .map_err(Error::of("vkMapMemory"))?;
        // SAFETY: mapped memory is aligned to 64 bytes and as large as the buffer, and any bits are
        // words; the device does not use it, since each submission is waited for.
        let mapped = unsafe { std::slice::from_raw_parts_mut(start.cast::<u32>(), words) };
        let result = with(mapped);
        // SAFETY: it was mapped above, and no reference to it is left.
        unsafe { self.gpu.device.unmap_memory(*self.memory) };
        Ok(result)
    }
}

fn memory_type(gpu: &Gpu, among: u32, wanted: vk::MemoryPropertyFlags) -> Option<u32> {
    let types = (0..).zip(gpu.memory.memory_types_as_slice());
    let mut fitting =
        types.filter(|(number, ty)| among >> number & 1 == 1 && ty.property_flags.contains(wanted));
    fitting.next().map(|(number, _)| number)
}

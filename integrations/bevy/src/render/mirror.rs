//! Buffers of which only the changed words are written.

use bevy::render::render_resource::{Buffer, BufferDescriptor, BufferUsages};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use std::cell::Cell;
use std::ops::Range;

/// The device and queue for uploads, and the number of uploaded bytes.
pub(crate) struct Gpu<'a> {
    pub(crate) device: &'a RenderDevice,
    pub(crate) queue: &'a RenderQueue,
    pub(crate) uploaded: Cell<u64>,
}

/// A storage buffer that doubles when it is full; the device copies its contents. There is none at
/// first.
#[derive(Debug, Default)]
pub(crate) struct Growing(pub(crate) Option<Buffer>);

impl Growing {
    /// Writes words, beginning at word `at`. It is an error if they exceed one binding.
    pub(crate) fn write(&mut self, at: u32, words: &[u32], gpu: &Gpu<'_>) -> Result<(), String> {
        let end = 4 * (u64::from(at) + words.len() as u64);
        let buffer = self.with_room(end, gpu)?;
        gpu.queue.write_buffer(buffer, 4 * u64::from(at), bytemuck::cast_slice(words));
        gpu.uploaded.update(|bytes| bytes + 4 * words.len() as u64);
        Ok(())
    }

    fn with_room(&mut self, bytes: u64, gpu: &Gpu<'_>) -> Result<&Buffer, String> {
        let limits = gpu.device.limits();
        let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) / 4 * 4;
        if bytes > limit {
            return Err(format!(
                "surfaces take {bytes} bytes of a buffer, and the device binds {limit}; use less"
            ));
        }
        let old = self.0.take();
        if let Some(old) = old.as_ref().filter(|old| old.size() >= bytes) {
            return Ok(self.0.insert(old.clone()));
        }
        let size = bytes.max(1024).next_power_of_two().min(limit);
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        let (label, mapped_at_creation) = (Some("bevy_tess"), false);
        let new = BufferDescriptor { label, size, usage, mapped_at_creation };
        let new = self.0.insert(gpu.device.create_buffer(&new));
        if let Some(old) = old {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(&old, 0, new, 0, old.size());
            // Submitted at once, so that later writes come after the copy.
            gpu.queue.submit([encoder.finish()]);
        }
        Ok(new)
    }
}

/// A buffer, and a copy of its words.
#[derive(Debug, Default)]
pub(crate) struct Mirror {
    pub(crate) buffer: Growing,
    pub(crate) words: Vec<u32>,
}

/// Changed runs with fewer equal words than this between them are written as one, because a write
/// costs more than these words.
const APART: usize = 64;

impl Mirror {
    /// Writes the words that differ from those before, or are new.
    pub(crate) fn update(&mut self, words: Vec<u32>, gpu: &Gpu<'_>) -> Result<(), String> {
        for run in changed(&self.words, &words) {
            self.buffer.write(run.start as u32, &words[run], gpu)?;
        }
        self.words = words;
        Ok(())
    }
}

/// The runs of words that differ from the old ones, or are new.
pub(crate) fn changed(old: &[u32], new: &[u32]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for at in (0..new.len()).filter(|&at| old.get(at) != Some(&new[at])) {
        match runs.last_mut() {
            Some(run) if at - run.end < APART => run.end = at + 1,
            _ => runs.push(at..at + 1),
        }
    }
    runs
}
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_what_differs() {
        let old = vec![7; 200];
        let with = |places: &[usize]| {
            let mut new = old.clone();
            places.iter().for_each(|&at| new[at] = 8);
            changed(&old, &new).iter().map(|run| [run.start, run.end]).collect::<Vec<_>>()
        };
        assert_eq!(with(&[]).len(), 0, "nothing differs");
        assert_eq!(with(&[0, 2, 3]), [[0, 4]], "one word between them");
        assert_eq!(with(&[0, 64]), [[0, 65]], "63 words between them");
        assert_eq!(with(&[0, 65, 199]), [[0, 1], [65, 66], [199, 200]], "64 words between them");
    }
}

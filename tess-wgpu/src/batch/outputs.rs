//! The buffers that a batch reads and writes.

use tess_gpu::Capacity;

/// The place where a batch writes its output.
#[derive(Clone, Copy, Debug)]
pub enum Outputs<'a> {
    /// Nowhere: the batch only counts its output.
    CountOnly,
    /// Into these buffers, beginning at their first byte. If anything does not fit, nothing is
    /// written.
    Buffers {
        /// The domain points, 8 bytes each.
        points: &'a wgpu::Buffer,
        /// The indices, 2 or 4 bytes each. The size of the buffer is rounded down to a multiple of
        /// 8 bytes.
        indices: &'a wgpu::Buffer,
    },
    /// Only indices, for a vertex shader that computes its point ([`tess_gpu::Pull`]).
    Indices {
        /// The most points that the batch may have.
        points: u32,
        /// The indices, as in [`Outputs::Buffers`].
        indices: &'a wgpu::Buffer,
    },
    /// Only draw arguments, for a vertex shader that also computes its index. Their first four
    /// words are valid arguments for `draw_indirect`.
    Arguments(Capacity),
}

/// The patches that a batch reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patches<'a> {
    pub(crate) count: u32,
    /// The first patch of each group.
    pub(crate) groups: &'a [u32],
    pub(crate) factors: &'a wgpu::Buffer,
}

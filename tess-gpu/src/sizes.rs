//! Sizes of buffers and dispatches, as pure functions of the number of patches and the limits.
//!
//! A batch is cut into *chunks* of patches, because a device binds only so many bytes at once,
//! and its output into *windows* for the same reason. Within a window output is made in *tiles*.

use crate::layout::{DrawIndexed, Job, Range, Status, Topology};
use crate::setup::Setup;

/// Threads of the workgroups that expand a tile.
pub const WORKGROUP: u32 = 64;
/// Elements of a tile: points or primitives.
pub const TILE: u32 = 2048;
/// Patches of a tile that are expanded at a time.
pub const ROUND: u32 = 128;
/// Patches of a block, whose offsets one workgroup sums.
pub const BLOCK: u32 = 256;
/// Patches of a group, 256 blocks.
pub const GROUP: u32 = 256 * BLOCK;
/// The most patches of one chunk: 256 groups.
pub const MAX_CHUNK: u32 = 256 * GROUP;
/// Bytes between two jobs, and the alignment of everything that is bound with an offset.
pub const ALIGNMENT: u64 = 256;

/// What a device can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one storage binding, at least 4 MiB.
    pub storage_binding: u64,
    /// Workgroups along one dimension of a dispatch, at least 1.
    pub workgroups: u32,
}

impl Limits {
    /// The limits that every WebGPU device has.
    pub const WEBGPU: Self = Self { storage_binding: 128 << 20, workgroups: 65535 };
}

/// The room for a batch's output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Capacity {
    /// Points, 8 bytes each.
    pub points: u32,
    /// Primitives, 1 to 3 indices each.
    pub primitives: u32,
}

/// How one batch is cut up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    setup: Setup,
    patches: u32,
    capacity: Capacity,
    chunk_patches: u32,
    point_window_tiles: u32,
    primitive_window_tiles: u32,
    max_workgroups: u32,
}

/// Some bytes of a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Where they begin.
    pub offset: u64,
    /// How many they are.
    pub size: u64,
}

impl Plan {
    /// Cuts a batch so that no binding exceeds the limits.
    #[must_use]
    pub fn new(setup: Setup, patches: u32, capacity: Capacity, limits: Limits) -> Self {
        let context_bytes = 8 * u64::from(setup.factors());
        let bound = limits.storage_binding.max(4 << 20);
        let most = to_u32(bound / context_bytes).min(MAX_CHUNK) / GROUP * GROUP;
        let primitive_bytes = u64::from(setup.primitive_bytes());
        Self {
            setup,
            patches,
            capacity,
            chunk_patches: patches.max(1).checked_next_multiple_of(BLOCK).unwrap_or(most).min(most),
            point_window_tiles: to_u32(bound / (8 * u64::from(TILE))),
            primitive_window_tiles: to_u32(bound / (primitive_bytes * u64::from(TILE))),
            max_workgroups: limits.workgroups,
        }
    }

    /// Patches of the batch.
    #[must_use]
    pub const fn patches(&self) -> u32 {
        self.patches
    }

    /// How many chunks there are; 0 for no patches.
    #[must_use]
    pub const fn chunks(&self) -> u32 {
        self.patches.div_ceil(self.chunk_patches)
    }

    /// Patches of chunk `chunk`.
    #[must_use]
    pub fn patches_in(&self, chunk: u32) -> u32 {
        (self.patches - chunk * self.chunk_patches).min(self.chunk_patches)
    }

    /// How many windows the points have.
    #[must_use]
    pub const fn point_windows(&self) -> u32 {
        self.capacity.points.div_ceil(TILE).div_ceil(self.point_window_tiles)
    }

    /// How many windows the primitives have.
    #[must_use]
    pub const fn primitive_windows(&self) -> u32 {
        self.capacity.primitives.div_ceil(TILE).div_ceil(self.primitive_window_tiles)
    }

    /// The job of a chunk, its window not filled in.
    #[must_use]
    pub fn job(&self, chunk: u32) -> Job {
        let stride = self.chunk_patches;
        Job {
            patches: self.patches_in(chunk),
            first_patch: chunk * self.chunk_patches,
            ..self.batch_job(chunk, stride)
        }
    }

    /// The job of the stage `totals` in a batch of no patches, which has no chunks.
    #[must_use]
    pub fn empty_job(&self) -> Job {
        self.batch_job(0, self.chunk_patches)
    }

    fn batch_job(&self, chunk: u32, stride: u32) -> Job {
        Job {
            chunk,
            stride,
            blocks_at: stride,
            alike_at: stride + stride / BLOCK,
            groups_at: stride + 2 * (stride / BLOCK),
            primitive_tiles_at: self.capacity.points.div_ceil(TILE) + 2,
            chunks: self.chunks(),
            point_capacity: self.capacity.points,
            primitive_capacity: self.capacity.primitives,
            point_windows: self.point_windows(),
            primitive_windows: self.primitive_windows(),
            point_window_tiles: self.point_window_tiles,
            primitive_window_tiles: self.primitive_window_tiles,
            ..Job::default()
        }
    }

    /// The job of a chunk in a window of the points.
    #[must_use]
    pub fn point_job(&self, chunk: u32, window: u32) -> Job {
        let window_tiles = self.point_window_tiles;
        Job { window_first: window * window_tiles, window_tiles, ..self.job(chunk) }
    }

    /// The job of a chunk in a window of the primitives.
    #[must_use]
    pub fn primitive_job(&self, chunk: u32, window: u32) -> Job {
        let window_tiles = self.primitive_window_tiles;
        Job { window_first: window * window_tiles, window_tiles, ..self.job(chunk) }
    }

    /// The bytes of a chunk's raw factors in the caller's buffer.
    #[must_use]
    pub fn factors(&self, chunk: u32) -> Span {
        let each = 4 * u64::from(self.setup.factors());
        Span {
            offset: each * u64::from(chunk * self.chunk_patches),
            size: each * u64::from(self.patches_in(chunk)),
        }
    }

    /// The bytes of a chunk's topologies.
    #[must_use]
    pub fn topologies(&self, chunk: u32) -> Span {
        self.region(chunk, size::<Topology>() * u64::from(self.chunk_patches))
    }

    /// The bytes of a chunk's contexts: all of the first factor, then all of the second ...
    #[must_use]
    pub fn contexts(&self, chunk: u32) -> Span {
        self.region(chunk, 8 * u64::from(self.setup.factors()) * u64::from(self.chunk_patches))
    }

    /// The bytes of a chunk's offsets.
    #[must_use]
    pub fn offsets(&self, chunk: u32) -> Span {
        let blocks = self.chunk_patches / BLOCK;
        let entries = self.chunk_patches + 2 * blocks + blocks.div_ceil(256);
        self.region(chunk, 8 * u64::from(entries))
    }

    /// The entries of the buffer of offsets whose sum is where a patch's output begins: its own,
    /// its block's and its group's. Each is a number of points and one of primitives.
    #[must_use]
    pub fn offset_entries(&self, patch: u32) -> [u64; 3] {
        let job = self.job(patch / self.chunk_patches);
        let in_chunk = patch % self.chunk_patches;
        let first = self.offsets(job.chunk).offset / 8;
        [in_chunk, job.blocks_at + in_chunk / BLOCK, job.groups_at + in_chunk / GROUP]
            .map(|entry| first + u64::from(entry))
    }

    fn region(&self, chunk: u32, size: u64) -> Span {
        Span { offset: u64::from(chunk) * size.next_multiple_of(ALIGNMENT), size }
    }

    /// Bytes of the table of tiles, which the chunks use one after another.
    #[must_use]
    pub fn tiles_size(&self) -> u64 {
        let tiles = |elements: u32| u64::from(elements.div_ceil(TILE) + 2);
        4 * (tiles(self.capacity.points) + tiles(self.capacity.primitives))
    }

    /// Bytes of the status and the chunks' ranges.
    #[must_use]
    pub fn status_size(&self) -> u64 {
        size::<Status>() + size::<Range>() * u64::from(self.chunks().max(1))
    }

    /// Bytes of draw arguments and dispatch sizes.
    #[must_use]
    pub fn arguments_size(&self) -> u64 {
        self.arguments_at(self.chunks(), 0)
    }

    /// Where the size of a dispatch is in the arguments: of `slot` 0 the partition of `chunk`, of
    /// the following slots its windows of points, then its windows of primitives.
    #[must_use]
    pub fn arguments_at(&self, chunk: u32, slot: u32) -> u64 {
        const DISPATCHES_AT: u64 = 4 * 8;
        const { assert!(size_of::<DrawIndexed>() as u64 <= DISPATCHES_AT, "they don't overlap") };
        DISPATCHES_AT + 12 * (u64::from(chunk) * u64::from(self.slots()) + u64::from(slot))
    }

    fn slots(&self) -> u32 {
        1 + self.point_windows() + self.primitive_windows()
    }

    /// The bytes of a window of the points.
    #[must_use]
    pub fn point_window(&self, window: u32) -> Span {
        window_span(self.capacity.points, 8, self.point_window_tiles, window)
    }

    /// The bytes of a window of the indices.
    #[must_use]
    pub fn primitive_window(&self, window: u32) -> Span {
        let each = self.setup.primitive_bytes();
        window_span(self.capacity.primitives, each, self.primitive_window_tiles, window)
    }

    /// Workgroups of the stage `factors`.
    #[must_use]
    pub fn factors_workgroups(&self, chunk: u32) -> [u32; 3] {
        let workgroups = self.patches_in(chunk).div_ceil(BLOCK);
        let rows = workgroups.div_ceil(self.max_workgroups);
        [workgroups.min(self.max_workgroups), rows, 1]
    }

    /// Workgroups of the stage `scan`; `totals` is always one.
    #[must_use]
    pub fn scan_workgroups(&self, chunk: u32) -> [u32; 3] {
        [self.patches_in(chunk).div_ceil(GROUP), 1, 1]
    }
}

/// `capacity` elements of `each` bytes, cut into windows.
fn window_span(capacity: u32, each: u32, window_tiles: u32, window: u32) -> Span {
    let first = u64::from(window) * u64::from(window_tiles) * u64::from(TILE);
    let elements = (u64::from(capacity) - first).min(u64::from(window_tiles) * u64::from(TILE));
    let size = (elements * u64::from(each)).next_multiple_of(8);
    Span { offset: first * u64::from(each), size }
}

const fn size<T>() -> u64 {
    size_of::<T>() as u64
}

fn to_u32(value: u64) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

//! The plan of a batch: the sizes of its buffers and its dispatches, as pure functions of the
//! number of patches, the room for output and the limits. A host asks a [`Plan`] and computes
//! nothing itself.
//!
//! ```text
//! patches   |<-- portion 0 -->|<-- portion 1 -->|<-- portion 2 ->|    at most 2^24 patches, and their contexts
//!             section section   section section                      fit one binding
//!              block block ...                                       65536 and 256 patches, for the prefix sums
//!
//! output    |<---- window 0 ---->|<---- window 1 ---->|<- 2 ->|       points or indices that fit one binding
//!             tile tile tile ...                                     2048 elements, one workgroup
//! ```
//!
//! Portions and windows do not end at the same places, so each portion is expanded in every window.
//! A dispatch whose portion has no output in its window runs no workgroup. A job (`plan/jobs.rs`)
//! tells a dispatch its portion and window:
//!
//! ```text
//! jobs of portion 0: whole | points in window 0, 1 ... | primitives in window 0, 1 ... | jobs of portion 1: ...
//! ```
//!
//! The buffer of offsets has a region for each portion. An entry is two words: points and
//! primitives. A patch's output begins at the sum of three entries: its own, its block's and its
//! section's.
//!
//! ```text
//! entry   0 ..             blocks_at ..    alike_at ..                 sections_at ..
//!         each patch,      each block,     topology of a block,        each section,
//!         in its block     in its section  0 if its patches differ     in the batch
//! writer  factors          factors, scan   factors                     scan, totals
//! reader  expansions       expansions      shared/alike.wgsl           expansions
//! ```
//!
//! Invariants:
//! - A binding begins at a multiple of [`ALIGNMENT`], is within its buffer and keeps to the limits.
//!   The tiles, the arguments and the catalogue are bound whole; see [`Limits`] for the limits that
//!   suffice for them.
//! - A portion is a whole number of sections, or the whole batch.
//! - All portions are counted before any is expanded. Otherwise output that does not fit would be
//!   written in part.
//! - `shared/finish.wgsl` numbers the sizes of indirect dispatches as `job_number` does.
//!
//! A short batch has one portion, one window and narrow tiles, so that two dispatches do everything
//! (`entry_points/short_batch.wgsl`). The simpler form, one binding per buffer, would be limited to
//! 2.8 million quads with WebGPU's default limits, as the example of [`Plan`] shows.

use crate::bindings::Resource;
use crate::layout::{DrawIndexed, Range, Status, Topology};
use crate::room::{Capacity, Limits, Span};
use crate::setup::{IndexType, Numbering, Setup};
use crate::sizes::{
    ALIGNMENT, BLOCK, CATALOGUE_PATCHES, CATALOGUE_WORDS, DISPATCHES_AT, LEAST_TILE_BITS,
    MAX_PORTION, SECTION, SHORT_ELEMENTS, SHORT_PATCHES, SHORT_TILES, SUMMED, TILE_BITS,
};
use crate::tables;

mod dispatches;
mod jobs;

pub use dispatches::{Dispatch, Workgroups};

/// A batch, divided so that no binding and no dispatch exceeds the limits.
///
/// [`Plan::buffer_size`] has the sizes of the buffers that a host makes, [`Plan::jobs`] the
/// contents of one of them, and [`Plan::dispatches`] the dispatches that it runs.
///
/// Ten million quads with fractional factors have 48 bytes of contexts each, of which WebGPU's
/// default limits bind 128 MiB at once. That is 2796202 patches, or 42 whole sections of 65536:
///
/// ```
/// use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
/// use tess_gpu::{Capacity, Limits, Plan, Setup};
///
/// let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
/// let room = Capacity { points: 40_000_000, primitives: 40_000_000 };
/// let plan = Plan::new(Setup::new(Domain::Quad, config), 10_000_000, room, Limits::WEBGPU);
/// assert_eq!(plan.portion_patches(), 42 * 65536);
/// assert_eq!(plan.portions(), 4);
/// // A point has 8 bytes, a triangle three indices of 4; windows are whole tiles of 2048.
/// assert_eq!(plan.point_windows(), 3, "of 8192 tiles");
/// assert_eq!(plan.primitive_windows(), 4, "of 5461 tiles");
/// // For each portion: three dispatches to count, one to partition, then its windows; and `list`, once.
/// assert_eq!(plan.dispatches().count(), 4 * (3 + 1 + 3 + 4) + 1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    setup: Setup,
    patches: u32,
    groups: u32,
    capacity: Capacity,
    portion_patches: u32,
    point_window_tiles: u32,
    primitive_window_tiles: u32,
    max_workgroups: u32,
    tile_bits: u32,
    is_short: bool,
    written: Written,
}

/// The output that a batch writes. Shaders that need the rest compute it ([`crate::Pull`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Written {
    /// Points and indices.
    #[default]
    Everything,
    /// Only indices.
    Indices,
    /// Neither: the batch only makes draw arguments and, for each tile, the patch that it begins
    /// with.
    Arguments,
}

impl Plan {
    /// Plans a batch of `patches` patches with room for `capacity`. The room for points is limited
    /// to the points that the written indices can name: 65536 with [`IndexType::U16`] and
    /// [`Numbering::PerBatch`].
    #[must_use]
    pub fn new(setup: Setup, patches: u32, capacity: Capacity, limits: Limits) -> Self {
        Self::cut(Written::Everything, setup, patches, capacity, limits, true)
    }

    /// [`Plan::new`], but in the stages of a long batch whatever its size, so that a host needs
    /// only one path.
    #[must_use]
    pub fn in_long_stages(setup: Setup, patches: u32, capacity: Capacity, limits: Limits) -> Self {
        Self::cut(Written::Everything, setup, patches, capacity, limits, false)
    }

    /// Plans a batch that writes only some of its output, in the stages of a long batch. `capacity`
    /// limits the output that is drawn. Each of its tiles takes 4 bytes, even if the output is not
    /// written.
    ///
    /// The vertex shader binds the buffers of one portion, so the batch must have at most
    /// [`Plan::portion_patches`] patches.
    #[must_use]
    pub fn writing(
        written: Written,
        setup: Setup,
        patches: u32,
        capacity: Capacity,
        limits: Limits,
    ) -> Self {
        Self::cut(written, setup, patches, capacity, limits, false)
    }

    fn cut(
        written: Written,
        setup: Setup,
        patches: u32,
        capacity: Capacity,
        limits: Limits,
        may_be_short: bool,
    ) -> Self {
        let capacity =
            Capacity { points: capacity.points.min(most_points(setup, written)), ..capacity };
        let context_bytes = 8 * u64::from(setup.factors());
        let bound = limits.storage_binding.max(4 << 20);
        let most = to_u32(bound / context_bytes).min(MAX_PORTION) / SECTION * SECTION;
        let primitive_bytes = u64::from(setup.primitive_bytes());
        let is_short = may_be_short
            && is_short(patches, capacity)
            && u64::from(capacity.points) * 8 <= bound
            && u64::from(capacity.primitives) * primitive_bytes <= bound;
        let tile_bits = if is_short { narrow_tile_bits(capacity) } else { TILE_BITS };
        Self {
            setup,
            patches,
            groups: 0,
            capacity,
            portion_patches: patches
                .max(1)
                .checked_next_multiple_of(BLOCK)
                .unwrap_or(most)
                .min(most),
            point_window_tiles: to_u32((bound / 8) >> tile_bits),
            primitive_window_tiles: to_u32((bound / primitive_bytes) >> tile_bits),
            max_workgroups: limits.workgroups.max(1),
            tile_bits,
            is_short,
            written,
        }
    }

    /// The same batch with its patches in `groups` groups, each of which gets its own draw
    /// arguments ([`Resource::Groups`], [`Resource::Draws`]).
    #[must_use]
    pub const fn with_groups(mut self, groups: u32) -> Self {
        self.groups = groups;
        self
    }

    /// How many groups the patches are in; 0 without [`Plan::with_groups`].
    #[must_use]
    pub const fn groups(&self) -> u32 {
        self.groups
    }

    /// Whether the batch is short: it has at most 1024 patches and little room for output. Then two
    /// dispatches write all output: in the first, one workgroup does everything that precedes the
    /// expansion; the second is the expansion. False for [`Plan::in_long_stages`] and
    /// [`Plan::writing`].
    #[must_use]
    pub const fn is_short(&self) -> bool {
        self.is_short
    }

    /// Whether the batch has a catalogue of topologies: it has at least 16384 patches, its
    /// primitives are triangles, and it writes indices. The catalogue takes a fixed time, which is
    /// worth it for such batches.
    #[must_use]
    pub const fn has_catalogue(&self) -> bool {
        self.setup.has_triangles()
            && self.patches >= CATALOGUE_PATCHES
            && !matches!(self.written, Written::Arguments)
    }

    /// Elements of a tile: points or primitives.
    #[must_use]
    pub const fn tile(&self) -> u32 {
        1 << self.tile_bits
    }

    /// Patches of the batch.
    #[must_use]
    pub const fn patches(&self) -> u32 {
        self.patches
    }

    /// The most patches that a portion of this batch has.
    #[must_use]
    pub const fn portion_patches(&self) -> u32 {
        self.portion_patches
    }

    /// The number of portions; 0 if there are no patches.
    #[must_use]
    pub const fn portions(&self) -> u32 {
        self.patches.div_ceil(self.portion_patches)
    }

    /// The number of windows of the points; 0 if points are not written.
    #[must_use]
    pub const fn point_windows(&self) -> u32 {
        if !matches!(self.written, Written::Everything) {
            return 0;
        }
        self.capacity.points.div_ceil(self.tile()).div_ceil(self.point_window_tiles)
    }

    /// The number of windows of the primitives; 0 if indices are not written.
    #[must_use]
    pub const fn primitive_windows(&self) -> u32 {
        if matches!(self.written, Written::Arguments) {
            return 0;
        }
        self.capacity.primitives.div_ceil(self.tile()).div_ceil(self.primitive_window_tiles)
    }

    /// The size in bytes that the buffer of a resource needs for this batch. For the caller's own
    /// buffers (factors, points, indices) it is the number of bytes in use. A host rounds 0 up to
    /// the smallest size that its interface allows.
    #[must_use]
    pub fn buffer_size(&self, resource: Resource) -> u64 {
        let portions = self.portions().max(1);
        match resource {
            Resource::Job => ALIGNMENT * u64::from(self.job_count()),
            Resource::Factors => self.factor_bytes() * u64::from(self.patches),
            Resource::Tables => 4 * u64::from(tables::WORDS),
            Resource::Topologies => end(self.topologies(portions - 1)),
            Resource::Contexts => end(self.contexts(portions - 1)),
            Resource::Offsets => end(self.offsets(portions - 1)),
            Resource::Status => size::<Status>() + size::<Range>() * u64::from(portions),
            Resource::Tiles => 4 * u64::from(self.tile_entries()),
            Resource::Arguments => self.arguments_at(self.job_count()),
            // It is bound even if the batch has no catalogue and nothing reads it.
            Resource::Catalogue if self.has_catalogue() => 4 * u64::from(CATALOGUE_WORDS),
            Resource::Catalogue => ALIGNMENT,
            Resource::Groups => size::<u32>() * u64::from(self.groups),
            Resource::Draws => size::<DrawIndexed>() * u64::from(self.groups),
            Resource::Points if self.point_windows() == 0 => 0,
            Resource::Indices if self.primitive_windows() == 0 => 0,
            Resource::Points => 8 * u64::from(self.capacity.points),
            Resource::Indices => {
                let each = u64::from(self.setup.primitive_bytes());
                (each * u64::from(self.capacity.primitives)).next_multiple_of(8)
            }
        }
    }

    /// The three entries of the buffer of offsets whose sum is the beginning of a patch's output:
    /// the patch's, its block's and its section's. Each entry is a number of points and one of
    /// primitives.
    #[must_use]
    pub fn offset_entries(&self, patch: u32) -> [u64; 3] {
        let (portion, in_portion) = (patch / self.portion_patches, patch % self.portion_patches);
        let first = self.offsets(portion).offset / 8;
        [
            in_portion,
            self.blocks_at() + in_portion / BLOCK,
            self.sections_at() + in_portion / SECTION,
        ]
        .map(|entry| first + u64::from(entry))
    }

    /// The entry of the buffer of offsets with the common topology of the patches in `patch`'s
    /// block; it is 0 if they differ.
    #[must_use]
    pub fn alike_entry(&self, patch: u32) -> u64 {
        let (portion, in_portion) = (patch / self.portion_patches, patch % self.portion_patches);
        self.offsets(portion).offset / 8 + u64::from(self.alike_at() + in_portion / BLOCK)
    }

    /// Patches of portion `portion`.
    fn patches_in(&self, portion: u32) -> u32 {
        (self.patches - portion * self.portion_patches).min(self.portion_patches)
    }

    /// The first entry of the blocks in a portion's offsets, after one entry for each patch.
    const fn blocks_at(&self) -> u32 {
        self.portion_patches
    }

    /// The first entry of the blocks' common topologies in a portion's offsets.
    const fn alike_at(&self) -> u32 {
        self.blocks_at() + self.portion_patches / BLOCK
    }

    /// The first entry of the sections in a portion's offsets.
    const fn sections_at(&self) -> u32 {
        self.alike_at() + self.portion_patches / BLOCK
    }

    /// The first entry of the primitives in the table of tiles.
    const fn primitive_tiles_at(&self) -> u32 {
        self.capacity.points.div_ceil(self.tile()) + 2
    }

    /// Entries of the table of tiles.
    fn tile_entries(&self) -> u32 {
        self.primitive_tiles_at() + self.capacity.primitives.div_ceil(self.tile()) + 2
    }

    /// Bytes of one patch's raw factors.
    fn factor_bytes(&self) -> u64 {
        4 * u64::from(self.setup.factors())
    }

    /// The bytes of a portion's raw factors in the caller's buffer.
    fn factors(&self, portion: u32) -> Span {
        let bytes = |patches: u32| self.factor_bytes() * u64::from(patches);
        let first = portion * self.portion_patches;
        Span { offset: bytes(first), size: bytes(self.patches_in(portion)) }
    }

    /// The bytes of a portion's topologies.
    fn topologies(&self, portion: u32) -> Span {
        region(portion, size::<Topology>() * u64::from(self.portion_patches))
    }

    /// The bytes of a portion's contexts: all of the first factor, then all of the second, and so
    /// on.
    fn contexts(&self, portion: u32) -> Span {
        region(portion, 8 * u64::from(self.setup.factors()) * u64::from(self.portion_patches))
    }

    /// The bytes of a portion's offsets.
    fn offsets(&self, portion: u32) -> Span {
        let sections = self.portion_patches.div_ceil(BLOCK).div_ceil(SUMMED);
        region(portion, 8 * u64::from(self.sections_at() + sections))
    }

    /// The bytes of a window of the points.
    fn point_window(&self, window: u32) -> Span {
        self.window_span(self.capacity.points, 8, self.point_window_tiles, window)
    }

    /// The bytes of a window of the indices.
    fn primitive_window(&self, window: u32) -> Span {
        let each = self.setup.primitive_bytes();
        self.window_span(self.capacity.primitives, each, self.primitive_window_tiles, window)
    }

    /// `capacity` elements of `each` bytes, cut into windows.
    fn window_span(&self, capacity: u32, each: u32, window_tiles: u32, window: u32) -> Span {
        let most = u64::from(window_tiles) * u64::from(self.tile());
        let first = u64::from(window) * most;
        let elements = (u64::from(capacity) - first).min(most);
        let size = (elements * u64::from(each)).next_multiple_of(8);
        Span { offset: first * u64::from(each), size }
    }

    /// The offset in the arguments of the size of the indirect dispatch with job `job`.
    fn arguments_at(&self, job: u32) -> u64 {
        4 * u64::from(DISPATCHES_AT) + 12 * u64::from(job)
    }

    /// Workgroups along x, y and z, in rows no longer than the limit.
    fn in_rows(&self, workgroups: u32) -> [u32; 3] {
        let rows = workgroups.div_ceil(self.max_workgroups);
        [workgroups.min(self.max_workgroups), rows, 1]
    }
}

/// The most points of a batch that its indices can name.
const fn most_points(setup: Setup, written: Written) -> u32 {
    match (setup.index_type, setup.numbering, written) {
        (_, _, Written::Arguments) | (IndexType::U32, ..) | (_, Numbering::PerPatch, _) => u32::MAX,
        (IndexType::U16, Numbering::PerBatch, _) => 1 << 16,
    }
}

/// See [`Plan::is_short`]. The caller checks that the output fits one binding.
fn is_short(patches: u32, capacity: Capacity) -> bool {
    let has_output = capacity.points > 0 && capacity.primitives > 0;
    (1..=SHORT_PATCHES).contains(&patches)
        && (has_output || capacity == Capacity::default())
        && capacity.points.saturating_add(capacity.primitives) <= SHORT_ELEMENTS
}

/// The size of a short batch's tiles as a power of two.
fn narrow_tile_bits(capacity: Capacity) -> u32 {
    let elements = u64::from(capacity.points) + u64::from(capacity.primitives);
    let tile = elements.div_ceil(u64::from(SHORT_TILES)).next_power_of_two();
    tile.ilog2().clamp(LEAST_TILE_BITS, TILE_BITS)
}

/// The bytes of a portion in a buffer that has `size` bytes for each portion.
fn region(portion: u32, size: u64) -> Span {
    Span { offset: u64::from(portion) * size.next_multiple_of(ALIGNMENT), size }
}

const fn end(span: Span) -> u64 {
    span.offset + span.size
}

const fn size<T>() -> u64 {
    size_of::<T>() as u64
}

fn to_u32(value: u64) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

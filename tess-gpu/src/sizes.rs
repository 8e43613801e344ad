//! Sizes that host and shaders agree on, and the limits and room that a batch is planned for.

use crate::layout::DrawIndexed;
use crate::setup::Setup;
use tess_core::{Patch, PatchFactors};

/// Threads of a workgroup that expands a tile, partitions tiles or runs probes.
pub const WORKGROUP: u32 = 64;
/// Threads of a workgroup that expands points: a tile of unlike patches waits less with more of them.
pub const POINT_THREADS: u32 = 128;
/// Elements of a tile, points or primitives, unless the batch is small.
pub const TILE: u32 = 1 << TILE_BITS;
/// As a power of two.
pub const TILE_BITS: u32 = 11;
/// A small batch has smaller tiles, so that many workgroups share its output, down to 2^7 elements: two for each
/// thread.
pub const LEAST_TILE_BITS: u32 = 7;
/// Patches of a tile that are expanded together.
pub const ROUND: u32 = 128;
/// Numbers that one workgroup sums, one for each thread: patches of a block, blocks of a section,
/// sections of a chunk.
pub const SUMMED: u32 = 256;
/// Patches of a block.
pub const BLOCK: u32 = SUMMED;
/// Blocks of a section.
pub const SECTION_BLOCKS: u32 = SUMMED;
/// Patches of a section.
pub const SECTION: u32 = SECTION_BLOCKS * BLOCK;
/// The most patches of a chunk.
pub const MAX_CHUNK: u32 = SUMMED * SECTION;
/// A batch of so many patches at most is small: one workgroup does everything in front of the expansions.
pub const SMALL_PATCHES: u32 = 1024;
/// A small batch has room for so many points and primitives at most, together.
pub const SMALL_ELEMENTS: u32 = 1 << 19;
/// A small batch is cut into so many tiles at most, one for each workgroup that runs at once on a large device.
pub const SMALL_TILES: u32 = 2048;
/// A batch of so many patches has a catalogue of topologies.
pub const CATALOGUE_PATCHES: u32 = 16 << 10;
/// Slots of the catalogue of topologies, as a power of two.
pub const SLOT_BITS: u32 = 13;
/// Slots of the catalogue: it can hold so many topologies, or somewhat fewer.
pub const SLOTS: u32 = 1 << SLOT_BITS;
/// Points for which the catalogue has room.
pub const CATALOGUE_POINTS: u32 = 1 << 17;
/// Triangles for which the catalogue has room.
pub const CATALOGUE_TRIANGLES: u32 = 1 << 18;
/// The most points of a topology in the catalogue; 1024 could be packed.
pub const LISTED_POINTS: u32 = 512;
/// The most triangles of a topology in the catalogue.
pub const LISTED_PRIMITIVES: u32 = 512;
/// The word of the catalogue where its two counters are, behind the keys of all slots.
pub const USED_AT: u32 = SLOTS;
/// The word of the catalogue where the places of each slot's points and triangles begin.
pub const PLACES_AT: u32 = USED_AT + 2;
/// The word of the catalogue where its points begin, up to two words each.
pub const POINTS_AT: u32 = PLACES_AT + 2 * SLOTS;
/// The word of the catalogue where its triangles begin, a word each.
pub const TRIANGLES_AT: u32 = POINTS_AT + 2 * CATALOGUE_POINTS;
/// Words of the catalogue.
pub const CATALOGUE_WORDS: u32 = TRIANGLES_AT + CATALOGUE_TRIANGLES;
/// Entries of 8 bytes in the workgroup memory of the stage `expand_points`: a tile's patches are
/// copies of one if it has at most so many points. That is a quad of factor 16, and some more.
pub const POINT_SCRATCH: u32 = 320;
/// The same of the stage `expand_primitives`; each entry has room for two triangles.
pub const PRIMITIVE_SCRATCH: u32 = ROUND;
/// The word of the arguments buffer where the dispatch sizes begin, behind the draw arguments.
pub const DISPATCHES_AT: u32 = 8;
/// Bytes between two jobs, and the alignment of everything that is bound with an offset.
pub const ALIGNMENT: u64 = 256;

const _: () = {
    assert!(SMALL_PATCHES < CATALOGUE_PATCHES, "a small batch has no catalogue");
    assert!(ROUND <= POINT_SCRATCH && ROUND <= PRIMITIVE_SCRATCH, "it holds a round's topologies");
    // alike.wgsl divides by multiplying, which is exact for patches of so many elements.
    assert!(2 * POINT_SCRATCH <= 640 && 2 * PRIMITIVE_SCRATCH <= 640, "the division is exact");
    assert!(size_of::<DrawIndexed>() <= 4 * DISPATCHES_AT as usize, "they don't overlap");
};

/// What a device can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of one storage binding: at least 128 MiB. A smaller limit, down to 4 MiB, is kept except
    /// for the tiles, the arguments and the catalogue of the largest batches.
    pub storage_binding: u64,
    /// Workgroups along one dimension of a dispatch: at least 2048. Larger dispatches are laid out
    /// in rows of so many. A smaller limit, down to 1, is kept along x but not along y.
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

impl Capacity {
    /// What so many patches need at most, whatever their factors: up to 4225 points and 8192 primitives
    /// each, and 2^32 - 1 together.
    #[must_use]
    pub fn worst_case(setup: Setup, patches: u32) -> Self {
        Self::uniform(setup, patches, 64.0)
    }

    /// What so many patches need if all of their factors are `factor`. More factors than one never
    /// need more than the largest of them.
    #[must_use]
    pub fn uniform(setup: Setup, patches: u32, factor: f32) -> Self {
        let counts = Patch::new(setup.config, PatchFactors::uniform(setup.domain, factor)).counts();
        Self {
            points: counts.points.saturating_mul(patches),
            primitives: counts.primitives.saturating_mul(patches),
        }
    }
}

/// Some bytes of a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Offset of the first byte.
    pub offset: u64,
    /// Number of bytes.
    pub size: u64,
}

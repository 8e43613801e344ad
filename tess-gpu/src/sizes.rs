//! The sizes that host and shaders share.

use crate::layout::DrawIndexed;

/// Threads of a workgroup that expands a tile of primitives, partitions tiles, lists topologies or
/// serves a tap.
pub const WORKGROUP: u32 = 64;
/// Threads of a workgroup that expands points. More threads wait less on a tile of patches that
/// differ.
pub(crate) const POINT_THREADS: u32 = 128;
/// Elements of a tile, points or primitives, unless the batch is short.
pub const TILE: u32 = 1 << TILE_BITS;
/// [`TILE`] as a power of two.
pub(crate) const TILE_BITS: u32 = 11;
/// The size of the narrowest tile, as a power of two: 2 elements per thread. A short batch has
/// narrow tiles, so that many workgroups share its output.
pub(crate) const LEAST_TILE_BITS: u32 = 7;
/// Patches of a tile that are expanded together.
pub(crate) const ROUND: u32 = 128;
/// Numbers that one workgroup sums, one for each thread: patches of a block, blocks of a section,
/// sections of a portion.
pub(crate) const SUMMED: u32 = 256;
/// Patches of a block.
pub const BLOCK: u32 = SUMMED;
pub(crate) const BLOCK_BITS: u32 = BLOCK.ilog2();
/// Blocks of a section.
pub(crate) const SECTION_BLOCKS: u32 = SUMMED;
pub(crate) const SECTION_BLOCK_BITS: u32 = SECTION_BLOCKS.ilog2();
/// Patches of a section.
pub const SECTION: u32 = SECTION_BLOCKS * BLOCK;
pub(crate) const SECTION_BITS: u32 = SECTION.ilog2();
/// The most patches of a portion.
pub(crate) const MAX_PORTION: u32 = SUMMED * SECTION;
/// The most patches of a short batch, for which one workgroup does everything that precedes the
/// expansion.
pub const SHORT_PATCHES: u32 = 1024;
/// The most room of a short batch, points and primitives together.
pub const SHORT_ELEMENTS: u32 = 1 << 19;
/// About the most tiles of a short batch: one for each workgroup that runs at once on a large
/// device.
pub(crate) const SHORT_TILES: u32 = 2048;
/// The fewest patches of a batch with a catalogue of topologies.
pub const CATALOGUE_PATCHES: u32 = 16 << 10;
/// Slots of the catalogue of topologies, as a power of two.
pub(crate) const SLOT_BITS: u32 = 13;
/// Slots of the catalogue, one for each topology. It holds somewhat fewer topologies, because a
/// search ends after 16 slots.
pub(crate) const SLOTS: u32 = 1 << SLOT_BITS;
/// Points for which the catalogue has room.
pub(crate) const CATALOGUE_POINTS: u32 = 1 << 17;
/// Triangles for which the catalogue has room.
pub(crate) const CATALOGUE_TRIANGLES: u32 = 1 << 18;
/// The most points of a topology in the catalogue. The packed format would allow 1024.
pub(crate) const LISTED_POINTS: u32 = 512;
/// The most triangles of a topology in the catalogue.
pub(crate) const LISTED_PRIMITIVES: u32 = 512;
/// The word of the catalogue where its two counters are, after the keys of all slots.
pub(crate) const USED_AT: u32 = SLOTS;
/// The word of the catalogue where the places of each slot's points and triangles begin.
pub(crate) const PLACES_AT: u32 = USED_AT + 2;
/// The word of the catalogue where its points begin, up to two words each.
pub(crate) const POINTS_AT: u32 = PLACES_AT + 2 * SLOTS;
/// The word of the catalogue where its triangles begin, one word each.
pub(crate) const TRIANGLES_AT: u32 = POINTS_AT + 2 * CATALOGUE_POINTS;
/// Words of the catalogue.
pub(crate) const CATALOGUE_WORDS: u32 = TRIANGLES_AT + CATALOGUE_TRIANGLES;
/// Entries of 8 bytes in the workgroup memory of the stage `expand_points`: also the most points of
/// a patch that is copied. A quad of factor 16 has 289.
pub(crate) const POINT_SCRATCH: u32 = 320;
/// The same for the stage `expand_primitives`, where an entry has room for two triangles.
pub(crate) const PRIMITIVE_SCRATCH: u32 = ROUND;
/// The word of the arguments buffer where the dispatch sizes begin, after the draw arguments.
pub(crate) const DISPATCHES_AT: u32 = 8;
/// Bytes between two jobs, and the alignment of everything that is bound with an offset.
pub const ALIGNMENT: u64 = 256;

const _: () = {
    assert!(SHORT_PATCHES < CATALOGUE_PATCHES, "a short batch has no catalogue");
    assert!(ROUND <= POINT_SCRATCH && ROUND <= PRIMITIVE_SCRATCH, "it holds a round's topologies");
    // shared/alike.wgsl divides by multiplying, which is exact for patches of so many elements.
    assert!(2 * POINT_SCRATCH <= 640 && 2 * PRIMITIVE_SCRATCH <= 640, "the division is exact");
    assert!(size_of::<DrawIndexed>() <= 4 * DISPATCHES_AT as usize, "they don't overlap");
};

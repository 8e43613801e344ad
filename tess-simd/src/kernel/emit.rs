//! Blocks of patches into buffers.

use crate::block::{Block, BlockPatch};
use crate::connect;
use crate::format::{IndexFormat, PointFormat};
use crate::lanes::LANES;
use crate::level::Level;
use crate::output::{Numbering, PatchRange};
use crate::points::{self, Code, Coordinates, LocationTables};
use crate::setup::Setup;
use crate::template::{SmallTemplate, SmallTemplates, Templates};
use crate::writer::Writer;
use alloc::boxed::Box;
use tess_core::{Config, DomainPoint};

/// Blocks to write.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocks<'a> {
    pub(crate) blocks: &'a [Block],
    pub(crate) first: Offsets,
    pub(crate) numbering: Numbering,
}

/// Where blocks are written.
#[derive(Debug)]
pub(crate) struct Room<'a, P, I> {
    /// At least as long as the blocks' output. What follows that may be overwritten.
    pub(crate) points: &'a mut [P],
    /// As `points`.
    pub(crate) indices: &'a mut [I],
    /// As long as there are patches; the blocks may have more lanes than that.
    pub(crate) ranges: &'a mut [PatchRange],
}

/// The output of a batch before some patch of it: where that patch's output begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Offsets {
    pub(crate) points: u32,
    pub(crate) indices: u32,
}

/// What is kept from patch to patch and from batch to batch. All of it follows from the
/// configuration and the patches' factors.
#[derive(Clone, Debug)]
pub(crate) struct Caches {
    tables: Box<LocationTables>,
    templates: Templates,
    small: SmallTemplates,
    /// What the points of a block's small patches are made of.
    coordinates: Box<[Coordinates; LANES]>,
}

impl Caches {
    pub(crate) fn new(config: Config) -> Self {
        Self {
            tables: Box::new(LocationTables::EMPTY),
            templates: Templates::new(),
            small: SmallTemplates::new(config),
            coordinates: Box::new([const { Coordinates::EMPTY }; LANES]),
        }
    }

    /// Bytes of memory that they take on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<LocationTables>()
            + self.templates.bytes()
            + self.small.bytes()
            + size_of_val(&*self.coordinates)
    }
}

/// Writers of both kinds of output.
struct Writers<'a, P, I> {
    points: Writer<'a, P>,
    indices: Writer<'a, I>,
}

/// Writes blocks; returns where their output ends in the batch.
#[inline(always)]
pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
    setup: &Setup,
    blocks: Blocks<'_>,
    room: Room<'_, P, I>,
    caches: &mut Caches,
) -> Offsets {
    let Blocks { blocks, mut first, numbering } = blocks;
    let mut out = Writers { points: Writer::new(room.points), indices: Writer::new(room.indices) };
    let zero = core::hint::black_box(0);
    for (block, ranges) in blocks.iter().zip(room.ranges.chunks_mut(LANES)) {
        // All of them first: what is read too soon after it was written waits for it.
        for (lane, coordinates) in caches.coordinates.iter_mut().enumerate().take(ranges.len()) {
            let patch = block.patch(lane);
            if looked_up(setup, patch) {
                coordinates.fill::<P>(patch, zero);
            }
        }
        for (lane, range) in ranges.iter_mut().enumerate() {
            let patch = block.patch(lane);
            *range = PatchRange {
                first_point: first.points,
                points: patch.points(),
                first_index: first.indices,
                indices: patch.indices(),
            };
            let base = numbering.base(first.points);
            first.points += range.points;
            first.indices += range.indices;
            if range.points == 0 {
                continue;
            }
            if looked_up(setup, patch) || (patch.is_small() && patch.integer()) {
                emit_small(setup, (patch, lane), base, caches, &mut out);
            } else {
                emit_patch(setup, patch, base, caches, &mut out);
            }
        }
    }
    first
}

/// Whether a patch's points are looked up. It pays with gathers, and until runs of points become
/// long; below AVX-512 terrains of such patches took a seventh longer.
#[inline(always)]
fn looked_up(setup: &Setup, patch: BlockPatch<'_>) -> bool {
    const MOST_POINTS: u32 = 64;
    setup.level == Level::Avx512
        && patch.is_small()
        && !patch.integer()
        && patch.points() <= MOST_POINTS
}

/// Writes a small patch that is not culled and whose first point is number `base`.
#[inline(always)]
fn emit_small<P: PointFormat, I: IndexFormat>(
    setup: &Setup,
    (patch, lane): (BlockPatch<'_>, usize),
    base: u32,
    caches: &mut Caches,
    out: &mut Writers<'_, P, I>,
) {
    let Caches { tables, small, coordinates, .. } = caches;
    let SmallTemplate { indices, points, codes } = small.get(setup, patch, tables);
    let count = patch.points() as usize;
    if patch.integer() {
        out.points.map::<_, 8>(count, points, |point: DomainPoint| {
            P::from_bits(point.u.to_bits(), point.v.to_bits())
        });
    } else {
        let coordinates = &coordinates[lane % LANES];
        out.points.map::<_, 8>(count, codes, |code: Code| coordinates.point::<P>(code));
    }
    let base = I::wrapping_from(base);
    out.indices.map_least::<_, 16, 64>(patch.indices() as usize, indices, |index: u8| {
        base.wrapping_add(I::wrapping_from(index.into()))
    });
}

/// Writes any other patch that is not culled and whose first point is number `base`.
#[inline(always)]
fn emit_patch<P: PointFormat, I: IndexFormat>(
    setup: &Setup,
    patch: BlockPatch<'_>,
    base: u32,
    caches: &mut Caches,
    out: &mut Writers<'_, P, I>,
) {
    let Caches { tables, templates, .. } = caches;
    let Some(template) = templates.get(setup, patch, tables) else {
        points::emit(patch, tables, &mut out.points);
        connect::emit(setup, patch, base, &mut out.indices);
        return;
    };
    if let Some(template) = template.points {
        out.points.map::<_, 8>(patch.points() as usize, template, |point: DomainPoint| {
            P::from_bits(point.u.to_bits(), point.v.to_bits())
        });
    } else {
        points::emit(patch, tables, &mut out.points);
    }
    let base = I::wrapping_from(base);
    out.indices.map_least::<_, 16, 128>(
        patch.indices() as usize,
        template.indices,
        |index: u16| base.wrapping_add(I::wrapping_from(index.into())),
    );
}

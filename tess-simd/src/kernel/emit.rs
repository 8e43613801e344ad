//! Blocks of patches into buffers.

use crate::block::{Block, BlockPatch};
use crate::connect::{self, drawing};
use crate::format::{IndexFormat, PointFormat};
use crate::lanes::LANES;
use crate::output::{Numbering, PatchRange};
use crate::points::{self, LocationTables, SmallPoints};
use crate::setup::Setup;
use crate::template::{SmallTemplate, SmallTemplates, Start, Templates, long};
use crate::writer::Writer;
use alloc::boxed::Box;
use tess_core::DomainPoint;

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
}

impl Caches {
    pub(crate) fn new() -> Self {
        Self {
            tables: Box::new(LocationTables::EMPTY),
            templates: Templates::new(),
            small: SmallTemplates::new(),
        }
    }

    /// Bytes of memory that they take on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<LocationTables>() + self.templates.bytes() + self.small.bytes()
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
    small_points: &mut impl SmallPoints<P>,
) -> Offsets {
    let Blocks { blocks, mut first, numbering } = blocks;
    let mut out = Writers { points: Writer::new(room.points), indices: Writer::new(room.indices) };
    for (block, ranges) in blocks.iter().zip(room.ranges.chunks_mut(LANES)) {
        for (lane, range) in ranges.iter_mut().enumerate() {
            let patch = block.patch(lane);
            *range = PatchRange {
                first_point: first.points,
                points: patch.points(),
                first_index: first.indices,
                indices: patch.indices(),
            };
            first.points += range.points;
            first.indices += range.indices;
        }
        caches.small.make_room();
        if block.all_small() {
            emit_small(setup, (block, ranges), numbering, caches, &mut out, small_points);
            continue;
        }
        for (lane, range) in ranges.iter().enumerate().filter(|(_, range)| range.points != 0) {
            let patch = block.patch(lane);
            let base = numbering.base(range.first_point);
            if patch.is_small() {
                let start = caches.small.find(setup, patch, &mut caches.tables);
                let template = caches.small.get(start);
                points_of(patch, template, &mut out.points, small_points);
                indices_of(patch, template, base, &mut out.indices);
            } else {
                emit_patch(setup, patch, base, caches, &mut out);
            }
        }
    }
    first
}

/// Writes a block of small patches, stage by stage: where a stage's branches are predicted wrongly, the
/// patches of the others are not begun anew.
#[inline(always)]
fn emit_small<P: PointFormat, I: IndexFormat>(
    setup: &Setup,
    (block, ranges): (&Block, &[PatchRange]),
    numbering: Numbering,
    caches: &mut Caches,
    out: &mut Writers<'_, P, I>,
    small_points: &mut impl SmallPoints<P>,
) {
    let Caches { small, tables, .. } = caches;
    let mut starts = [Start::default(); LANES];
    let lanes = ranges.iter().enumerate().filter(|(_, range)| range.points != 0);
    for (lane, _) in lanes.clone() {
        starts[lane] = small.find(setup, block.patch(lane), tables);
    }
    for (lane, _) in lanes.clone() {
        let template = small.get(starts[lane]);
        points_of(block.patch(lane), template, &mut out.points, small_points);
    }
    for (lane, range) in lanes {
        let base = numbering.base(range.first_point);
        indices_of(block.patch(lane), small.get(starts[lane]), base, &mut out.indices);
    }
}

/// Writes the points of a small patch.
#[inline(always)]
fn points_of<P: PointFormat>(
    patch: BlockPatch<'_>,
    SmallTemplate { points, .. }: SmallTemplate<'_>,
    out: &mut Writer<'_, P>,
    small_points: &mut impl SmallPoints<P>,
) {
    if patch.integer() {
        out.map_least::<_, 8, 24>(patch.points() as usize, points, long);
    } else {
        small_points.emit(patch, points, out);
    }
}

/// Writes the indices of a small patch whose first point is number `base`.
#[inline(always)]
fn indices_of<I: IndexFormat>(
    patch: BlockPatch<'_>,
    SmallTemplate { indices, .. }: SmallTemplate<'_>,
    base: u32,
    out: &mut Writer<'_, I>,
) {
    let base = I::wrapping_from(base);
    out.map_least::<_, 16, 64>(patch.indices() as usize, indices, |index: u8| {
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
    let add = I::wrapping_from(base);
    let add = |index: u16| add.wrapping_add(I::wrapping_from(index.into()));
    let Some(template) = templates.get(setup, patch, tables) else {
        points::emit(patch, tables, &mut out.points);
        if drawing::reorders(setup, patch) {
            drawing::emit(setup, patch, templates.specified(setup, patch), &mut out.indices, add);
        } else {
            connect::emit(setup, patch, base, &mut out.indices);
        }
        return;
    };
    if let Some(template) = template.points {
        out.points.map::<_, 8>(patch.points() as usize, template, |point: DomainPoint| {
            P::from_bits(point.u.to_bits(), point.v.to_bits())
        });
    } else {
        points::emit(patch, tables, &mut out.points);
    }
    out.indices.map_least::<_, 16, 128>(patch.indices() as usize, template.indices, add);
}

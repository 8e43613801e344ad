//! One thread's share of a batch: counting it, and writing it.

use crate::batch::{Batch, Chunk};
use crate::block::{BLOCKS, Block};
use crate::connect;
use crate::dispatch;
use crate::emit::Writer;
use crate::format::{Call, IndexFormat, PointFormat};
use crate::lanes::LANES;
use crate::level::Level;
use crate::output::{Buffers, Numbering, PatchRange};
use crate::points::{self, LocationTables};
use crate::stitch::Stitches;
use crate::template::Templates;
use alloc::boxed::Box;
use tess_core::{Config, DomainPoint};

/// Output sizes of a part of a batch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PartCounts {
    pub(crate) points: u64,
    pub(crate) indices: u64,
    /// Points of its largest patch.
    pub(crate) largest: u32,
}

impl PartCounts {
    /// What its output amounts to, in bytes of the widest formats.
    #[cfg(feature = "rayon")]
    pub(crate) fn weight(&self) -> u64 {
        8 * self.points + 4 * self.indices
    }

    /// The counts of two parts together.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            points: self.points + other.points,
            indices: self.indices + other.indices,
            largest: self.largest.max(other.largest),
        }
    }
}

/// What a thread keeps from batch to batch. All of it depends on the configuration alone, but for
/// the blocks, which are those at hand. Two threads' workspaces share no cache lines.
#[derive(Clone, Debug)]
#[repr(align(128))]
pub(crate) struct Workspace {
    blocks: Box<[Block; BLOCKS]>,
    tables: Box<LocationTables>,
    templates: Templates,
}

impl Workspace {
    pub(crate) fn new() -> Self {
        Self {
            blocks: Box::new([Block::EMPTY; BLOCKS]),
            tables: Box::new(LocationTables::EMPTY),
            templates: Templates::new(),
        }
    }

    /// Bytes of memory that it takes.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<[Block; BLOCKS]>() + size_of::<LocationTables>() + self.templates.bytes()
    }
}

/// Consecutive patches of a batch and where their output goes.
#[derive(Debug)]
pub(crate) struct Part<'a, P, I> {
    pub(crate) batch: Batch<'a>,
    pub(crate) buffers: Buffers<'a, P, I>,
    /// Points and indices of the batch before this part.
    pub(crate) first: (u32, u32),
    pub(crate) numbering: Numbering,
}

/// Predicts the output sizes of patches.
#[inline(always)]
pub(crate) fn count(config: Config, batch: &Batch<'_>) -> PartCounts {
    let (mut points, mut indices, mut largest) = ([0; LANES], [0; LANES], [0; LANES]);
    let mut chunk = Chunk::EMPTY;
    for first in (0..batch.len()).step_by(Chunk::PATCHES) {
        chunk.load(batch, first);
        for number in 0..(batch.len() - first).div_ceil(LANES).min(BLOCKS) {
            let counts = Block::new(config, batch.domain(), &chunk.block(number)).counts;
            for lane in 0..LANES {
                points[lane] += u64::from(counts.points[lane]);
                indices[lane] += u64::from(counts.indices[lane]);
                largest[lane] = counts.points[lane].max(largest[lane]);
            }
        }
    }
    PartCounts {
        points: points.into_iter().sum(),
        indices: indices.into_iter().sum(),
        largest: largest.into_iter().max().unwrap_or(0),
    }
}

/// Writes patches to buffers whose sizes are exactly those that [`count`] predicts.
pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
    (level, config): (Level, Config),
    stitches: &Stitches,
    part: Part<'_, P, I>,
    workspace: &mut Workspace,
) {
    let Part { batch, buffers, mut first, numbering } = part;
    let (mut points, mut indices) = (buffers.points, buffers.indices);
    for (number, ranges) in buffers.ranges.chunks_mut(Chunk::PATCHES).enumerate() {
        let chunk = number * Chunk::PATCHES;
        dispatch::process_blocks(level, config, &batch, chunk, &mut workspace.blocks);
        let buffers = Buffers { points: &mut *points, indices: &mut *indices, ranges };
        let blocks = Blocks { buffers, first, numbering, workspace };
        let end = I::emit(Call { level, config, stitches, blocks });
        points = points.split_at_mut((end.0 - first.0) as usize).1;
        indices = indices.split_at_mut((end.1 - first.1) as usize).1;
        first = end;
    }
    debug_assert!(points.is_empty(), "the points were counted");
    debug_assert!(indices.is_empty(), "the indices were counted");
}

/// The blocks of a workspace, and where their output goes and may overrun.
#[derive(Debug)]
pub(crate) struct Blocks<'a, P, I> {
    buffers: Buffers<'a, P, I>,
    /// Points and indices of the batch before these blocks.
    first: (u32, u32),
    numbering: Numbering,
    workspace: &'a mut Workspace,
}

/// Writes blocks, as many patches as there are ranges; returns the points and indices of the batch
/// up to their end.
#[inline(always)]
pub(crate) fn emit_blocks<P: PointFormat, I: IndexFormat>(
    config: Config,
    stitches: &Stitches,
    blocks: Blocks<'_, P, I>,
) -> (u32, u32) {
    let Blocks { buffers, first: (mut first_point, mut first_index), numbering, workspace } =
        blocks;
    let Workspace { blocks, tables, templates } = workspace;
    let mut points = Writer::new(buffers.points);
    let mut indices = Writer::new(buffers.indices);
    for (block, ranges) in blocks.iter().zip(buffers.ranges.chunks_mut(LANES)) {
        for (lane, range) in ranges.iter_mut().enumerate() {
            *range = PatchRange {
                first_point,
                points: block.counts.points[lane],
                first_index,
                indices: block.counts.indices[lane],
            };
            let base = match numbering {
                Numbering::PerPatch => 0,
                Numbering::Batch { base_vertex } => base_vertex.wrapping_add(first_point),
            };
            first_point += range.points;
            first_index += range.indices;
            if range.points > 0 {
                let kept = (stitches, &mut **tables, &mut *templates);
                emit_patch(config, kept, (block, lane), base, (&mut points, &mut indices));
            }
        }
    }
    (first_point, first_index)
}

/// Writes one patch that is not culled.
#[inline(always)]
fn emit_patch<P: PointFormat, I: IndexFormat>(
    config: Config,
    (stitches, tables, templates): (&Stitches, &mut LocationTables, &mut Templates),
    (block, lane): (&Block, usize),
    base: u32,
    (points, indices): (&mut Writer<'_, P>, &mut Writer<'_, I>),
) {
    let counts = (block.counts.points[lane], block.counts.indices[lane] as usize);
    let Some(template) = templates.get((config, stitches), (block, lane), tables) else {
        let edges = block.edges(lane);
        points::emit((block, lane), &edges, tables, points);
        let kind = (block.domain(), config.output);
        connect::emit(kind, &edges, stitches, (base, counts.0), indices);
        return;
    };
    if let Some(template) = template.points {
        points.map::<_, 8>(counts.0 as usize, template, |point: DomainPoint| {
            P::from_bits(point.u.to_bits(), point.v.to_bits())
        });
    } else {
        points::emit((block, lane), &block.edges(lane), tables, points);
    }
    let base = I::wrapping_from(base);
    indices.map::<_, 16>(counts.1, template.indices, |index: u16| {
        base.wrapping_add(I::wrapping_from(index.into()))
    });
}

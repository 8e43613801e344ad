//! One thread's share of a batch: counting it, and writing it.

use crate::batch::Batch;
use crate::block::Block;
use crate::connect;
use crate::emit::Writer;
use crate::factor_context::Contexts;
use crate::format::{IndexFormat, PointFormat};
use crate::lanes::LANES;
use crate::output::{Buffers, Numbering, PatchRange};
use crate::points::{self, LocationTables};
use crate::stitch::Stitches;
use crate::template::Templates;
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

/// What a thread keeps from batch to batch. All of it depends on the configuration alone.
#[derive(Clone, Debug)]
pub(crate) struct Workspace {
    tables: LocationTables,
    templates: Templates,
}

impl Workspace {
    pub(crate) fn new() -> Self {
        Self { tables: LocationTables::EMPTY, templates: Templates::new() }
    }

    /// Bytes of memory that it takes.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<Self>() + self.templates.bytes()
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
    pub(crate) workspace: &'a mut Workspace,
}

/// Predicts the output sizes of patches.
#[inline(always)]
pub(crate) fn count(config: Config, batch: &Batch<'_>) -> PartCounts {
    let mut total = PartCounts::default();
    let mut largest = [0; LANES];
    for first in (0..batch.len()).step_by(LANES) {
        let counts = Block::new(config, batch, first).counts;
        total.points += u64::from(counts.points.iter().sum::<u32>());
        total.indices += u64::from(counts.indices.iter().sum::<u32>());
        for (largest, points) in largest.iter_mut().zip(counts.points) {
            *largest = points.max(*largest);
        }
    }
    total.largest = largest.into_iter().max().unwrap_or(0);
    total
}

/// Writes patches to buffers whose sizes are exactly those that [`count`] predicts.
#[inline(always)]
pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
    config: Config,
    stitches: &Stitches,
    part: Part<'_, P, I>,
) {
    let Part { batch, buffers, first: (mut first_point, mut first_index), numbering, workspace } =
        part;
    let mut points = Writer::new(buffers.points);
    let mut indices = Writer::new(buffers.indices);
    for (number, ranges) in buffers.ranges.chunks_mut(LANES).enumerate() {
        let block = Block::new(config, &batch, number * LANES);
        let contexts = block.contexts();
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
            if range.points > 0 {
                let patch = (&block, &contexts, lane);
                emit_patch(config, stitches, patch, base, workspace, (&mut points, &mut indices));
            }
            first_point += range.points;
            first_index += range.indices;
        }
    }
    debug_assert_eq!(points.written(), points.capacity(), "the points were counted");
    debug_assert_eq!(indices.written(), indices.capacity(), "the indices were counted");
}

/// Writes one patch that is not culled.
#[inline(always)]
fn emit_patch<P: PointFormat, I: IndexFormat>(
    config: Config,
    stitches: &Stitches,
    (block, contexts, lane): (&Block, &Contexts, usize),
    base: u32,
    workspace: &mut Workspace,
    (points, indices): (&mut Writer<'_, P>, &mut Writer<'_, I>),
) {
    let Workspace { tables, templates } = workspace;
    let edges = block.edges(lane);
    let counts = (block.counts.points[lane], block.counts.indices[lane] as usize);
    let Some(template) = templates.get((config, stitches), (block, lane), &edges, tables) else {
        points::emit((block, contexts), lane, &edges, tables, points);
        let kind = (block.domain(), config.output);
        connect::emit(kind, &edges, stitches, (base, counts.0), indices);
        return;
    };
    if let Some(template) = template.points {
        points.map::<_, 8>(counts.0 as usize, template, |point: DomainPoint| {
            P::from_bits(point.u.to_bits(), point.v.to_bits())
        });
    } else {
        points::emit((block, contexts), lane, &edges, tables, points);
    }
    let base = I::wrapping_from(base);
    indices.map::<_, 16>(counts.1, template.indices, |index: u16| {
        base.wrapping_add(I::wrapping_from(index.into()))
    });
}

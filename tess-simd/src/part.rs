//! Consecutive patches of a batch, written by one thread.

use crate::batch::Batch;
use crate::block::Block;
use crate::chunk::Chunk;
use crate::dispatch;
use crate::format::{AnyIndices, AnyPoints, IndexFormat, PointFormat};
use crate::kernel::emit::{Blocks, Caches, Offsets};
use crate::lanes::LANES;
use crate::output::{Buffers, Numbering};
use crate::setup::Setup;
use crate::target::Target;
use alloc::boxed::Box;

/// What is the same for all parts of a batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Job<'a> {
    pub(crate) setup: &'a Setup,
    pub(crate) numbering: Numbering,
    /// The blocks of the whole batch if the count kept them, else none. A batch whose blocks were
    /// kept is one part.
    pub(crate) kept: &'a [Block],
}

/// Consecutive patches of a batch and where their output goes.
#[derive(Debug)]
pub(crate) struct Part<'a> {
    pub(crate) batch: Batch<'a>,
    /// Buffers of exactly the sizes that the count predicts.
    pub(crate) target: Target<'a>,
    pub(crate) first: Offsets,
}

/// What a thread keeps from batch to batch. Two threads' workspaces share no cache lines.
#[derive(Clone, Debug)]
#[repr(align(128))]
pub(crate) struct Workspace {
    blocks: Box<[Block; Chunk::BLOCKS]>,
    caches: Caches,
}

impl Workspace {
    pub(crate) fn new() -> Self {
        Self { blocks: Box::new([Block::EMPTY; _]), caches: Caches::new() }
    }

    /// Bytes of memory that it takes on the heap.
    pub(crate) const fn bytes(&self) -> usize {
        size_of::<[Block; Chunk::BLOCKS]>() + self.caches.bytes()
    }
}

/// Writes a part.
pub(crate) fn emit(job: Job<'_>, part: Part<'_>, workspace: &mut Workspace) {
    let Part { batch, target: Target { points, indices, ranges }, first } = part;
    match (points, indices) {
        (AnyPoints::F32(points), AnyIndices::U16(indices)) => {
            emit_as(job, &batch, Buffers { points, indices, ranges }, first, workspace);
        }
        (AnyPoints::F32(points), AnyIndices::U32(indices)) => {
            emit_as(job, &batch, Buffers { points, indices, ranges }, first, workspace);
        }
        (AnyPoints::Fixed(points), AnyIndices::U16(indices)) => {
            emit_as(job, &batch, Buffers { points, indices, ranges }, first, workspace);
        }
        (AnyPoints::Fixed(points), AnyIndices::U32(indices)) => {
            emit_as(job, &batch, Buffers { points, indices, ranges }, first, workspace);
        }
    }
}

/// Writes a part in one pair of formats, a chunk at a time.
fn emit_as<P: PointFormat, I: IndexFormat>(
    job: Job<'_>,
    batch: &Batch<'_>,
    buffers: Buffers<'_, P, I>,
    mut first: Offsets,
    workspace: &mut Workspace,
) {
    let Job { setup, numbering, kept } = job;
    let Buffers { mut points, mut indices, mut ranges } = buffers;
    let all = batch.len();
    for start in (0..all).step_by(Chunk::PATCHES) {
        let patches = Chunk::PATCHES.min(all - start);
        let blocks = if kept.is_empty() {
            dispatch::process(setup.level, setup.config, batch, start, &mut *workspace.blocks);
            &workspace.blocks[..]
        } else {
            kept.get(start / LANES..).unwrap_or_default()
        };
        let blocks = &blocks[..patches.div_ceil(LANES)];
        let blocks = Blocks { blocks, patches, first, numbering };
        let chunk_ranges = ranges.as_deref_mut().map(|ranges| &mut ranges[start..start + patches]);
        let buffers =
            Buffers { points: &mut *points, indices: &mut *indices, ranges: chunk_ranges };
        let end = dispatch::emit(setup.level, setup, blocks, buffers, &mut workspace.caches);
        points = points.split_at_mut((end.points - first.points) as usize).1;
        indices = indices.split_at_mut((end.indices - first.indices) as usize).1;
        first = end;
    }
    debug_assert!(points.is_empty(), "the points were counted");
    debug_assert!(indices.is_empty(), "the indices were counted");
}

//! What is behind the public interface: counting a batch, and writing one that was counted.

use crate::batch::Batch;
use crate::block::Block;
use crate::chunk::Chunk;
use crate::counts::PartCounts;
use crate::dispatch;
use crate::error::Error;
use crate::kernel::emit::Offsets;
use crate::output::Numbering;
use crate::part::{Job, Part};
use crate::setup::Setup;
use crate::slices::{CountShare, Share, Slicing};
use crate::target::Target;
use crate::threads::Workspaces;
use alloc::boxed::Box;
use alloc::vec::Vec;
use tess_core::Order;

/// A setup, and the memory that batches need.
#[derive(Clone, Debug)]
pub(crate) struct Engine {
    pub(crate) setup: Setup,
    pub(crate) workspaces: Workspaces,
    /// The counts of each slice of the batch that was counted last.
    slices: Vec<PartCounts>,
    /// Its blocks, if they were kept for the write: those of one chunk.
    kept: Box<[Block; Chunk::BLOCKS]>,
}

/// What a count found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Count {
    pub(crate) total: PartCounts,
    /// Whether the batch's blocks were kept.
    kept: bool,
}

impl Engine {
    pub(crate) fn new(setup: Setup) -> Self {
        let kept = Box::new([Block::EMPTY; _]);
        let workspaces = Workspaces::new();
        Self { setup, workspaces, slices: Vec::new(), kept }
    }

    /// The same for triangles in this order. Templates that were made are forgotten.
    pub(crate) fn in_order(mut self, order: Order) -> Self {
        self.setup.order = order;
        self.workspaces.forget();
        self
    }

    /// Bytes of memory that it takes.
    pub(crate) fn bytes(&self) -> usize {
        self.setup.stitches.bytes() + self.workspaces.bytes() + size_of_val(&*self.kept)
    }

    /// Counts a batch.
    pub(crate) fn count(&mut self, batch: &Batch<'_>) -> Result<Count, Error> {
        batch.check()?;
        let Self { setup, workspaces, slices, kept } = self;
        let slicing = Slicing::new(batch.len(), workspaces.threads());
        slices.clear();
        let keep = slicing.slices <= 1 && batch.len() <= Chunk::PATCHES;
        if keep {
            let Setup { level, config, .. } = *setup;
            slices.push(dispatch::count_and_keep(level, config, batch, kept));
        } else {
            slices.resize(slicing.slices, PartCounts::default());
            let share = CountShare { batch: *batch, slice: slicing.patches, counts: slices };
            workspaces.count(setup, share);
        }
        let total = PartCounts::sum(slices);
        if total.points.max(total.indices) > u64::from(u32::MAX) {
            return Err(Error::BatchTooLarge { points: total.points, indices: total.indices });
        }
        Ok(Count { total, kept: keep })
    }

    /// Writes the batch that was counted last, of which this count is, into buffers of exactly its
    /// sizes.
    pub(crate) fn write(
        &mut self,
        batch: Batch<'_>,
        count: Count,
        numbering: Numbering,
        target: Target<'_>,
    ) {
        let Self { setup, workspaces, slices, kept } = self;
        let kept = count.kept.then_some(&**kept);
        let slice = Slicing::new(batch.len(), workspaces.threads()).patches;
        let part = Part { batch, target, first: Offsets::default() };
        workspaces.emit(Job { setup, numbering, kept }, Share { part, slice, counts: slices });
    }
}

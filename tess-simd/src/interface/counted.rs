//! A batch whose output sizes are known.

use crate::data::batch::Batch;
use crate::data::chunk::Chunk;
use crate::data::error::{BatchBuffer, Error};
use crate::data::format::{IndexFormat, OutputPoint};
#[cfg(feature = "apart")]
use crate::data::output::ApartBuffers;
use crate::data::output::{BatchCounts, Buffers, Numbering, Output, PatchRange};
use crate::data::point_writer::PointRoom;
use crate::data::ranges::Ranges;
use crate::data::target::{AnyBuffers, first, with_types};
use crate::kernels::emit::Offsets;
use crate::stages::counts::PartCounts;
use crate::stages::packet::Packet;
use crate::stages::settings::Settings;
use crate::threads::Workspaces;
use crate::threads::part::{Job, Part};
use crate::threads::sizes::Slicing;
use crate::threads::slices::Share;
use tess_core::PatchFactors;
use tess_level::Level;

/// A counted batch, made by [`Tessellator::count`](crate::Tessellator::count). It can be written
/// any number of times.
///
/// It borrows the tessellator, which therefore cannot count another batch until this one is
/// written.
///
/// ```compile_fail,E0499
/// # use tess_simd::tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
/// # use tess_simd::{Numbering, Output, Tessellator};
/// # let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
/// # let (one, other) = ([QuadFactors::from([1.0; 6])], [QuadFactors::from([2.0; 6])]);
/// # let mut output: Output = Output::new();
/// let mut tessellator = Tessellator::new(config);
/// let mut first = tessellator.count(&one)?;
/// let second = tessellator.count(&other)?; // the tessellator is borrowed
/// first.tessellate(Numbering::PerPatch, &mut output)?;
/// # Ok::<(), tess_simd::Error>(())
/// ```
#[derive(Debug)]
#[must_use = "a count alone writes nothing"]
pub struct Counted<'a> {
    pub(super) level: Level,
    pub(super) settings: &'a Settings,
    pub(super) workspaces: &'a mut Workspaces,
    pub(super) batch: Batch<'a>,
    pub(super) slicing: Slicing,
    /// The counts of each slice.
    pub(super) slices: &'a [PartCounts],
    pub(super) total: PartCounts,
    /// The packets of the whole batch, if they were kept.
    pub(super) kept: Option<&'a [Packet; Chunk::PACKETS]>,
    /// The patch, if there is only one.
    pub(super) one: Option<PatchFactors>,
}

impl<'a> Counted<'a> {
    /// Number of patches, including culled ones. The range buffer needs one element for each.
    #[must_use]
    pub fn patches(&self) -> usize {
        self.batch.len()
    }

    /// Number of points, below 2^32. The point buffer needs one element for each.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
    pub const fn points(&self) -> usize {
        self.total.points as usize
    }

    /// Number of indices, below 2^32. The index buffer needs one element for each.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
    pub const fn indices(&self) -> usize {
        self.total.indices as usize
    }

    /// All three sizes.
    #[must_use]
    pub fn counts(&self) -> BatchCounts {
        BatchCounts { patches: self.patches(), points: self.points(), indices: self.indices() }
    }

    /// The largest index under a numbering; `None` if the batch has no points. With `u16` the index
    /// 65535 restarts primitives in some interfaces: see [`IndexFormat`].
    #[must_use]
    pub fn largest_index(&self, numbering: Numbering) -> Option<u64> {
        let end = match numbering {
            Numbering::PerPatch => u64::from(self.total.largest),
            Numbering::PerBatch { .. } if self.total.points == 0 => 0,
            Numbering::PerBatch { base_vertex } => u64::from(base_vertex) + self.total.points,
        };
        end.checked_sub(1)
    }

    /// Writes the batch into the caller's buffers.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`] or [`Error::IndexTooLarge`]; then nothing is written.
    pub fn write<P: OutputPoint, I: IndexFormat>(
        &mut self,
        numbering: Numbering,
        buffers: Buffers<'_, P, I>,
    ) -> Result<BatchCounts, Error> {
        self.write_into(numbering, buffers.into())
    }

    /// [`Counted::write`] with points in two arrays.
    ///
    /// # Errors
    /// As for [`Counted::write`].
    #[cfg(feature = "apart")]
    pub fn write_apart<I: IndexFormat>(
        &mut self,
        numbering: Numbering,
        buffers: ApartBuffers<'_, I>,
    ) -> Result<BatchCounts, Error> {
        self.write_into(numbering, buffers.into())
    }

    /// Writes the batch into an output object, which grows if needed.
    ///
    /// # Errors
    /// [`Error::IndexTooLarge`]; then the output keeps its contents.
    pub fn tessellate<P: OutputPoint, I: IndexFormat>(
        &mut self,
        numbering: Numbering,
        output: &mut Output<P, I>,
    ) -> Result<BatchCounts, Error> {
        self.check_indices::<I>(numbering)?;
        self.write_into(numbering, output.make_room(self.counts()).into())
    }

    fn write_into(
        &mut self,
        numbering: Numbering,
        target: AnyBuffers<'_>,
    ) -> Result<BatchCounts, Error> {
        with_types!(target, |points, indices, ranges| {
            self.write_as(numbering, points, indices, ranges)
        })
    }

    fn write_as<I: IndexFormat>(
        &mut self,
        numbering: Numbering,
        points: impl PointRoom,
        indices: &mut [I],
        ranges: Option<&mut [PatchRange]>,
    ) -> Result<BatchCounts, Error> {
        self.check_indices::<I>(numbering)?;
        let counts = self.counts();
        let ranges = ranges.map(|ranges| first(ranges, BatchBuffer::Ranges, counts.patches, 0));
        let mut ranges = Ranges::new(ranges.transpose()?);
        let points = points.first(counts.points, 0)?;
        let indices = first(indices, BatchBuffer::Indices, counts.indices, 0)?;
        let Self { level, settings, batch, slicing, slices, kept, one, .. } = *self;
        if let Some(patch) = &one {
            let (how, workspace) = ((level, settings), self.workspaces.one());
            let of = workspace.emit_counted(how, (numbering, patch), points, indices)?;
            let range = PatchRange { points: of.points, indices: of.indices, ..Default::default() };
            ranges.next_or(&mut [PatchRange::default()])[0] = range;
            return Ok(counts);
        }
        let first = Offsets::default();
        let part = Part { batch, points, indices, ranges, first, run: slices[0].run };
        let share = Share { part, slice: slicing.patches, counts: slices };
        self.workspaces.emit(Job { level, settings, numbering, kept }, share);
        Ok(counts)
    }

    /// Checks that the largest index fits the index format.
    fn check_indices<I: IndexFormat>(&self, numbering: Numbering) -> Result<(), Error> {
        match self.largest_index(numbering) {
            Some(largest) if largest > I::LARGEST => {
                Err(Error::IndexTooLarge { largest, limit: I::LARGEST })
            }
            _ => Ok(()),
        }
    }
}

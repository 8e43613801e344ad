//! A batch whose output sizes are known.

use crate::batch::Batch;
use crate::engine::{Count, Engine};
use crate::error::{Buffer, Error};
use crate::format::{IndexFormat, PointFormat};
use crate::output::{BatchCounts, Buffers, Numbering, Output};

/// A batch whose output was counted, ready to be written any number of times. Made by
/// [`Tessellator::count`](crate::Tessellator::count), which it borrows, so that it cannot be
/// written after the tessellator counted another batch.
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
    engine: &'a mut Engine,
    batch: Batch<'a>,
    count: Count,
}

impl<'a> Counted<'a> {
    /// Counts a batch.
    pub(crate) fn new(engine: &'a mut Engine, batch: Batch<'a>) -> Result<Self, Error> {
        let count = engine.count(&batch)?;
        Ok(Self { engine, batch, count })
    }

    /// The number of patches, culled ones included: elements of the range buffer.
    #[must_use]
    pub fn patches(&self) -> usize {
        self.batch.len()
    }

    /// The number of points: elements of the point buffer, below 2^32.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
    pub const fn points(&self) -> usize {
        self.count.total.points as usize
    }

    /// The number of indices: elements of the index buffer, below 2^32.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
    pub const fn indices(&self) -> usize {
        self.count.total.indices as usize
    }

    /// All three sizes.
    #[must_use]
    pub fn counts(&self) -> BatchCounts {
        BatchCounts { patches: self.patches(), points: self.points(), indices: self.indices() }
    }

    /// The largest index under a numbering; `None` if the batch has no points.
    #[must_use]
    pub fn largest_index(&self, numbering: Numbering) -> Option<u64> {
        let end = match numbering {
            Numbering::PerPatch => u64::from(self.count.total.largest),
            Numbering::PerBatch { .. } if self.count.total.points == 0 => 0,
            Numbering::PerBatch { base_vertex } => u64::from(base_vertex) + self.count.total.points,
        };
        end.checked_sub(1)
    }

    /// Writes the batch into the caller's buffers.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`] or [`Error::IndexTooLarge`]; then nothing is written.
    pub fn write<P: PointFormat, I: IndexFormat>(
        &mut self,
        numbering: Numbering,
        buffers: Buffers<'_, P, I>,
    ) -> Result<BatchCounts, Error> {
        self.check_indices::<I>(numbering)?;
        let counts = self.counts();
        let ranges = match buffers.ranges {
            Some(ranges) => Some(prefix(ranges, counts.patches, Buffer::Ranges)?),
            None => None,
        };
        let buffers = Buffers {
            points: prefix(buffers.points, counts.points, Buffer::Points)?,
            indices: prefix(buffers.indices, counts.indices, Buffer::Indices)?,
            ranges,
        };
        self.engine.write(self.batch, self.count, numbering, buffers.into());
        Ok(counts)
    }

    /// Writes the batch into an output object, which grows if it must.
    ///
    /// # Errors
    /// [`Error::IndexTooLarge`]; then the output stays as it was.
    pub fn tessellate<P: PointFormat, I: IndexFormat>(
        &mut self,
        numbering: Numbering,
        output: &mut Output<P, I>,
    ) -> Result<BatchCounts, Error> {
        self.check_indices::<I>(numbering)?;
        let counts = self.counts();
        let target = output.make_room(counts).into();
        self.engine.write(self.batch, self.count, numbering, target);
        Ok(counts)
    }

    /// Whether the largest index fits.
    fn check_indices<I: IndexFormat>(&self, numbering: Numbering) -> Result<(), Error> {
        match self.largest_index(numbering) {
            Some(largest) if largest > I::LARGEST => {
                Err(Error::IndexTooLarge { largest, format: I::LARGEST })
            }
            _ => Ok(()),
        }
    }
}

/// The first `needed` elements of a caller's buffer.
fn prefix<T>(slice: &mut [T], needed: usize, buffer: Buffer) -> Result<&mut [T], Error> {
    let got = slice.len();
    slice.get_mut(..needed).ok_or(Error::BufferTooSmall { buffer, needed, got })
}

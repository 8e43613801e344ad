//! Writing of a batch: at once, or in parts if it takes long enough to press Ctrl-C.

use crate::errors;
use pyo3::prelude::*;
use tess_simd::{
    Batch, BatchBuffer, BatchCounts, Buffers, Counted, Error, IndexFormat, Numbering, OutputPoint,
    PatchRange, Tessellator,
};

/// The largest output between two checks for signals, in bytes. It takes some hundredths of a
/// second to write.
const MOST_BYTES: usize = 64 << 20;

/// A counted batch, to be written.
pub(super) struct BatchWork<'a> {
    pub(super) numbering: Numbering,
    pub(super) how: How<'a>,
}

/// At once, or in parts.
pub(super) enum How<'a> {
    /// Without counting it again.
    AtOnce(Counted<'a>),
    Parts {
        tessellator: &'a mut Tessellator,
        batch: Batch<'a>,
        sizes: BatchSizes,
    },
}

/// A batch that is counted.
#[derive(Clone, Copy)]
pub(super) struct BatchSizes {
    pub(super) counts: BatchCounts,
    largest_index: Option<u64>,
}

impl BatchSizes {
    pub(super) fn of(counted: &Counted<'_>, numbering: Numbering) -> Self {
        Self { counts: counted.counts(), largest_index: counted.largest_index(numbering) }
    }

    /// Whether the batch is written at once.
    pub(super) fn is_small(&self) -> bool {
        // The types are not known yet; these are the largest.
        bytes::<[f32; 2], u32>(self.counts) <= MOST_BYTES
    }
}

fn bytes<P, I>(counts: BatchCounts) -> usize {
    counts.points * size_of::<P>()
        + counts.indices * size_of::<I>()
        + counts.patches * size_of::<PatchRange>()
}

impl BatchWork<'_> {
    /// Writes it without the interpreter's lock. Errors: those of [`Counted::write`], after which
    /// nothing is written; the exception of a signal handler.
    pub(super) fn write<P: OutputPoint, I: IndexFormat>(
        self,
        py: Python<'_>,
        mut room: ArrayRoom<'_, P, I>,
    ) -> PyResult<()> {
        let Self { numbering, how } = self;
        let (tessellator, batch, sizes) = match how {
            How::AtOnce(mut counted) => {
                let write = || counted.write(numbering, room.buffers());
                py.detach(write).map_err(errors::batch)?;
                return Ok(());
            }
            How::Parts { tessellator, batch, sizes } => (tessellator, batch, sizes),
        };
        room = room.of_sizes(sizes).map_err(errors::batch)?;
        let mut left = sizes.counts;
        let mut first = PatchRange::default();
        let mut patches = most_patches::<P, I>(left);
        while left.patches > 0 {
            py.check_signals()?;
            let done = sizes.counts.patches - left.patches;
            let part = batch.get(done..done + patches.min(left.patches));
            let part = part.ok_or_else(|| errors::argument("a part past the end of the batch"))?;
            let write = || write_part(tessellator, part, numbering, first, room.rest(sizes, left));
            let written = py.detach(write).map_err(errors::batch)?;
            let Some(counts) = written else {
                patches /= 2;
                continue;
            };
            left.patches -= counts.patches;
            left.points -= counts.points;
            left.indices -= counts.indices;
            first.first_point += narrow(counts.points);
            first.first_index += narrow(counts.indices);
            patches = most_patches::<P, I>(left);
        }
        Ok(())
    }
}

/// The number of average patches that have [`MOST_BYTES`] of output, at least one.
fn most_patches<P, I>(counts: BatchCounts) -> usize {
    let average = bytes::<P, I>(counts).div_ceil(counts.patches.max(1));
    (MOST_BYTES / average.max(1)).max(1)
}

#[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
const fn narrow(count: usize) -> u32 {
    count as u32
}

/// Writes a part, whose output begins at `first`, to the beginning of `room`; `None` if the part is
/// too large and can be cut.
fn write_part<P: OutputPoint, I: IndexFormat>(
    tessellator: &mut Tessellator,
    part: Batch<'_>,
    numbering: Numbering,
    first: PatchRange,
    room: ArrayRoom<'_, P, I>,
) -> Result<Option<BatchCounts>, Error> {
    let mut counted = tessellator.count(part)?;
    let counts = counted.counts();
    if bytes::<P, I>(counts) > 2 * MOST_BYTES && counts.patches > 1 {
        return Ok(None);
    }
    let ArrayRoom { points, indices, ranges } = room;
    let numbering = numbering.behind(first.first_point);
    counted.write(numbering, Buffers::new(points, indices).with_ranges(&mut *ranges))?;
    for range in &mut ranges[..counts.patches] {
        range.first_point += first.first_point;
        range.first_index += first.first_index;
    }
    Ok(Some(counts))
}

/// The buffers of a batch.
pub(super) struct ArrayRoom<'a, P, I> {
    pub(super) points: &'a mut [P],
    pub(super) indices: &'a mut [I],
    pub(super) ranges: &'a mut [PatchRange],
}

impl<'a, P: OutputPoint, I: IndexFormat> ArrayRoom<'a, P, I> {
    fn buffers(&mut self) -> Buffers<'_, P, I> {
        Buffers::new(self.points, self.indices).with_ranges(self.ranges)
    }

    /// The room of the output. Errors: those of [`Counted::write`].
    fn of_sizes(self, sizes: BatchSizes) -> Result<Self, Error> {
        if let Some(largest) = sizes.largest_index.filter(|&largest| largest > I::LARGEST) {
            return Err(Error::IndexTooLarge { largest, limit: I::LARGEST });
        }
        let BatchCounts { patches, points, indices } = sizes.counts;
        Ok(Self {
            ranges: prefix(self.ranges, patches, BatchBuffer::Ranges)?,
            points: prefix(self.points, points, BatchBuffer::Points)?,
            indices: prefix(self.indices, indices, BatchBuffer::Indices)?,
        })
    }

    /// The room of the unwritten rest of a batch. `self` is the room of the whole batch.
    fn rest(&mut self, sizes: BatchSizes, left: BatchCounts) -> ArrayRoom<'_, P, I> {
        let BatchCounts { patches, points, indices } = sizes.counts;
        ArrayRoom {
            points: &mut self.points[points - left.points..],
            indices: &mut self.indices[indices - left.indices..],
            ranges: &mut self.ranges[patches - left.patches..],
        }
    }
}

fn prefix<T>(slice: &mut [T], needed: usize, buffer: BatchBuffer) -> Result<&mut [T], Error> {
    let got = slice.len();
    slice.get_mut(..needed).ok_or(Error::BufferTooSmall { buffer, needed, got })
}

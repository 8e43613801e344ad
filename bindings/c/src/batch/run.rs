//! A batch into the caller's buffers, in the formats that the caller chose.

use super::input::Patches;
use super::points::PointRoom;
use super::{
    TESS_NUMBERING_PER_BATCH, TESS_NUMBERING_PER_PATCH, TessBatch, TessBatchCounts,
    TessBatchOutput, status_of,
};
use crate::boundary::{self, MemoryState};
use crate::shortage::{self, TESS_BUFFER_INDICES, TESS_BUFFER_POINTS, TESS_BUFFER_RANGES};
use crate::status::{TESS_INDEX_TOO_LARGE, TESS_INTERNAL, TESS_UNKNOWN_VALUE, TessStatus};
use std::mem::{MaybeUninit, size_of};
use tess_simd::{BatchCounts, Counted, IndexFormat, Numbering, PatchRange, Tessellator};

/// The caller's buffers, which need not be initialised.
#[derive(Debug)]
struct BatchRoom<'a, P, I> {
    points: P,
    indices: &'a mut [MaybeUninit<I>],
    /// `None` if the caller does not want ranges.
    ranges: Option<&'a mut [MaybeUninit<PatchRange>]>,
    memory: MemoryState,
}

/// Tessellates a batch in one pair of formats.
///
/// # Safety
/// - As for [`super::tess_batch_run`], with buffers of `P`'s points and of `I`.
pub(super) unsafe fn run<'a, P: PointRoom<'a>, I: IndexFormat>(
    batch: &mut TessBatch,
    (factors, factor_count): (*const f32, usize),
    output: &TessBatchOutput,
    counts: *mut TessBatchCounts,
) -> Result<(), TessStatus> {
    let numbering = match output.numbering {
        TESS_NUMBERING_PER_PATCH => Numbering::PerPatch,
        TESS_NUMBERING_PER_BATCH => Numbering::PerBatch { base_vertex: output.base_vertex },
        _ => return Err(TESS_UNKNOWN_VALUE),
    };
    let points = (output.points.cast::<P::Point>(), output.point_capacity);
    let indices = (output.indices.cast::<I>(), output.index_capacity);
    let ranges = (output.ranges.cast::<PatchRange>(), output.range_capacity);
    boundary::check_all_apart(&[
        boundary::bytes(factors, factor_count)?,
        boundary::bytes(points.0, points.1)?,
        boundary::bytes(indices.0, indices.1)?,
        boundary::bytes(ranges.0, ranges.1)?,
        boundary::bytes(counts, 1)?,
    ])?;
    // SAFETY: `factor_count` readable floats, as the caller promises.
    let patches = unsafe { Patches::new(batch.domain, factors, factor_count) }?;
    // SAFETY: the buffers are as the caller promises.
    let memory = unsafe { output.memory() }?;
    let room = BatchRoom {
        // SAFETY: writable, as the caller promises, and apart from all else, as was just checked.
        points: unsafe { P::new(output.points, points.1) }?,
        // SAFETY: as above.
        indices: unsafe { boundary::room(indices.0, indices.1) }?,
        ranges: if ranges.0.is_null() {
            None
        } else {
            // SAFETY: as above; the two structures of ranges have the same layout.
            Some(unsafe { boundary::room(ranges.0, ranges.1) }?)
        },
        memory,
    };
    let tessellator = &mut batch.tessellator;
    let mut counted = tessellator.count(patches.batch()).map_err(|error| status_of(&error))?;
    let needed = counted.counts();
    if counted.largest_index(numbering).is_some_and(|largest| largest > I::LARGEST) {
        return Err(TESS_INDEX_TOO_LARGE);
    }
    // SAFETY: `counts` is writable, as the caller promises, and apart from the buffers.
    unsafe { boundary::write(counts, needed.into()) }?;
    room.check(needed)?;
    let room = room.split_at(needed).ok_or(TESS_INTERNAL)?.0;
    if memory.is_initialised() {
        room.receive(&mut counted, numbering).map(drop)
    } else {
        write(tessellator, patches, numbering, room, needed)
    }
}

/// The size of a part's output, in bytes. It fits a core's nearest caches.
const PART_BYTES: usize = 1 << 18;

/// The largest number of patches in a part. The batch backend keeps the results of counting this
/// many patches until it writes them.
const PART_PATCHES: usize = 64;

/// Writes a batch into room of exactly its sizes.
///
/// The batch backend takes initialised slices. They are initialised part by part, each part just
/// before its output is written, so that it is still in the cache.
fn write<'a, P: PointRoom<'a>, I: IndexFormat>(
    tessellator: &mut Tessellator,
    patches: Patches<'_>,
    numbering: Numbering,
    mut room: BatchRoom<'a, P, I>,
    needed: BatchCounts,
) -> Result<(), TessStatus> {
    let bytes = needed.points * size_of::<P::Point>() + needed.indices * size_of::<I>();
    let per_patch = bytes.div_ceil(needed.patches.max(1)).max(1);
    let mut first = PatchRange::default();
    for part in patches.parts((PART_BYTES / per_patch).clamp(1, PART_PATCHES)) {
        let mut counted = tessellator.count(part.batch()).map_err(|error| status_of(&error))?;
        let counts = counted.counts();
        let (now, later) = room.split_at(counts).ok_or(TESS_INTERNAL)?;
        let ranges = now.receive(&mut counted, numbering.behind(first.first_point))?;
        for range in ranges.into_iter().flatten() {
            range.first_point += first.first_point;
            range.first_index += first.first_index;
        }
        first.first_point += narrow(counts.points);
        first.first_index += narrow(counts.indices);
        room = later;
    }
    Ok(())
}

#[expect(clippy::cast_possible_truncation, reason = "a counted batch's sizes fit 32 bits")]
const fn narrow(count: usize) -> u32 {
    count as u32
}

impl<'a, P: PointRoom<'a>, I: IndexFormat> BatchRoom<'a, P, I> {
    /// Writes a counted batch into room of exactly its sizes. Returns the ranges if the caller
    /// wants them.
    fn receive(
        self,
        counted: &mut Counted<'_>,
        numbering: Numbering,
    ) -> Result<Option<&'a mut [PatchRange]>, TessStatus> {
        let initialised =
            |ranges| boundary::initialised(ranges, self.memory, PatchRange::default());
        let mut ranges = self.ranges.map(initialised);
        let indices = boundary::initialised(self.indices, self.memory, I::default());
        let written =
            self.points.batch(self.memory, counted, numbering, (indices, ranges.as_deref_mut()));
        written.map(|_| ranges).map_err(|error| status_of(&error))
    }

    /// Refuses a batch that does not fit, with the buffer that [`Counted::write`] would name.
    fn check(&self, needed: BatchCounts) -> Result<(), TessStatus> {
        if let Some(ranges) = &self.ranges {
            shortage::check(TESS_BUFFER_RANGES, needed.patches, ranges.len())?;
        }
        shortage::check(TESS_BUFFER_POINTS, needed.points, self.points.len())?;
        shortage::check(TESS_BUFFER_INDICES, needed.indices, self.indices.len())
    }

    /// Its beginning and the rest; `None` if it is smaller.
    fn split_at(self, counts: BatchCounts) -> Option<(Self, Self)> {
        let memory = self.memory;
        let (points, more_points) = self.points.split_at(counts.points)?;
        let (indices, more_indices) = self.indices.split_at_mut_checked(counts.indices)?;
        let (ranges, more_ranges) = match self.ranges {
            Some(ranges) => {
                let (first, rest) = ranges.split_at_mut_checked(counts.patches)?;
                (Some(first), Some(rest))
            }
            None => (None, None),
        };
        Some((
            Self { points, indices, ranges, memory },
            Self { points: more_points, indices: more_indices, ranges: more_ranges, memory },
        ))
    }
}

//! A batch into the caller's buffers, in the formats that the caller chose.

use super::input::Patches;
use super::points::PointRoom;
use super::{
    TESS_NUMBERING_PER_BATCH, TESS_NUMBERING_PER_PATCH, TessBatch, TessBatchCounts,
    TessBatchOutput, status_of,
};
use crate::boundary::{self, MemoryState};
use crate::status::{TESS_BUFFER_TOO_SMALL, TESS_INDEX_TOO_LARGE, TESS_UNKNOWN_VALUE, TessStatus};
use std::mem::{MaybeUninit, size_of};
use tess_simd::{BatchCounts, Counted, IndexFormat, Numbering, PatchRange, Tessellator};

/// The caller's buffers, which need not be initialised.
#[derive(Debug)]
struct BatchRoom<'a, P, I> {
    points: P,
    indices: &'a mut [MaybeUninit<I>],
    ranges: &'a mut [MaybeUninit<PatchRange>],
    memory: MemoryState,
}

/// Tessellates a batch in one pair of formats.
///
/// # Safety
/// - As for [`super::tess_batch_run`], the buffers' elements being `P`'s and `I`.
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
        // SAFETY: as above; the two structures of ranges have the same layout.
        ranges: unsafe { boundary::room(ranges.0, ranges.1) }?,
        memory,
    };
    let tessellator = &mut batch.tessellator;
    let mut counted = tessellator.count(patches.batch()).map_err(|error| status_of(&error))?;
    let needed = counted.counts();
    if counted.largest_index(numbering).is_some_and(|largest| largest > I::LARGEST) {
        return Err(TESS_INDEX_TOO_LARGE);
    }
    let written = match room.of_sizes(needed) {
        Some(room) if memory.is_initialised() => room.receive(&mut counted, numbering).map(drop),
        Some(room) => write(tessellator, patches, numbering, room, needed),
        None => Err(TESS_BUFFER_TOO_SMALL),
    };
    if matches!(written, Ok(()) | Err(TESS_BUFFER_TOO_SMALL)) {
        // SAFETY: `counts` is writable, as the caller promises, and apart from the buffers.
        unsafe { boundary::write(counts, needed.into()) }?;
    }
    written
}

/// The size of a part's output, in bytes, that stays in a core's nearest caches.
const PART_BYTES: usize = 1 << 18;

/// The patches of a part at most: as many as the batch backend keeps from counting to writing.
const PART_PATCHES: usize = 64;

/// Writes a batch into room of exactly its sizes.
///
/// The batch backend takes initialised slices. So that what has to be initialised does not go through memory twice,
/// that is done part by part, each just before its output is written.
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
        let (now, later) = room.split_at(counts).ok_or(crate::status::TESS_INTERNAL)?;
        let ranges = now.receive(&mut counted, numbering.behind(first.first_point))?;
        first = shift(ranges, first);
        room = later;
    }
    Ok(())
}

/// Moves a part's ranges to where it begins in the batch; gives where the next part begins.
fn shift(ranges: &mut [PatchRange], first: PatchRange) -> PatchRange {
    let mut end = first;
    for range in ranges {
        range.first_point += first.first_point;
        range.first_index += first.first_index;
        end.first_point = range.first_point + range.points;
        end.first_index = range.first_index + range.indices;
    }
    end
}

impl<'a, P: PointRoom<'a>, I: IndexFormat> BatchRoom<'a, P, I> {
    /// Has a counted batch written into room of exactly its sizes. Gives the ranges.
    fn receive(
        self,
        counted: &mut Counted<'_>,
        numbering: Numbering,
    ) -> Result<&'a mut [PatchRange], TessStatus> {
        let ranges = boundary::initialised(self.ranges, self.memory, PatchRange::default());
        let indices = boundary::initialised(self.indices, self.memory, I::default());
        let written = self.points.batch(self.memory, counted, numbering, (indices, &mut *ranges));
        written.map(|_| ranges).map_err(|error| status_of(&error))
    }

    /// Its beginning; `None` if it is smaller.
    fn of_sizes(self, counts: BatchCounts) -> Option<Self> {
        self.split_at(counts).map(|(first, _)| first)
    }

    /// Its beginning and the rest; `None` if it is smaller.
    fn split_at(self, counts: BatchCounts) -> Option<(Self, Self)> {
        let memory = self.memory;
        let (points, more_points) = self.points.split_at(counts.points)?;
        let (indices, more_indices) = self.indices.split_at_mut_checked(counts.indices)?;
        let (ranges, more_ranges) = self.ranges.split_at_mut_checked(counts.patches)?;
        Some((
            Self { points, indices, ranges, memory },
            Self { points: more_points, indices: more_indices, ranges: more_ranges, memory },
        ))
    }
}

//! One patch into the caller's buffers.

use super::input::Patches;
use super::output::in_formats;
use super::points::PointRoom;
use super::{TessBatch, TessBatchOutput, status_of};
use crate::boundary::{self, MemoryState};
use crate::shortage::{self, TESS_BUFFER_INDICES, TESS_BUFFER_POINTS};
use crate::status::{TESS_INTERNAL, TessStatus, answer};
use crate::types::TessCounts;
use std::mem::MaybeUninit;
use tess_core::{Counts, DomainPoint, PatchFactors};
use tess_simd::{Batch, CountedPatch, IndexFormat, Tessellator};

/// Tessellates one patch into the caller's buffers: `tess_batch_run` for callers that have one
/// patch at a time, such as drivers, emulators and test benches.
///
/// `factors` holds the factors of one patch: 2, 4 or 6 floats. The ranges, numbering and
/// `base_vertex` of `output` are ignored; indices count from the patch's first point. With
/// `TESS_OK` the output is written and `counts` has its sizes. With `TESS_BUFFER_TOO_SMALL` only
/// `counts` is written, with the sizes that are needed; `tess_shortage` names the buffer. With any
/// other status nothing is written. Up to 64 elements past the output may be overwritten in either
/// buffer, but never past its capacity; calls are fastest with that much room. Buffers, factors and
/// `counts` must not overlap (`TESS_OVERLAP`).
///
/// A call takes 43 to 68 ns for factors up to 8 (one core of a server with AVX-512). With
/// `TESS_MEMORY_INITIALISED` and the same factors as the previous patch, it takes 19 ns for factors
/// up to 4 and 28 ns for factor 8. It is faster than `tess_batch_run` with one patch, which counts
/// twice; for large patches the two take equally long. A call allocates if a patch has point counts
/// that are new to this batch; after `tess_batch_reserve` no call does.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
///
/// Other pointers that are not null and aligned must be valid:
/// - `factors` for reading as many floats as the domain has factors,
/// - `output` for reading one structure,
/// - its buffers for writing as many elements of their formats as their capacities state, and with
///   `TESS_MEMORY_INITIALISED` also for reading them,
/// - `counts` for writing one structure,
///
/// and no other thread may use any of them during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_patch(
    batch: *mut TessBatch,
    factors: *const f32,
    output: *const TessBatchOutput,
    counts: *mut TessCounts,
) -> TessStatus {
    answer(|| {
        boundary::check(batch)?;
        boundary::check(counts)?;
        // SAFETY: `output` is readable, as the caller promises.
        let output = unsafe { boundary::read(output) }?;
        // SAFETY: not null, made by `tess_batch_create` and in no other call, as promised.
        let batch = unsafe { &mut *batch };
        let run = in_formats!(output, run);
        // SAFETY: `factors`, `counts` and the buffers are as this function asks for them; the
        // element types are those of the formats.
        unsafe { run(batch, factors, &output, counts) }
    })
}

/// Tessellates a patch in one pair of formats.
///
/// # Safety
/// - As for [`tess_batch_patch`], with buffers of `P`'s points and of `I`.
unsafe fn run<'a, P: PointRoom<'a>, I: IndexFormat>(
    batch: &mut TessBatch,
    factors: *const f32,
    output: &TessBatchOutput,
    counts: *mut TessCounts,
) -> Result<(), TessStatus> {
    let number = batch.domain.factors();
    let points = (output.points.cast::<P::Point>(), output.point_capacity);
    let indices = (output.indices.cast::<I>(), output.index_capacity);
    boundary::check_all_apart(&[
        boundary::bytes(factors, number)?,
        boundary::bytes(points.0, points.1)?,
        boundary::bytes(indices.0, indices.1)?,
        boundary::bytes(counts, 1)?,
    ])?;
    // SAFETY: as many floats as the domain has factors, as the caller promises.
    let patches = unsafe { Patches::new(batch.domain, factors, number) }?;
    // SAFETY: the buffers are as the caller promises.
    let memory = unsafe { output.memory() }?;
    // SAFETY: writable, as the caller promises, and apart from all else, as was just checked.
    let points = unsafe { P::new(output.points, points.1) }?;
    // SAFETY: as above.
    let indices = unsafe { boundary::room(indices.0, indices.1) }?;
    let (tessellator, room) = (&mut batch.tessellator, (points, indices));
    let (written, needed) = match patches.batch() {
        Batch::Isolines(&[factors]) => write(tessellator, factors, room, memory),
        Batch::Triangles(&[factors]) => write(tessellator, factors, room, memory),
        Batch::Quads(&[factors]) => write(tessellator, factors, room, memory),
        _ => return Err(TESS_INTERNAL),
    };
    // SAFETY: `counts` is writable, as the caller promises, and apart from the buffers.
    unsafe { boundary::write(counts, needed.into()) }?;
    written
}

/// Writes a patch if there is room for it, and returns its sizes in any case. Uninitialised memory
/// is initialised as far as the patch may write it, which requires counting the patch first.
#[inline(always)]
fn write<'a, F: Copy + Into<PatchFactors>, P: PointRoom<'a>, I: IndexFormat>(
    tessellator: &mut Tessellator,
    factors: F,
    (mut points, mut indices): (P, &'a mut [MaybeUninit<I>]),
    memory: MemoryState,
) -> (Result<(), TessStatus>, Counts) {
    if !memory.is_initialised() {
        let needed = tessellator.count_patch(factors).counts();
        match room_of(needed, points, indices) {
            Ok(room) => (points, indices) = room,
            Err(status) => return (Err(status), needed),
        }
    }
    let indices = boundary::initialised(indices, memory, I::default());
    match points.patch(memory, tessellator, factors, indices) {
        Ok(written) => (Ok(()), written),
        Err(error) => (Err(status_of(&error)), tessellator.count_patch(factors).counts()),
    }
}

/// The room that a patch of these sizes may write.
fn room_of<'a, P: PointRoom<'a>, I>(
    needed: Counts,
    points: P,
    indices: &'a mut [MaybeUninit<I>],
) -> Result<(P, &'a mut [MaybeUninit<I>]), TessStatus> {
    let (point_count, index_count) = (needed.points as usize, needed.indices as usize);
    shortage::check(TESS_BUFFER_POINTS, point_count, points.len())?;
    shortage::check(TESS_BUFFER_INDICES, index_count, indices.len())?;
    let most = |needed: usize, room: usize| room.min(needed + CountedPatch::OVERRUN);
    let (point_end, index_end) =
        (most(point_count, points.len()), most(index_count, indices.len()));
    let (points, _) = points.split_at(point_end).ok_or(TESS_INTERNAL)?;
    Ok((points, &mut indices[..index_end]))
}

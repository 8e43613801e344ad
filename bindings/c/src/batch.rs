//! Many patches of one domain and configuration, through the batch backend.

mod input;
mod output;
mod points;
mod run;
mod single;

pub use output::{
    TESS_INDEX_U16, TESS_INDEX_U32, TESS_MEMORY_ANY, TESS_MEMORY_INITIALISED,
    TESS_NUMBERING_PER_BATCH, TESS_NUMBERING_PER_PATCH, TESS_POINT_F32, TESS_POINT_F32_APART,
    TESS_POINT_FIXED, TESS_POINTS_WITHOUT_RESTART_U16, TessBatchCounts, TessBatchOutput, TessRange,
};
pub use single::tess_batch_patch;

use crate::boundary;
use crate::shortage::{
    TESS_BUFFER_INDICES, TESS_BUFFER_POINTS, TESS_BUFFER_RANGES, TessShortage, report,
};
use crate::status::{
    TESS_INDEX_TOO_LARGE, TESS_INTERNAL, TESS_LEVEL_UNAVAILABLE, TESS_NO_THREADS,
    TESS_OUT_OF_RANGE, TESS_TOO_LARGE, TessStatus, answer,
};
use crate::types::{TessConfig, listed};
use input::Patches;
use output::in_formats;
use run::run;
use tess_core::{Domain, DomainPoint, Order};
use tess_simd::{BatchBuffer, Error, Level, PatchRange, Tessellator, group_ranges};

/// CPU level: the most capable one that this machine has.
pub const TESS_LEVEL_DETECT: u32 = 0;
/// CPU level: the instructions that the library was compiled for; always available.
pub const TESS_LEVEL_BASELINE: u32 = 1;
/// CPU level: AVX2 on x86-64.
pub const TESS_LEVEL_AVX2: u32 = 2;
/// CPU level: AVX-512 on x86-64, with the extensions of Ice Lake and Zen 4.
pub const TESS_LEVEL_AVX512: u32 = 3;

/// A tessellator for batches. `tess_batch_create` makes it, `tess_batch_free` frees it.
#[derive(Debug)]
pub struct TessBatch {
    tessellator: Tessellator,
    domain: Domain,
}

/// Makes a tessellator for batches of one domain in one configuration.
///
/// `level` is `TESS_LEVEL_...`. All levels produce the same bits. If this machine lacks the level,
/// the call returns `TESS_LEVEL_UNAVAILABLE`. The first call in a process with a configuration
/// takes about a millisecond, later ones a microsecond. The batch learns from patches, and its
/// memory grows by at most 1.2 MB per thread; `tess_batch_reserve` allocates all of it in advance.
/// Free the handle with `tess_batch_free`.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `batch` for writing one pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_create(
    config: *const TessConfig,
    level: u32,
    batch: *mut *mut TessBatch,
) -> TessStatus {
    answer(|| {
        boundary::check(batch)?;
        // SAFETY: `config` is readable, as the caller promises.
        let (config, domain) = unsafe { boundary::read(config) }?.decode()?;
        let tessellator = match level.checked_sub(1) {
            None => Tessellator::new(config),
            Some(number) => Tessellator::with_level(config, listed(&Level::ALL, number)?)
                .map_err(|_| TESS_LEVEL_UNAVAILABLE)?,
        };
        let made = Box::into_raw(Box::new(TessBatch { tessellator, domain }));
        // SAFETY: `batch` is writable, as the caller promises. It was checked above, so the box
        // cannot leak here.
        unsafe { boundary::write(batch, made) }
    })
}

/// Frees a batch. Null is allowed and does nothing.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, is not in use and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_free(batch: *mut TessBatch) {
    if !batch.is_null() {
        // SAFETY: it was made by `Box::into_raw` and nothing else owns it, as the caller promises.
        drop(unsafe { Box::from_raw(batch) });
    }
}

/// Allocates all memory that a batch can need, 1.2 MB per thread, so that no later call allocates.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_reserve(batch: *mut TessBatch) -> TessStatus {
    answer(|| {
        boundary::check(batch)?;
        // SAFETY: not null, made by `tess_batch_create` and in no other call, as promised.
        let batch = unsafe { &mut *batch };
        batch.tessellator.reserve();
        Ok(())
    })
}

/// Triangle order: the specification's.
pub const TESS_TRIANGLES_SPECIFIED: u32 = 0;
/// Triangle order: the same triangles and points, in columns that suit the vertex caches of GPUs.
pub const TESS_TRIANGLES_VERTEX_CACHE: u32 = 1;

/// Sets the order of triangles for later calls, `TESS_TRIANGLES_...`. A new batch uses the
/// specification's order.
///
/// `TESS_TRIANGLES_VERTEX_CACHE` is for renderers. With it, patches of more than about 300 points
/// take two to four times as long. The batch discards what it has learned from patches.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_set_triangles(batch: *mut TessBatch, order: u32) -> TessStatus {
    answer(|| {
        let order = listed(&[Order::Specification, Order::VertexCache], order)?;
        boundary::check(batch)?;
        // SAFETY: not null, made by `tess_batch_create` and in no other call, as promised.
        let batch = unsafe { &mut *batch };
        batch.tessellator.set_order(order);
        Ok(())
    })
}

/// Spreads later calls of `tess_batch_run` with `TESS_MEMORY_INITIALISED` over up to `threads`
/// threads. A new batch uses one; 0 returns `TESS_OUT_OF_RANGE`. The output does not depend on the
/// number of threads.
///
/// A call uses one thread for each 256 KiB of output. The threads belong to a pool that all batches
/// of the process share. It has one thread per processor, or as many as the environment variable
/// `RAYON_NUM_THREADS` states. Each thread takes up to 1.2 MB of memory. The batch discards what it
/// has learned from patches. If the system refuses to start threads, the call returns
/// `TESS_NO_THREADS` and changes nothing.
///
/// After `fork` the child may use batches that its parent made, with any number of threads: its
/// first large batch starts threads of its own. If it cannot start them, it tessellates on the
/// calling thread. No other thread may be in a call on these batches when the process forks.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_set_threads(batch: *mut TessBatch, threads: u32) -> TessStatus {
    answer(|| {
        if threads == 0 {
            return Err(TESS_OUT_OF_RANGE);
        }
        let threads = usize::try_from(threads).map_err(|_| TESS_OUT_OF_RANGE)?;
        boundary::check(batch)?;
        // SAFETY: not null, made by `tess_batch_create` and in no other call, as promised.
        let batch = unsafe { &mut *batch };
        if threads > 1 {
            Tessellator::start_threads().map_err(|_| TESS_NO_THREADS)?;
        }
        batch.tessellator.set_threads(threads);
        Ok(())
    })
}

/// Gets the CPU level of a batch, `TESS_LEVEL_...`.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`.
/// - `level`, if not null and aligned, is valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_level(batch: *const TessBatch, level: *mut u32) -> TessStatus {
    answer(|| {
        boundary::check(batch)?;
        // SAFETY: not null, and made by `tess_batch_create`, as the caller promises.
        let batch = unsafe { &*batch };
        let number = match batch.tessellator.level() {
            Level::Baseline => TESS_LEVEL_BASELINE,
            Level::Avx2 => TESS_LEVEL_AVX2,
            Level::Avx512 => TESS_LEVEL_AVX512,
            _ => return Err(TESS_INTERNAL), // a level without a number
        };
        // SAFETY: `level` is writable, as the caller promises.
        unsafe { boundary::write(level, number) }
    })
}

/// Computes the sizes of a batch's output.
///
/// `factors` holds the factors of one patch after another. `factor_count` is the number of floats;
/// if it is not a multiple of the domain's number of factors, the call returns
/// `TESS_WRONG_FACTOR_COUNT`.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
///
/// Other pointers that are not null and aligned must be valid:
/// - `factors` for reading `factor_count` floats,
/// - `counts` for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_count(
    batch: *mut TessBatch,
    factors: *const f32,
    factor_count: usize,
    counts: *mut TessBatchCounts,
) -> TessStatus {
    answer(|| {
        boundary::check(batch)?;
        // SAFETY: not null, made by `tess_batch_create` and in no other call, as promised.
        let batch = unsafe { &mut *batch };
        // SAFETY: `factor_count` readable floats, as the caller promises.
        let patches = unsafe { Patches::new(batch.domain, factors, factor_count) }?;
        let counted =
            batch.tessellator.count(patches.batch()).map_err(|error| status_of(&error))?;
        // SAFETY: `counts` is writable, as the caller promises.
        unsafe { boundary::write(counts, counted.counts().into()) }
    })
}

/// Tessellates a batch into the caller's buffers.
///
/// The factors are as for `tess_batch_count`. With `TESS_OK` the output is written and `counts` has
/// its sizes. With `TESS_BUFFER_TOO_SMALL` only `counts` is written, with the sizes that are
/// needed; `tess_shortage` names the buffer. With any other status nothing is written. No ranges
/// are written if `ranges` is null and `range_capacity` 0. Buffers, factors and `counts` must not
/// overlap (`TESS_OVERLAP`). A call allocates if a patch has point counts that are new to this
/// batch; after `tess_batch_reserve` no call does.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
///
/// Other pointers that are not null and aligned must be valid:
/// - `factors` for reading `factor_count` floats,
/// - `output` for reading one structure,
/// - its buffers for writing as many elements of their formats as their capacities state, and with
///   `TESS_MEMORY_INITIALISED` also for reading them,
/// - `counts` for writing one structure,
///
/// and no other thread may use any of them during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_run(
    batch: *mut TessBatch,
    factors: *const f32,
    factor_count: usize,
    output: *const TessBatchOutput,
    counts: *mut TessBatchCounts,
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
        unsafe { run(batch, (factors, factor_count), &output, counts) }
    })
}

/// Gets the range of each group of patches in a batch's output.
///
/// `ranges` holds the ranges of `patch_count` patches, as `tess_batch_run` wrote them. `starts`
/// holds the numbers of the patches at which `group_count` groups begin, in ascending order. A
/// group ends where the next one begins, the last one at the end of the batch. If a start is below
/// its predecessor, or past the end of the batch, the call returns `TESS_OUT_OF_RANGE` and writes
/// nothing. `groups` must not overlap the other arrays (`TESS_OVERLAP`).
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `ranges` for reading `patch_count` ranges,
/// - `starts` for reading `group_count` numbers,
/// - `groups` for writing `group_count` ranges,
///
/// and no other thread may write any of them during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_groups(
    ranges: *const TessRange,
    patch_count: usize,
    starts: *const u32,
    group_count: usize,
    groups: *mut TessRange,
) -> TessStatus {
    answer(|| {
        let written = boundary::bytes(groups, group_count)?;
        let read = [boundary::bytes(ranges, patch_count)?, boundary::bytes(starts, group_count)?];
        for read in read {
            boundary::check_all_apart(&[written.clone(), read])?;
        }
        // SAFETY: `patch_count` readable ranges, as the caller promises.
        let ranges = unsafe { boundary::list(ranges.cast::<PatchRange>(), patch_count) }?;
        // SAFETY: `group_count` readable numbers, as the caller promises.
        let starts = unsafe { boundary::list(starts, group_count) }?;
        // SAFETY: room for `group_count` ranges that overlaps nothing that is read, as was checked.
        let room = unsafe { boundary::room(groups, group_count) }?;
        let found = group_ranges(ranges, starts).map_err(|_| TESS_OUT_OF_RANGE)?;
        for (to, group) in room.iter_mut().zip(found) {
            to.write(group.into());
        }
        Ok(())
    })
}

fn status_of(error: &Error) -> TessStatus {
    let too_small = |buffer, needed, got| report(TessShortage { buffer, needed, got });
    match *error {
        Error::BufferTooSmall { buffer, needed, got } => match buffer {
            BatchBuffer::Points => too_small(TESS_BUFFER_POINTS, needed, got),
            BatchBuffer::Indices => too_small(TESS_BUFFER_INDICES, needed, got),
            BatchBuffer::Ranges => too_small(TESS_BUFFER_RANGES, needed, got),
            _ => TESS_INTERNAL, // a buffer without a number
        },
        Error::IndexTooLarge { .. } => TESS_INDEX_TOO_LARGE,
        Error::BatchTooLarge { .. } => TESS_TOO_LARGE,
        // Errors of columns, which batches from C do not have, and errors that are added later.
        _ => TESS_INTERNAL,
    }
}

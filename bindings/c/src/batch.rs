//! Many patches of one domain and configuration, through the batch backend.

mod input;
mod output;
mod points;
mod run;
mod single;

pub use output::{
    TESS_INDEX_U16, TESS_INDEX_U32, TESS_MEMORY_ANY, TESS_MEMORY_INITIALISED,
    TESS_NUMBERING_PER_BATCH, TESS_NUMBERING_PER_PATCH, TESS_POINT_F32, TESS_POINT_F32_APART,
    TESS_POINT_FIXED, TessBatchCounts, TessBatchOutput, TessRange,
};
pub use single::tess_batch_patch;

use crate::boundary;
use crate::status::{
    TESS_BUFFER_TOO_SMALL, TESS_INDEX_TOO_LARGE, TESS_INTERNAL, TESS_LEVEL_UNAVAILABLE,
    TESS_OUT_OF_RANGE, TESS_TOO_LARGE, TessStatus, answer,
};
use crate::types::{TessConfig, listed};
use input::Patches;
use output::in_formats;
use run::run;
use tess_core::{Domain, DomainPoint, Order};
use tess_simd::{Error, Level, PatchRange, Tessellator, group_ranges};

/// CPU level: the most capable one of this machine.
pub const TESS_LEVEL_DETECT: u32 = 0;
/// CPU level: what the library was compiled for; always available.
pub const TESS_LEVEL_BASELINE: u32 = 1;
/// CPU level: AVX2 on x86-64.
pub const TESS_LEVEL_AVX2: u32 = 2;
/// CPU level: AVX-512 on x86-64, as processors have it from Ice Lake and Zen 4 on.
pub const TESS_LEVEL_AVX512: u32 = 3;

/// Tessellates batches. Made by `tess_batch_create`, given back to `tess_batch_free`.
#[derive(Debug)]
pub struct TessBatch {
    tessellator: Tessellator,
    domain: Domain,
}

/// Makes a tessellator for batches of one domain in one configuration.
///
/// `level` is `TESS_LEVEL_...`; all levels give the same bits, and one that this machine lacks
/// gives `TESS_LEVEL_UNAVAILABLE`. The first call in a process with a configuration takes about a
/// millisecond, later ones a microsecond. What a batch learns of patches takes memory as it is used,
/// 1.1 MB at most. `tess_batch_reserve` takes all of it before.
/// Pass the handle stored in `batch` to `tess_batch_free` in the end.
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
        // SAFETY: `batch` is writable, as the caller promises; it was checked above, so that
        // nothing is lost here.
        unsafe { boundary::write(batch, made) }
    })
}

/// Frees what `tess_batch_create` made. Null is allowed and does nothing.
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

/// Takes all the memory that a batch may ever need, so that no later call with it allocates: 1.1 MB.
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
/// Triangle order: the same triangles and points, in columns that suit vertex caches of GPUs.
pub const TESS_TRIANGLES_VERTEX_CACHE: u32 = 1;

/// Sets the order in which later calls write triangles, `TESS_TRIANGLES_...`; at first it is the specification's.
///
/// `TESS_TRIANGLES_VERTEX_CACHE` is for renderers. Patches of more than about 300 points take two to four times as
/// long with it. What the batch learned of patches is forgotten.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_batch_set_triangles(batch: *mut TessBatch, order: u32) -> TessStatus {
    answer(|| {
        let order = listed(&[Order::Specification, Order::VertexCache], order)?;
        // SAFETY: as this function asks for it.
        unsafe { remade(batch, |tessellator| tessellator.order(order)) }
    })
}

/// Spreads later calls of `tess_batch_run` with `TESS_MEMORY_INITIALISED` over up to `threads` threads; at first it is
/// one. 0 gives `TESS_OUT_OF_RANGE`. The output stays the same.
///
/// A batch uses one thread for each 256 KiB of its output, of a pool that all batches of the process share. Each thread
/// takes up to 1.1 MB. What the batch learned of patches is forgotten.
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
        // SAFETY: as this function asks for it.
        unsafe { remade(batch, |tessellator| tessellator.threads(threads)) }
    })
}

/// Exchanges a batch's tessellator for another one.
///
/// # Safety
/// - As for [`tess_batch_reserve`].
unsafe fn remade(
    batch: *mut TessBatch,
    make: impl FnOnce(Tessellator) -> Tessellator,
) -> Result<(), TessStatus> {
    boundary::check(batch)?;
    // SAFETY: not null, made by `tess_batch_create` and in no other call, as promised.
    let batch = unsafe { &mut *batch };
    // Another one of the same configuration stands there meanwhile: it takes no memory.
    let another = Tessellator::new(batch.tessellator.config());
    batch.tessellator = make(std::mem::replace(&mut batch.tessellator, another));
    Ok(())
}

/// Says at which CPU level, `TESS_LEVEL_...`, a batch runs.
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
            _ => return Err(TESS_INTERNAL), // a level that has no number yet
        };
        // SAFETY: `level` is writable, as the caller promises.
        unsafe { boundary::write(level, number) }
    })
}

/// Says how large the output of a batch is.
///
/// `factors` holds the factors of one patch after another; `factor_count` counts floats and is a
/// multiple of the domain's number of factors, else `TESS_WRONG_FACTOR_COUNT`.
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
/// The factors are as for `tess_batch_count`. With `TESS_OK` the output is written and `counts` has its
/// sizes; with `TESS_BUFFER_TOO_SMALL` only `counts` is written, with what is needed; with any other
/// status nothing is. Buffers, factors and `counts` must not overlap (`TESS_OVERLAP`). A call allocates
/// where a patch has point counts that this batch has not met before; after `tess_batch_reserve` none does.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
///
/// Other pointers that are not null and aligned must be valid:
/// - `factors` for reading `factor_count` floats,
/// - `output` for reading one structure,
/// - the buffers that it names for writing as many elements of their formats as it says, and with
///   `TESS_MEMORY_INITIALISED` for reading them,
/// - `counts` for writing one structure,
///
/// and no other thread may use any of them at the same time.
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

/// Says where the output of each group of patches lies.
///
/// `ranges` has the range of each of `patch_count` patches, as `tess_batch_run` wrote them; `starts` has
/// the numbers of the patches at which `group_count` groups begin. A group ends where the next one
/// begins, the last one with the batch. A group that begins before the one before it, or past the end
/// of the batch, gives `TESS_OUT_OF_RANGE`, and nothing is written. `groups` must not overlap the others
/// (`TESS_OVERLAP`).
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `ranges` for reading `patch_count` ranges,
/// - `starts` for reading `group_count` numbers,
/// - `groups` for writing `group_count` ranges,
///
/// and no other thread may write any of them at the same time.
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
    match error {
        Error::BufferTooSmall { .. } => TESS_BUFFER_TOO_SMALL,
        Error::IndexTooLarge { .. } => TESS_INDEX_TOO_LARGE,
        Error::BatchTooLarge { .. } => TESS_TOO_LARGE,
        // Batches from C have no columns, and the list of errors may grow.
        _ => TESS_INTERNAL,
    }
}

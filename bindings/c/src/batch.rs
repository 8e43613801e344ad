//! Many patches of one domain and configuration, through the batch backend.

use crate::boundary;
use crate::status::{
    TESS_BUFFER_TOO_SMALL, TESS_INDEX_TOO_LARGE, TESS_INTERNAL, TESS_LEVEL_UNAVAILABLE,
    TESS_TOO_LARGE, TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT, TessStatus, answer,
};
use crate::types::{TessConfig, factors_of, listed};
use std::ffi::c_void;
use std::mem::{align_of, offset_of, size_of};
use tess_core::{Domain, DomainPoint, IsolineFactors, QuadFactors, TriangleFactors};
use tess_simd::{
    Batch, BatchCounts, Buffers, Error, IndexFormat, Level, Numbering, PatchRange, PointFormat,
    Tessellator,
};

/// CPU level: the most capable one of this machine.
pub const TESS_LEVEL_DETECT: u32 = 0;
/// CPU level: what the library was compiled for; always available.
pub const TESS_LEVEL_BASELINE: u32 = 1;
/// CPU level: AVX2 on x86-64.
pub const TESS_LEVEL_AVX2: u32 = 2;
/// CPU level: AVX-512 (F, BW, CD, DQ, VL) on x86-64.
pub const TESS_LEVEL_AVX512: u32 = 3;

/// Point format: `TessPoint`, a pair of unsigned 16.16 numbers.
pub const TESS_POINTS_FIXED: u32 = 0;
/// Point format: two floats, exactly the 16.16 numbers.
pub const TESS_POINTS_FLOAT: u32 = 1;

/// Index format: `uint32_t`.
pub const TESS_INDICES_32: u32 = 0;
/// Index format: `uint16_t`; always enough when each patch is numbered on its own.
pub const TESS_INDICES_16: u32 = 1;

/// Numbering: indices count from the first point of their patch.
pub const TESS_NUMBERING_PATCH: u32 = 0;
/// Numbering: indices count from the first point of the batch, which has number `base_vertex`.
pub const TESS_NUMBERING_BATCH: u32 = 1;

/// Tessellates batches. Made by `tess_batch_create`, given back to `tess_batch_free`.
#[derive(Debug)]
pub struct TessBatch {
    tessellator: Tessellator,
    domain: Domain,
}

/// Sizes of a batch's output.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessBatchCounts {
    /// Patches, culled ones included: elements of `ranges`.
    pub patches: usize,
    /// Elements of `points`.
    pub points: usize,
    /// Elements of `indices`.
    pub indices: usize,
}

/// Where one patch's output lies. A culled patch has no points and no indices.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessRange {
    /// Number of its first point in the batch's points.
    pub first_point: u32,
    /// Number of its points.
    pub points: u32,
    /// Number of its first index in the batch's indices.
    pub first_index: u32,
    /// Number of its indices.
    pub indices: u32,
}

/// Where and in what form a batch is written. Capacities count elements; a buffer of capacity 0
/// may be null.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TessBatchOutput {
    /// Points of all patches, one patch after another.
    pub points: *mut c_void,
    /// Room in `points`.
    pub point_capacity: usize,
    /// Indices of all patches, one patch after another.
    pub indices: *mut c_void,
    /// Room in `indices`.
    pub index_capacity: usize,
    /// One range for each patch.
    pub ranges: *mut TessRange,
    /// Room in `ranges`.
    pub range_capacity: usize,
    /// `TESS_POINTS_...`
    pub point_format: u32,
    /// `TESS_INDICES_...`
    pub index_format: u32,
    /// `TESS_NUMBERING_...`
    pub numbering: u32,
    /// Number of the batch's first point under `TESS_NUMBERING_BATCH`, else without effect.
    pub base_vertex: u32,
}

// The structures here have the layout of those that the batch backend writes and reads.
const _: () = {
    assert!(size_of::<TessRange>() == size_of::<PatchRange>(), "ranges have the same size");
    assert!(align_of::<TessRange>() == align_of::<PatchRange>(), "ranges have the same alignment");
    assert!(offset_of!(TessRange, first_point) == offset_of!(PatchRange, first_point), "field 1");
    assert!(offset_of!(TessRange, points) == offset_of!(PatchRange, points), "field 2");
    assert!(offset_of!(TessRange, first_index) == offset_of!(PatchRange, first_index), "field 3");
    assert!(offset_of!(TessRange, indices) == offset_of!(PatchRange, indices), "field 4");
    assert!(size_of::<DomainPoint>() == 8 && align_of::<DomainPoint>() == 4, "a pair of words");
    assert!(size_of::<IsolineFactors>() == 2 * size_of::<f32>(), "two factors");
    assert!(size_of::<TriangleFactors>() == 4 * size_of::<f32>(), "four factors");
    assert!(size_of::<QuadFactors>() == 6 * size_of::<f32>(), "six factors");
};

/// Makes a tessellator for batches of one domain in one configuration.
///
/// `level` is `TESS_LEVEL_...`; all levels give the same bits, and one that this machine lacks
/// gives `TESS_LEVEL_UNAVAILABLE`. Takes a few milliseconds and about a megabyte; make it once and
/// keep it. What is stored in `batch` is to be given to `tess_batch_free`.
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
        let patches = unsafe { patches(batch.domain, factors, factor_count) }?;
        let value = batch.tessellator.count(patches).map_err(|error| status_of(&error))?;
        // SAFETY: `counts` is writable, as the caller promises.
        unsafe { boundary::write(counts, value.into()) }
    })
}

/// Tessellates a batch into the caller's buffers.
///
/// Factors as for `tess_batch_count`. `counts` is written whenever the batch is valid, also when a
/// buffer is too small (`TESS_BUFFER_TOO_SMALL`; then nothing else is written). Buffers must not
/// overlap each other or the factors (`TESS_OVERLAP`). After the first call with a batch, none
/// allocates.
///
/// # Safety
/// - `batch` is null or came from `tess_batch_create`, and is in no other call at the same time.
///
/// Other pointers that are not null and aligned must be valid:
/// - `factors` for reading `factor_count` floats,
/// - `output` for reading one structure,
/// - the buffers that it names for reading and writing as many elements of their formats as it
///   says (a caller in Rust must have initialised them),
/// - `counts` for writing one structure, which lies in none of the buffers,
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
        let run = match (output.point_format, output.index_format) {
            (TESS_POINTS_FIXED, TESS_INDICES_32) => run::<DomainPoint, u32>,
            (TESS_POINTS_FIXED, TESS_INDICES_16) => run::<DomainPoint, u16>,
            (TESS_POINTS_FLOAT, TESS_INDICES_32) => run::<[f32; 2], u32>,
            (TESS_POINTS_FLOAT, TESS_INDICES_16) => run::<[f32; 2], u16>,
            _ => return Err(TESS_UNKNOWN_VALUE),
        };
        // SAFETY: `factors`, `counts` and the buffers are as this function asks for them; the
        // element types are those of the formats.
        unsafe { run(batch, (factors, factor_count), &output, counts) }
    })
}

/// Tessellates a batch in one pair of formats.
///
/// # Safety
/// - As for [`tess_batch_run`], the buffers' elements being `P` and `I`.
unsafe fn run<P: PointFormat, I: IndexFormat>(
    batch: &mut TessBatch,
    (factors, factor_count): (*const f32, usize),
    output: &TessBatchOutput,
    counts: *mut TessBatchCounts,
) -> Result<(), TessStatus> {
    let numbering = match output.numbering {
        TESS_NUMBERING_PATCH => Numbering::PerPatch,
        TESS_NUMBERING_BATCH => Numbering::Batch { base_vertex: output.base_vertex },
        _ => return Err(TESS_UNKNOWN_VALUE),
    };
    let points = (output.points.cast::<P>(), output.point_capacity);
    let indices = (output.indices.cast::<I>(), output.index_capacity);
    let ranges = (output.ranges.cast::<PatchRange>(), output.range_capacity);
    check_all_apart(&[
        boundary::bytes(factors, factor_count)?,
        boundary::bytes(points.0, points.1)?,
        boundary::bytes(indices.0, indices.1)?,
        boundary::bytes(ranges.0, ranges.1)?,
    ])?;
    // SAFETY: `factor_count` readable floats, as the caller promises.
    let patches = unsafe { patches(batch.domain, factors, factor_count) }?;
    let buffers = Buffers {
        // SAFETY: readable and writable, as the caller promises, and apart, as was just checked.
        points: unsafe { boundary::list_mut(points.0, points.1) }?,
        // SAFETY: as above.
        indices: unsafe { boundary::list_mut(indices.0, indices.1) }?,
        // SAFETY: as above; any bits are a range, and the layouts are the same.
        ranges: unsafe { boundary::list_mut(ranges.0, ranges.1) }?,
    };
    let written = match batch.tessellator.write(patches, numbering, buffers) {
        Err(Error::BufferTooSmall { .. }) => {
            let needed = batch.tessellator.count(patches).map_err(|error| status_of(&error))?;
            // SAFETY: `counts` is writable, as the caller promises.
            unsafe { boundary::write(counts, needed.into()) }?;
            return Err(TESS_BUFFER_TOO_SMALL);
        }
        Err(error) => return Err(status_of(&error)),
        Ok(written) => written,
    };
    // SAFETY: `counts` is writable, as the caller promises.
    unsafe { boundary::write(counts, written.into()) }
}

/// Refuses buffers of which any two share memory.
fn check_all_apart(buffers: &[boundary::Bytes]) -> Result<(), TessStatus> {
    for (i, a) in buffers.iter().enumerate() {
        for b in buffers.iter().skip(i + 1) {
            boundary::check_apart(a, b)?;
        }
    }
    Ok(())
}

/// The patches whose factors lie in a caller's array.
///
/// # Safety
/// - If not null and aligned, `factors` points to `factor_count` floats that can be read and are
///   not written while the batch lives.
unsafe fn patches<'a>(
    domain: Domain,
    factors: *const f32,
    factor_count: usize,
) -> Result<Batch<'a>, TessStatus> {
    let size = factors_of(domain);
    if !factor_count.is_multiple_of(size) {
        return Err(TESS_WRONG_FACTOR_COUNT);
    }
    let count = factor_count / size;
    Ok(match domain {
        // SAFETY: a structure of factors is as many floats, so `count` of them can be read.
        Domain::Isoline => Batch::Isolines(unsafe { boundary::list(factors.cast(), count) }?),
        // SAFETY: as above.
        Domain::Triangle => Batch::Triangles(unsafe { boundary::list(factors.cast(), count) }?),
        // SAFETY: as above.
        Domain::Quad => Batch::Quads(unsafe { boundary::list(factors.cast(), count) }?),
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

impl From<BatchCounts> for TessBatchCounts {
    fn from(counts: BatchCounts) -> Self {
        let BatchCounts { patches, points, indices } = counts;
        Self { patches, points, indices }
    }
}

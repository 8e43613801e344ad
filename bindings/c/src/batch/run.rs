//! A batch into the caller's buffers, in the formats that the caller chose.

use super::{
    TESS_NUMBERING_BATCH, TESS_NUMBERING_PATCH, TessBatch, TessBatchCounts, TessBatchOutput,
    patches, status_of,
};
use crate::boundary;
use crate::status::{TESS_UNKNOWN_VALUE, TessStatus};
use tess_simd::{Buffers, Error, IndexFormat, Numbering, PatchRange, PointFormat};

/// Tessellates a batch in one pair of formats.
///
/// # Safety
/// - As for [`super::tess_batch_run`], the buffers' elements being `P` and `I`.
pub(super) unsafe fn run<P: PointFormat, I: IndexFormat>(
    batch: &mut TessBatch,
    (factors, factor_count): (*const f32, usize),
    output: &TessBatchOutput,
    counts: *mut TessBatchCounts,
) -> Result<(), TessStatus> {
    let numbering = match output.numbering {
        TESS_NUMBERING_PATCH => Numbering::PerPatch,
        TESS_NUMBERING_BATCH => Numbering::PerBatch { base_vertex: output.base_vertex },
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
    // SAFETY: readable and writable, as the caller promises, and apart, as was just checked.
    let points = unsafe { boundary::list_mut(points.0, points.1) }?;
    // SAFETY: as above.
    let indices = unsafe { boundary::list_mut(indices.0, indices.1) }?;
    // SAFETY: as above; any bits are a range, and the layouts are the same.
    let ranges = unsafe { boundary::list_mut(ranges.0, ranges.1) }?;
    let buffers = Buffers::new(points, indices).with_ranges(ranges);
    let mut counted = batch.tessellator.count(patches).map_err(|error| status_of(&error))?;
    match counted.write(numbering, buffers) {
        Ok(written) => {
            // SAFETY: `counts` is writable, as the caller promises.
            unsafe { boundary::write(counts, written.into()) }
        }
        Err(error) => {
            if let Error::BufferTooSmall { .. } = error {
                // SAFETY: `counts` is writable, as the caller promises.
                unsafe { boundary::write(counts, counted.counts().into()) }?;
            }
            Err(status_of(&error))
        }
    }
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

//! Whole patches, into the caller's buffers.

use crate::boundary;
use crate::shortage::{self, TESS_BUFFER_INDICES, TESS_BUFFER_POINTS};
use crate::status::{TessStatus, answer};
use crate::types::{self, TessConfig, TessCounts, TessPoint};
use std::mem::MaybeUninit;
use tess_core::{DomainPoint, Primitive, Sink};

/// Counts the points, primitives and indices of a patch.
///
/// Any bit pattern of any factor is valid; a culled patch has no points and no indices.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `factors` for reading `factor_count` floats,
/// - `counts` for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_count(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    counts: *mut TessCounts,
) -> TessStatus {
    // SAFETY: the requirements are those of this function.
    unsafe {
        types::of_patch((config, factors, factor_count), counts, |patch| Some(patch.counts()))
    }
}

/// Tessellates a patch into the caller's buffers.
///
/// With `TESS_OK` the output is written and `counts` has its sizes. With `TESS_BUFFER_TOO_SMALL`
/// only `counts` is written, with the sizes that are needed; `tess_shortage` names the buffer. With
/// any other status nothing is written. Buffers and `counts` must not overlap (`TESS_OVERLAP`). A
/// buffer of capacity 0 may be null. `TESS_MAX_POINTS` and `TESS_MAX_INDICES` are enough for any
/// patch. The call does not allocate.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `factors` for reading `factor_count` floats,
/// - `points` for writing `point_capacity` points,
/// - `indices` for writing `index_capacity` indices,
/// - `counts` for writing one structure,
///
/// and no other thread may use the memory that is written during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_patch(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    points: *mut TessPoint,
    point_capacity: usize,
    indices: *mut u32,
    index_capacity: usize,
    counts: *mut TessCounts,
) -> TessStatus {
    answer(|| {
        // SAFETY: `config` and `factors` are readable, as the caller promises.
        let patch = unsafe { types::patch(config, factors, factor_count) }?;
        boundary::check(counts)?;
        boundary::check_all_apart(&[
            boundary::bytes(points, point_capacity)?,
            boundary::bytes(indices, index_capacity)?,
            boundary::bytes(counts, 1)?,
        ])?;
        let needed = patch.counts();
        // SAFETY: writable, as the caller promises, and apart from the indices and `counts`; the
        // inputs were copied, so nothing else is read or written.
        let points = unsafe { boundary::room(points, point_capacity) }?;
        // SAFETY: as above.
        let indices = unsafe { boundary::room(indices, index_capacity) }?;
        // SAFETY: `counts` is writable, as the caller promises, and apart from the buffers.
        unsafe { boundary::write(counts, needed.into()) }?;
        shortage::check(TESS_BUFFER_POINTS, needed.points as usize, points.len())?;
        shortage::check(TESS_BUFFER_INDICES, needed.indices as usize, indices.len())?;
        patch.emit(&mut PatchRoom { points: points.iter_mut(), indices: indices.iter_mut() });
        Ok(())
    })
}

/// Fills a caller's buffers, which have room for the patch.
struct PatchRoom<'a> {
    points: std::slice::IterMut<'a, MaybeUninit<TessPoint>>,
    indices: std::slice::IterMut<'a, MaybeUninit<u32>>,
}

impl Sink for PatchRoom<'_> {
    fn point(&mut self, point: DomainPoint) {
        if let Some(slot) = self.points.next() {
            slot.write(point.into());
        }
    }

    fn primitive(&mut self, primitive: Primitive) {
        for (&index, slot) in primitive.indices().iter().zip(self.indices.by_ref()) {
            slot.write(index);
        }
    }
}

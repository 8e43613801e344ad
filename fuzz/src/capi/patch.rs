//! `tess_patch` and `tess_count`.

use super::hostile::{CANARY, Hostile, NO_POINT, Wrongs};
use crate::input::Bytes;
use crate::{compare_with_model, repeatable};
use tess_capi::patch::{tess_count, tess_patch};
use tess_capi::status::{TESS_BUFFER_TOO_SMALL, TESS_OK, TESS_TOO_LARGE};
use tess_capi::types::{TessCounts, TessPoint};
use tess_core::{DomainPoint, Tessellation};

const NO_COUNTS: TessCounts = TessCounts { points: CANARY, primitives: CANARY, indices: CANARY };

pub(super) fn check(bytes: &mut Bytes<'_>) -> Result<(), String> {
    let mut wrongs = Wrongs::default();
    let mut hostile = Hostile::new(bytes, &mut wrongs);
    let model = hostile.case.patch().tessellate();
    let (point_capacity, point_room) = capacity(bytes, model.points.len());
    let (index_capacity, index_room) = capacity(bytes, model.indices.len());
    let mut points = vec![NO_POINT; point_room];
    let mut indices = vec![CANARY; index_room];
    let mut counts = NO_COUNTS;

    let config = wrongs.pointer(bytes, &raw mut hostile.config);
    let factors = wrongs.pointer(bytes, hostile.factors.as_mut_ptr());
    let counts_pointer = wrongs.pointer(bytes, &raw mut counts);
    let count_status =
        // SAFETY: each pointer is null, misaligned or to memory as large as the call claims.
        unsafe { tess_count(config, factors, hostile.factor_count, counts_pointer) };
    wrongs.judge("tess_count", &hostile.case, count_status)?;
    let valid = wrongs.is_empty();
    counts = NO_COUNTS;

    wrongs.add_if(!is_possible(point_capacity, size_of::<TessPoint>()), TESS_TOO_LARGE);
    wrongs.add_if(!is_possible(index_capacity, size_of::<u32>()), TESS_TOO_LARGE);
    wrongs.add_if(point_capacity < model.points.len(), TESS_BUFFER_TOO_SMALL);
    wrongs.add_if(index_capacity < model.indices.len(), TESS_BUFFER_TOO_SMALL);
    let to_points = wrongs.room(bytes, points.as_mut_ptr(), point_capacity);
    let to_indices = wrongs.room(bytes, indices.as_mut_ptr(), index_capacity);
    // SAFETY: as above; a capacity beyond the memory is impossible, and is refused.
    let status = unsafe {
        let n = hostile.factor_count;
        tess_patch(
            config,
            factors,
            n,
            to_points,
            point_capacity,
            to_indices,
            index_capacity,
            counts_pointer,
        )
    };
    wrongs.judge("tess_patch", &hostile.case, status)?;

    let is_reported = valid && matches!(status, TESS_OK | TESS_BUFFER_TOO_SMALL);
    let expected =
        if is_reported { TessCounts::from(hostile.case.patch().counts()) } else { NO_COUNTS };
    if counts != expected {
        let message = format!("tess_patch: {counts:?}, expected {expected:?}");
        return Err(repeatable(&hostile.case, &message));
    }
    let used = if wrongs.is_empty() { (model.points.len(), model.indices.len()) } else { (0, 0) };
    let untouched = points[used.0..].iter().all(|&point| point == NO_POINT)
        && indices[used.1..].iter().all(|&index| index == CANARY);
    if !untouched {
        return Err(repeatable(&hostile.case, "tess_patch wrote where it must not"));
    }
    if !wrongs.is_empty() {
        return Ok(());
    }
    let points = points[..used.0].iter().map(|point| DomainPoint::from_bits(point.u, point.v));
    let observed = Tessellation { points: points.collect(), indices: indices[..used.1].to_vec() };
    compare_with_model("tess_patch", &hostile.case, observed, &model)
}

/// Whether memory can have this many elements of a size.
pub(super) fn is_possible(count: usize, size: usize) -> bool {
    count.checked_mul(size).is_some_and(|bytes| isize::try_from(bytes).is_ok())
}

/// A capacity near the needed one or far beyond it, and the number of elements that really exist.
pub(super) fn capacity(bytes: &mut Bytes<'_>, needed: usize) -> (usize, usize) {
    let around = |delta: usize| (needed + delta).saturating_sub(2);
    match bytes.byte() % 16 {
        0 => (0, 0),
        1 => (usize::MAX, needed),
        2 => (usize::MAX / 8 + 1, needed),
        3 => (usize::MAX / 4 + 1, needed),
        delta @ 4..=8 => (around(usize::from(delta) - 4), around(usize::from(delta) - 4)),
        _ => (needed, needed),
    }
}

//! One whole patch at a time, held for a test bench that reads all of its elements.
//!
//! `tess_dpi_point` and `tess_dpi_primitive` compute one element of any patch. A bench that
//! compares whole patches opens a configuration once, passes it one patch after another, and reads
//! points and indices from memory. The patches are tessellated as by
//! [`tess_batch_patch`](crate::batch::tess_batch_patch).

use super::{factors_of, sizes, write_each};
use crate::boundary;
use crate::status::{TESS_INTERNAL, TESS_OUT_OF_RANGE, TessStatus, answer};
use crate::types::{TessConfig, TessPoint};
use tess_core::{Counts, Domain, DomainPoint, MAX_INDICES, MAX_POINTS};
use tess_simd::{CountedPatch, Tessellator};

/// A configuration and the patch that was tessellated last. `tess_dpi_open` makes it,
/// `tess_dpi_close` frees it.
#[derive(Debug)]
pub struct TessHeldPatch {
    tessellator: Tessellator,
    domain: Domain,
    counts: Counts,
    /// Room for the largest patch.
    points: Vec<DomainPoint>,
    indices: Vec<u32>,
}

/// Makes a handle that holds one patch of a configuration at a time. Before the first patch it has
/// no elements.
///
/// # Safety
/// - `held`, if not null and aligned, must be valid for writing one pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_open(
    domain: u32,
    partitioning: u32,
    output: u32,
    split_order: u32,
    held: *mut *mut TessHeldPatch,
) -> TessStatus {
    answer(|| {
        boundary::check(held)?;
        let config = TessConfig { domain, partitioning, output, split: split_order };
        let (config, domain) = config.decode()?;
        let made = Box::into_raw(Box::new(TessHeldPatch {
            tessellator: Tessellator::new(config),
            domain,
            counts: Counts::default(),
            points: vec![DomainPoint::default(); MAX_POINTS + CountedPatch::OVERRUN],
            indices: vec![0; MAX_INDICES + CountedPatch::OVERRUN],
        }));
        // SAFETY: `held` is writable, as the caller promises. It was checked above, so the box
        // cannot leak here.
        unsafe { boundary::write(held, made) }
    })
}

/// Frees a handle. Null is allowed and does nothing.
///
/// # Safety
/// - `held` is null or came from `tess_dpi_open`, is not in use and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_close(held: *mut TessHeldPatch) {
    if !held.is_null() {
        // SAFETY: it was made by `Box::into_raw` and nothing else owns it, as the caller promises.
        drop(unsafe { Box::from_raw(held) });
    }
}

/// Tessellates a patch, holds it in place of the previous one, and writes its sizes. A refused call
/// keeps the previous patch.
///
/// # Safety
/// - `held` is null or came from `tess_dpi_open`, and is in no other call at the same time.
/// - Every other pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_patch(
    held: *mut TessHeldPatch,
    f0: u32,
    f1: u32,
    f2: u32,
    f3: u32,
    f4: u32,
    f5: u32,
    points: *mut u32,
    primitives: *mut u32,
    indices: *mut u32,
) -> TessStatus {
    answer(|| {
        boundary::check(held)?;
        // SAFETY: not null, made by `tess_dpi_open` and in no other call, as the caller promises.
        let held = unsafe { &mut *held };
        for pointer in [points, primitives, indices] {
            boundary::check(pointer)?;
        }
        let factors = factors_of(held.domain, [f0, f1, f2, f3, f4, f5]);
        let written = held.tessellator.patch(factors, &mut held.points, &mut held.indices);
        held.counts = written.map_err(|_| TESS_INTERNAL)?; // no patch is larger than the room
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each([points, primitives, indices], sizes(held.counts)) }
    })
}

/// Point `i` of the held patch.
///
/// # Safety
/// - `held` is null or came from `tess_dpi_open`.
/// - `u` and `v`, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_held_point(
    held: *const TessHeldPatch,
    i: u32,
    u: *mut u32,
    v: *mut u32,
) -> TessStatus {
    answer(|| {
        boundary::check(held)?;
        // SAFETY: not null, and made by `tess_dpi_open`, as the caller promises.
        let held = unsafe { &*held };
        let points = held.points.get(..held.counts.points as usize).ok_or(TESS_INTERNAL)?;
        let point = TessPoint::from(*points.get(i as usize).ok_or(TESS_OUT_OF_RANGE)?);
        // SAFETY: both are writable, as the caller promises.
        unsafe { write_each([u, v], [point.u, point.v]) }
    })
}

/// Index `i` of the held patch.
///
/// # Safety
/// - `held` is null or came from `tess_dpi_open`.
/// - `index`, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_held_index(
    held: *const TessHeldPatch,
    i: u32,
    index: *mut u32,
) -> TessStatus {
    answer(|| {
        boundary::check(held)?;
        // SAFETY: not null, and made by `tess_dpi_open`, as the caller promises.
        let held = unsafe { &*held };
        let indices = held.indices.get(..held.counts.indices as usize).ok_or(TESS_INTERNAL)?;
        let found = *indices.get(i as usize).ok_or(TESS_OUT_OF_RANGE)?;
        // SAFETY: it is writable, as the caller promises.
        unsafe { write_each([index], [found]) }
    })
}

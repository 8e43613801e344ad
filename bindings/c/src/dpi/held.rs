//! A patch that a test bench holds while it asks for its elements.
//!
//! The model processes the factors once, when the patch is set. It then computes each element from
//! its number, in constant time and without memory for the others.

use super::{case, write_each};
use crate::boundary;
use crate::probe::TessPrimitive;
use crate::status::{TESS_OUT_OF_RANGE, TessStatus, answer};
use crate::types::{TessConfig, TessPoint};
use tess_core::Patch;

/// A patch, or none before the first. `tess_dpi_open` makes it, `tess_dpi_close` frees it.
#[derive(Debug)]
pub struct TessHeldPatch(Option<Patch>);

/// Makes a handle that holds one patch at a time. Before the first patch it has no elements.
///
/// # Safety
/// - `held`, if not null and aligned, must be valid for writing one pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_open(held: *mut *mut TessHeldPatch) -> TessStatus {
    answer(|| {
        boundary::check(held)?;
        let made = Box::into_raw(Box::new(TessHeldPatch(None)));
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

/// Holds a patch in place of the previous one, and writes its sizes. A refused call keeps the
/// previous patch.
///
/// # Safety
/// - `held` is null or came from `tess_dpi_open`, and is in no other call at the same time.
/// - Every other pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_patch(
    held: *mut TessHeldPatch,
    domain: u32,
    partitioning: u32,
    output: u32,
    split_order: u32,
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
        let config = TessConfig { domain, partitioning, output, split: split_order };
        let patch = case(config, [f0, f1, f2, f3, f4, f5])?.patch();
        let counts = patch.counts();
        let sizes = [counts.points, counts.primitives, counts.indices];
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each([points, primitives, indices], sizes) }?;
        // SAFETY: not null, made by `tess_dpi_open` and in no other call, as the caller promises.
        unsafe { (*held).0 = Some(patch) };
        Ok(())
    })
}

/// Point `i` of the held patch.
///
/// # Safety
/// - `held` is null or came from `tess_dpi_open`.
/// - `u` and `v`, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_point(
    held: *const TessHeldPatch,
    i: u32,
    u: *mut u32,
    v: *mut u32,
) -> TessStatus {
    answer(|| {
        boundary::check(held)?;
        // SAFETY: not null, and made by `tess_dpi_open`, as the caller promises.
        let TessHeldPatch(patch) = unsafe { &*held };
        let point = patch.and_then(|patch| patch.point(i)).ok_or(TESS_OUT_OF_RANGE)?;
        let TessPoint { u: found_u, v: found_v } = point.into();
        // SAFETY: both are writable, as the caller promises.
        unsafe { write_each([u, v], [found_u, found_v]) }
    })
}

/// Primitive `t` of the held patch: its number of indices, 1 to 3, and the indices; those that it
/// has not are 0.
///
/// # Safety
/// - `held` is null or came from `tess_dpi_open`.
/// - Every other pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_primitive(
    held: *const TessHeldPatch,
    t: u32,
    size: *mut u32,
    i0: *mut u32,
    i1: *mut u32,
    i2: *mut u32,
) -> TessStatus {
    answer(|| {
        boundary::check(held)?;
        // SAFETY: not null, and made by `tess_dpi_open`, as the caller promises.
        let TessHeldPatch(patch) = unsafe { &*held };
        let primitive = patch.and_then(|patch| patch.primitive(t)).ok_or(TESS_OUT_OF_RANGE)?;
        let TessPrimitive { size: vertices, indices: [a, b, c], .. } = primitive.into();
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each([size, i0, i1, i2], [vertices, a, b, c]) }
    })
}

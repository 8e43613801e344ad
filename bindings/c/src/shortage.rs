//! The buffer that was too small.

use crate::boundary;
use crate::status::{TESS_BUFFER_TOO_SMALL, TESS_OUT_OF_RANGE, TessStatus, answer};
use std::cell::Cell;

/// Buffer: the points.
pub const TESS_BUFFER_POINTS: u32 = 0;
/// Buffer: the indices.
pub const TESS_BUFFER_INDICES: u32 = 1;
/// Buffer: the ranges, one for each patch.
pub const TESS_BUFFER_RANGES: u32 = 2;

/// A buffer that was too small. If several were, it is the first of ranges, points, indices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TessShortage {
    /// `TESS_BUFFER_...`
    pub buffer: u32,
    /// Number of elements that the output needs.
    pub needed: usize,
    /// Number of elements that the buffer had room for: its capacity.
    pub got: usize,
}

thread_local! {
    static LAST: Cell<Option<TessShortage>> = const { Cell::new(None) };
}

/// Gets the buffer that was too small in the calling thread's last call that returned
/// `TESS_BUFFER_TOO_SMALL`. Returns `TESS_OUT_OF_RANGE` if there was no such call.
///
/// # Safety
/// - `shortage`, if not null and aligned, is valid for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_shortage(shortage: *mut TessShortage) -> TessStatus {
    answer(|| {
        let last = LAST.get().ok_or(TESS_OUT_OF_RANGE)?;
        // SAFETY: `shortage` is writable, as the caller promises.
        unsafe { boundary::write(shortage, last) }
    })
}

/// Refuses a buffer that has room for fewer elements than are needed.
pub(crate) fn check(buffer: u32, needed: usize, got: usize) -> Result<(), TessStatus> {
    if got < needed { Err(report(TessShortage { buffer, needed, got })) } else { Ok(()) }
}

/// Keeps a shortage for [`tess_shortage`] and returns its status.
pub(crate) fn report(shortage: TessShortage) -> TessStatus {
    LAST.set(Some(shortage));
    TESS_BUFFER_TOO_SMALL
}

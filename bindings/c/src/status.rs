//! Status numbers of the functions, and their meanings.

use std::ffi::{CStr, c_char};

/// The result of a call: `TESS_OK`, or the reason for which it was refused.
pub type TessStatus = u32;

/// Done.
pub const TESS_OK: TessStatus = 0;
/// A required pointer is null.
pub const TESS_NULL_POINTER: TessStatus = 1;
/// A pointer is not aligned for its type.
pub const TESS_MISALIGNED: TessStatus = 2;
/// An enumeration (domain, partitioning, ...) has an unknown value.
pub const TESS_UNKNOWN_VALUE: TessStatus = 3;
/// The number of factors does not fit the domain: 2 (isoline), 4 (triangle) or 6 (quad) per patch.
pub const TESS_WRONG_FACTOR_COUNT: TessStatus = 4;
/// A buffer is too small. The call has written the sizes that are needed to its counts, and
/// `tess_shortage` names the buffer.
pub const TESS_BUFFER_TOO_SMALL: TessStatus = 5;
/// The patch or edge has no element with this number, or a number is outside its range.
pub const TESS_OUT_OF_RANGE: TessStatus = 6;
/// No factor has this context.
pub const TESS_NOT_A_CONTEXT: TessStatus = 7;
/// Two buffers share memory, and one of them is written.
pub const TESS_OVERLAP: TessStatus = 8;
/// A size exceeds the address space, or a batch has more than 2^32 - 1 points or indices.
pub const TESS_TOO_LARGE: TessStatus = 9;
/// An index does not fit the index format: use wider indices, or number each patch from 0.
pub const TESS_INDEX_TOO_LARGE: TessStatus = 10;
/// This machine or this build cannot run the CPU level.
pub const TESS_LEVEL_UNAVAILABLE: TessStatus = 11;
/// A defect of this library; nothing was written.
pub const TESS_INTERNAL: TessStatus = 12;
/// A tessellator under test differs from the model (`tess_fuzz`), or breaks a rule
/// (`tess_check_rules`).
pub const TESS_DIFFERENT: TessStatus = 13;
/// Nothing was compared: the tessellator under test does not have the configuration.
pub const TESS_LEFT_OUT: TessStatus = 14;
/// The system refused to start threads.
pub const TESS_NO_THREADS: TessStatus = 15;

/// Every status with its message, in the order of their numbers.
const MESSAGES: [&CStr; 16] = [
    c"done",
    c"a pointer is null",
    c"a pointer is not aligned",
    c"an enumeration has an unknown value",
    c"the number of factors does not fit the domain",
    c"a buffer is too small (tess_shortage names it)",
    c"a number is out of range: 0, or past the last element",
    c"no factor has this context",
    c"two buffers overlap",
    c"a size is too large",
    c"an index does not fit the index format",
    c"the CPU level is not available",
    c"a defect of the library",
    c"the tessellator differs from what is right",
    c"nothing was compared",
    c"no more threads can be started",
];

/// Meaning of a status, in English, without a newline.
///
/// Never null: an unknown number gives "unknown status". The text lives as long as the program and
/// must not be freed.
#[unsafe(no_mangle)]
pub extern "C" fn tess_status_message(status: TessStatus) -> *const c_char {
    let message = usize::try_from(status).ok().and_then(|status| MESSAGES.get(status));
    message.copied().unwrap_or(c"unknown status").as_ptr()
}

/// Runs the body of a function and turns its result into a status.
pub(crate) fn answer(work: impl FnOnce() -> Result<(), TessStatus>) -> TessStatus {
    match work() {
        Ok(()) => TESS_OK,
        Err(status) => status,
    }
}

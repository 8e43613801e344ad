//! The C interface with hostile arguments: wrong pointers, sizes, numbers and counts.
//!
//! Each call may have any number of faults. The oracle: a call without a fault answers `TESS_OK`
//! and the core's result; any other call answers a status that one of its faults explains, and
//! writes nothing. Buffers are exactly as large as they have to be, so that the address sanitizer
//! detects any access beyond them.

mod batch;
mod hostile;
mod patch;
mod probe;

use crate::input::Bytes;

/// Makes one call of a function that the first byte selects. Errors: a description of the wrong
/// answer or write.
pub fn check(data: &[u8]) -> Result<(), String> {
    let mut bytes = Bytes(data);
    match bytes.byte() % 4 {
        0 => patch::check(&mut bytes),
        1 => probe::check_element(&mut bytes),
        2 => probe::check_place(&mut bytes),
        _ => batch::check(&mut bytes),
    }
}

//! The C interface with hostile arguments: wrong pointers, sizes, numbers and counts.
//!
//! Each call may have any number of things wrong with it. The oracle: with nothing wrong it answers
//! `TESS_OK` and gives what the core gives; otherwise it answers a status that one of the wrong
//! things explains, and writes nothing. Buffers are exactly as large as they have to be, so that
//! the address sanitizer sees any access beyond them.

mod batch;
mod hostile;
mod patch;
mod probe;

use crate::input::Bytes;

/// Makes one call of a function that the first byte chooses. Errors: description of the wrong
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

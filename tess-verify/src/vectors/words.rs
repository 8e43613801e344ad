//! Parts that both forms of a listing share: the last line, coordinates in hex, and limits.

use super::error::VectorError;
use super::lines::Line;
use crate::quote::quoted;
use std::fmt;

/// Checks the last line of a listing.
///
/// # Errors
/// The line is not `end`.
pub(super) fn end(line: Line<'_>) -> Result<(), VectorError> {
    if line.text == "end" {
        return Ok(());
    }
    Err(line.error("end", format!("a listing ends with `end`, not {}", quoted(line.text))))
}

/// The message for a number of elements that is larger than any patch's.
pub(super) fn too_many(count: impl fmt::Display, most: usize) -> String {
    format!("{count} is too many: a patch has at most {most}")
}

/// A 16.16 number of 5 to 8 hex digits. With fewer allowed, the float 1 could pass as 2^-16.
pub(super) fn coordinate(text: &str) -> Option<u32> {
    let append = |number, byte: &u8| Some(number << 4 | char::from(*byte).to_digit(16)?);
    (5..=8).contains(&text.len()).then(|| text.as_bytes().iter().try_fold(0, append)).flatten()
}

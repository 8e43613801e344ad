//! Shared by both forms of a listing: its last line, its coordinates in hex, its limits.

use super::error::VectorError;
use super::lines::Line;
use crate::quote::quoted;
use std::fmt;

/// The last line of a listing.
///
/// # Errors
/// Any other line.
pub(super) fn end(line: Line<'_>) -> Result<(), VectorError> {
    if line.text == "end" {
        return Ok(());
    }
    Err(line.error("end", format!("a listing ends with `end`, not {}", quoted(line.text))))
}

/// The message that a number of elements is above the most that a patch has.
pub(super) fn too_many(count: impl fmt::Display, most: usize) -> String {
    format!("{count} is too many: a patch has at most {most}")
}

/// A 16.16 number of 5 to 8 hex digits. Fewer would let the float 1 pass for 2^-16.
pub(super) fn coordinate(text: &str) -> Option<u32> {
    let append = |number, byte: &u8| Some(number << 4 | char::from(*byte).to_digit(16)?);
    (5..=8).contains(&text.len()).then(|| text.as_bytes().iter().try_fold(0, append)).flatten()
}

//! Pieces of text that the readers share.

/// Most characters of a file's text that a message repeats.
const SHOWN: usize = 60;

/// A file's bytes without the byte order mark of UTF-8.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}

/// A piece of a file in quotes, for a message: cut if it is long, bytes that are no text escaped.
pub(super) fn quoted(piece: &[u8]) -> String {
    let piece = piece.trim_ascii();
    // A character has at most four bytes.
    let text = String::from_utf8_lossy(&piece[..piece.len().min(4 * SHOWN)]);
    let shown: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    let more = if text.chars().nth(SHOWN).is_some() { "..." } else { "" };
    format!("`{shown}{more}`")
}

/// A finite number.
///
/// # Errors
/// A word that is no number, or one beyond the range of 32 bits.
pub(super) fn number(word: &[u8]) -> Result<f32, String> {
    let number = std::str::from_utf8(word).ok().and_then(|text| text.parse::<f32>().ok());
    match number {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err(format!("{} is NaN, infinite or too large for 32 bits", quoted(word))),
        None => Err(format!("{} is not a number", quoted(word))),
    }
}

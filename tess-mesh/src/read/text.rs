//! Text functions that the readers share.

use std::io::BufRead;

/// The largest number of characters of a file's text that a message repeats.
const SHOWN: usize = 60;

/// A file's bytes without the byte order mark of UTF-8.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}

/// A piece of a file in quotes, for a message. A long piece is cut, and bytes that are not text are
/// escaped.
pub(crate) fn quoted(piece: &[u8]) -> String {
    let piece = piece.trim_ascii();
    // A character has at most four bytes.
    let text = String::from_utf8_lossy(&piece[..piece.len().min(4 * SHOWN)]);
    let shown: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    let more = if text.chars().nth(SHOWN).is_some() { "..." } else { "" };
    format!("`{shown}{more}`")
}

/// The lines of a text, without their line ends.
pub(crate) struct TextLines<'a>(pub(crate) &'a [u8]);

impl<'a> Iterator for TextLines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        if self.0.is_empty() {
            return None;
        }
        let whole = self.0;
        // Reading a slice cannot fail.
        let length = self.0.skip_until(b'\n').unwrap_or(whole.len());
        let line = &whole[..length];
        Some(line.strip_suffix(b"\n").unwrap_or(line))
    }
}

/// The words of a line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// Parses a whole number.
#[inline]
pub(crate) fn integer(word: &[u8]) -> Option<i64> {
    // Up to 18 digits cannot overflow; the standard library parses all other words.
    if !word.is_empty() && word.len() <= 18 && word.iter().all(u8::is_ascii_digit) {
        return Some(word.iter().fold(0, |sum, digit| sum * 10 + i64::from(digit - b'0')));
    }
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Parses a finite number. Errors: a word that is not a number, or a number beyond the range of 32
/// bits.
#[inline]
pub(crate) fn number(word: &[u8]) -> Result<f32, String> {
    decimal(word).map_or_else(|| any_number(word), Ok)
}

/// Parses a short word of digits, optionally with a sign and a point.
///
/// Both the digits and the power of ten are exact in 32 bits, so the quotient is correctly rounded
/// (W. D. Clinger, *How to Read Floating Point Numbers Accurately*, PLDI 1990).
#[inline]
fn decimal(word: &[u8]) -> Option<f32> {
    const POWERS: [f32; 8] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7];
    const EXACT: u32 = 1 << 24;
    let (is_negative, digits) = match word {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, word),
    };
    if digits.len() > 9 {
        return None;
    }
    let (mut whole, mut count, mut decimals) = (0, 0, None);
    for &byte in digits {
        match byte {
            b'0'..=b'9' => {
                whole = whole * 10 + u32::from(byte - b'0');
                count += 1;
            }
            b'.' if decimals.is_none() => decimals = Some(count),
            _ => return None,
        }
    }
    let decimals = count - decimals.unwrap_or(count);
    if count == 0 || whole > EXACT {
        return None;
    }
    #[expect(clippy::cast_precision_loss, reason = "at most 2^24")]
    let value = whole as f32 / POWERS.get(decimals)?;
    Some(if is_negative { -value } else { value })
}

fn any_number(word: &[u8]) -> Result<f32, String> {
    let number = any_float(word)?;
    let is_finite = number.is_finite();
    let error = || format!("{} is NaN, infinite or too large for 32 bits", quoted(word));
    is_finite.then_some(number).ok_or_else(error)
}

/// Parses a number, which may be NaN or infinite. Errors: a word that is not a number.
pub(crate) fn any_float(word: &[u8]) -> Result<f32, String> {
    let number = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
    number.ok_or_else(|| format!("{} is not a number", quoted(word)))
}

#[cfg(test)]
mod tests {
    use super::{TextLines, decimal, integer, number, words};

    #[test]
    fn short_numbers_are_those_of_the_standard_library() {
        let mut short = 0;
        for whole in (0..1 << 25).step_by(997) {
            for point in 0..8 {
                for sign in ["", "-"] {
                    let digits = format!("{whole:0point$}");
                    let (before, after) = digits.split_at(digits.len() - point);
                    let word = format!("{sign}{before}.{after}");
                    let expected: f32 = word.parse().expect("a number");
                    let found = number(word.as_bytes()).expect("a number");
                    assert_eq!(found.to_bits(), expected.to_bits(), "{word}");
                    short += u32::from(decimal(word.as_bytes()).is_some());
                }
            }
        }
        assert!(short > 100_000, "{short} took the short way");
    }

    #[test]
    fn words_that_are_no_short_numbers() {
        for word in ["", "-", ".", "1..2", "1.2.", "+1", "1e3", "--1", "nan", "0x1", "123456789.0"]
        {
            assert_eq!(decimal(word.as_bytes()), None, "{word}");
            let number = number(word.as_bytes()).ok().map(f32::to_bits);
            let expected = word.parse().ok().filter(|x: &f32| x.is_finite()).map(f32::to_bits);
            assert_eq!(number, expected, "{word}");
            assert_eq!(integer(word.as_bytes()), word.parse().ok(), "{word}");
        }
        for word in [
            "0",
            "-0",
            ".5",
            "5.",
            "007",
            "-12",
            "16777217",
            "999999999999999999",
            "9223372036854775808",
        ] {
            let expected: f32 = word.parse().expect("a number");
            assert_eq!(number(word.as_bytes()).map(f32::to_bits), Ok(expected.to_bits()), "{word}");
            assert_eq!(integer(word.as_bytes()), word.parse().ok(), "{word}");
        }
    }

    #[test]
    fn lines_and_words() {
        let lines: Vec<_> =
            TextLines(b"a  b\r\n\n c").map(|line| words(line).collect::<Vec<_>>()).collect();
        assert_eq!(lines, [vec![&b"a"[..], b"b"], vec![], vec![b"c"]]);
    }
}

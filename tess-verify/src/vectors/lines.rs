//! The lines of a vector file. Their length is bounded, so that no input makes the reader's memory
//! grow.

use super::error::{LinePlace, VectorError};
use std::io::{BufRead, Read};

/// The largest length of a line in bytes. The longest line that this kit writes has about 300.
pub(super) const MAX_LINE: usize = 4096;

/// The lines of a text, numbered from 1.
#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: R,
    /// The last line read, without its line end.
    text: String,
    place: LinePlace,
}

/// A line without its line end, and its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub(super) text: &'a str,
    pub(super) place: &'a LinePlace,
}

impl Line<'_> {
    /// An error in this line.
    pub(super) fn error(&self, field: &'static str, message: impl Into<String>) -> VectorError {
        self.place.error(field, message)
    }
}

impl<R: BufRead> Lines<R> {
    pub(super) fn new(file: &str, reader: R) -> Self {
        Self { reader, text: String::new(), place: LinePlace { file: file.into(), line: 0 } }
    }

    /// An error in the last line read, or after the end of the file.
    pub(super) fn error(&self, field: &'static str, message: impl Into<String>) -> VectorError {
        self.place.error(field, message)
    }

    /// The next line; `None` at the end.
    ///
    /// A line that cannot be read, is longer than [`MAX_LINE`], is not UTF-8 or contains control
    /// characters.
    pub(super) fn next(&mut self) -> Result<Option<Line<'_>>, VectorError> {
        let found = self.read()?;
        Ok(found.then_some(self.last()))
    }

    /// The last line read.
    pub(super) fn last(&self) -> Line<'_> {
        Line { text: &self.text, place: &self.place }
    }

    /// The next line, which must exist.
    ///
    /// # Errors
    /// As for [`Self::next`], and the end of the file.
    pub(super) fn expect(&mut self, what: &'static str) -> Result<Line<'_>, VectorError> {
        if self.read()? {
            return Ok(self.last());
        }
        Err(self.error(what, "the file ends here; it is truncated"))
    }

    /// Reads the next line into `self.text`; `false` at the end.
    fn read(&mut self) -> Result<bool, VectorError> {
        self.place.line += 1;
        if self.read_buffered() { Ok(true) } else { self.read_any() }
    }

    /// Takes a line of plain characters if the reader's buffer holds all of it, which is nearly
    /// always so.
    fn read_buffered(&mut self) -> bool {
        let Ok(buffer) = self.reader.fill_buf() else { return false };
        let is_plain = |byte: &u8| (b' '..=b'~').contains(byte);
        let length = buffer.iter().take_while(|byte| is_plain(byte)).count();
        let is_whole = length <= MAX_LINE && buffer.get(length) == Some(&b'\n');
        let Some(Ok(text)) = is_whole.then(|| str::from_utf8(&buffer[..length])) else {
            return false;
        };
        self.text.clear();
        self.text.push_str(text);
        self.reader.consume(length + 1);
        true
    }

    /// Reads any line.
    fn read_any(&mut self) -> Result<bool, VectorError> {
        let mut bytes = std::mem::take(&mut self.text).into_bytes();
        bytes.clear();
        // Two bytes more than a line may have, for the line end.
        let mut bounded = self.reader.by_ref().take(MAX_LINE as u64 + 2);
        let read = bounded.read_until(b'\n', &mut bytes);
        read.map_err(|error| self.error("line", format!("cannot be read: {error}")))?;
        let found = !bytes.is_empty();
        for end in [b'\n', b'\r'] {
            bytes.pop_if(|last| *last == end);
        }
        if bytes.len() > MAX_LINE {
            let message = format!("longer than the {MAX_LINE} bytes that a line may have");
            return Err(self.error("line", message));
        }
        let is_plain = bytes.iter().all(|byte| (b' '..=b'~').contains(byte));
        self.text = String::from_utf8(bytes).map_err(|_| self.error("line", "not UTF-8 text"))?;
        if !is_plain {
            self.refuse_control_characters()?;
        }
        Ok(found)
    }

    fn refuse_control_characters(&self) -> Result<(), VectorError> {
        let control = self.text.chars().find(|character| character.is_control());
        control.map_or(Ok(()), |control| {
            let message = format!("has the control character U+{:04X}", u32::from(control));
            Err(self.error("line", message))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The longest line with either line end, whether or not the reader's buffer holds it; and a
    /// line that is one byte longer.
    #[test]
    fn the_longest_line_is_taken() {
        for end in ["\n", "\r\n"] {
            for (length, is_taken) in [(MAX_LINE, true), (MAX_LINE + 1, false)] {
                let text = "a".repeat(length) + end + "b\n";
                for room in [16, 2 * MAX_LINE] {
                    let reader = std::io::BufReader::with_capacity(room, text.as_bytes());
                    let mut lines = Lines::new("f", reader);
                    let found = lines.next().map(|line| line.map(|line| line.text.len()));
                    let expected = is_taken.then_some(Some(length));
                    assert_eq!(found.ok(), expected, "{length} bytes and {end:?}, room for {room}");
                }
            }
        }
    }
}

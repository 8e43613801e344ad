//! GLB: the JSON and the binary part in one file.

use super::Totals;
use super::binary::Binary;
use super::{Block, GltfOptions, Sink, WriteAt};
use serde_json::Value;
use std::io;

/// The header, the header of the JSON chunk, and the header of the binary chunk.
const HEADERS: usize = 12 + 8 + 8;

/// Writes a GLB file.
#[derive(Debug)]
pub struct Glb<'a, W> {
    binary: Binary<'a, W>,
    /// The room for the JSON, which comes first but is known last. Blanks fill the rest, as the
    /// format prescribes.
    room: usize,
}

impl<'a, W: WriteAt> Glb<'a, W> {
    /// Begins a file.
    pub fn new(file: W, options: GltfOptions<'a>) -> Self {
        Self { binary: Binary::new(file, 0, options), room: 0 }
    }

    /// Writes the header and the JSON, and returns the complete file.
    ///
    /// # Errors
    /// The file has more than 4 GiB, or cannot be written.
    pub fn finish(mut self) -> io::Result<W> {
        let length = self.binary.end()?;
        let beginning = beginning(&self.binary.document(None), self.room, length)?;
        self.binary.file.write_at(&beginning, 0)?;
        Ok(self.binary.file)
    }
}

impl<W: WriteAt> Sink for Glb<'_, W> {
    fn begin(&mut self, parts: &[Totals]) -> io::Result<()> {
        self.binary.begin(parts)?;
        self.room = self.binary.longest_document().next_multiple_of(4);
        self.binary.start = (HEADERS + self.room) as u64;
        Ok(())
    }

    fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        self.binary.block(block)
    }
}

/// Everything before the binary part, which is `length` bytes long.
fn beginning(json: &Value, room: usize, length: u64) -> io::Result<Vec<u8>> {
    let word = |value: u64| {
        let too_large = || io::Error::other("more than 4 GiB, which GLB cannot hold; write .gltf");
        u32::try_from(value).map(u32::to_le_bytes).map_err(|_| too_large())
    };
    let before = HEADERS + room;
    let mut out = Vec::with_capacity(before);
    out.extend(b"glTF");
    out.extend(2u32.to_le_bytes());
    out.extend(word(before as u64 + length)?);
    out.extend(word(room as u64)?);
    out.extend(b"JSON");
    out.extend(json.to_string().into_bytes());
    if out.len() > before - 8 {
        return Err(io::Error::other("the JSON is larger than the room kept for it"));
    }
    out.resize(before - 8, b' ');
    out.extend(word(length)?);
    out.extend(b"BIN\0");
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_length_and_the_next() {
        let all = u64::from(u32::MAX) - (HEADERS + 4) as u64;
        let length_of = |length| beginning(&Value::Array(Vec::new()), 4, length);
        let file = length_of(all).expect("4 GiB less one byte").len();
        assert_eq!(file, HEADERS + 4, "all before the binary part");
        let message = length_of(all + 1).expect_err("4 GiB").to_string();
        assert_eq!(message, "more than 4 GiB, which GLB cannot hold; write .gltf");
        let long = Value::from("longer than four bytes");
        let message = beginning(&long, 4, 0).expect_err("no room").to_string();
        assert_eq!(message, "the JSON is larger than the room kept for it");
    }
}

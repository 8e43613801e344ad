//! glTF in two files: the JSON, and next to it the binary part.

use super::Totals;
use super::binary::Binary;
use super::{Block, GltfOptions, Sink, WriteAt};
use std::io::{self, Write};

/// Writes glTF in two files.
#[derive(Debug)]
pub struct Gltf<'a, J, W> {
    json: J,
    binary: Binary<'a, W>,
    uri: String,
}

impl<'a, J: Write, W: WriteAt> Gltf<'a, J, W> {
    /// Begins both files. `uri` is the reference from the JSON to the binary part
    /// ([`super::uri_of`]).
    pub fn new(json: J, binary: W, uri: String, options: GltfOptions<'a>) -> Self {
        Self { json, binary: Binary::new(binary, 0, options), uri }
    }

    /// Writes the JSON, and returns both complete files.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn finish(mut self) -> io::Result<(J, W)> {
        self.binary.end()?;
        serde_json::to_writer_pretty(&mut self.json, &self.binary.document(Some(&self.uri)))?;
        self.json.write_all(b"\n")?;
        self.json.flush()?;
        Ok((self.json, self.binary.file))
    }
}

impl<J: Write, W: WriteAt> Sink for Gltf<'_, J, W> {
    fn begin(&mut self, parts: &[Totals]) -> io::Result<()> {
        self.binary.begin(parts)
    }

    fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        self.binary.block(block)
    }
}

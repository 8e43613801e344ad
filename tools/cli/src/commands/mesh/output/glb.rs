//! GLB: the JSON and the binary part in one file.

use super::Options;
use super::binary::Binary;
use crate::failure::Failure;
use crate::output::OutputFile;
use serde_json::Value;
use std::io;
use std::path::Path;

/// The room for the JSON, which comes first but is known last. Blanks fill the rest, as the format
/// prescribes.
const JSON_ROOM: usize = 2048;

/// The header, the JSON chunk with its header, and the header of the binary chunk.
const BEFORE_BINARY: usize = 12 + 8 + JSON_ROOM + 8;

/// Begins the file.
pub(super) fn create(path: &Path, options: &Options) -> Result<Binary, Failure> {
    Ok(Binary::new(OutputFile::create(path)?, BEFORE_BINARY as u64, None, options))
}

/// Everything before the binary part, which is `length` bytes long.
pub(super) fn beginning(json: &Value, length: u64) -> io::Result<Vec<u8>> {
    let word = |value: u64| {
        let too_large = || io::Error::other("more than 4 GiB, which GLB cannot hold; write .gltf");
        u32::try_from(value).map(u32::to_le_bytes).map_err(|_| too_large())
    };
    let mut out = Vec::with_capacity(BEFORE_BINARY);
    out.extend(b"glTF");
    out.extend(2u32.to_le_bytes());
    out.extend(word(BEFORE_BINARY as u64 + length)?);
    out.extend(word(JSON_ROOM as u64)?);
    out.extend(b"JSON");
    out.extend(json.to_string().into_bytes());
    if out.len() > BEFORE_BINARY - 8 {
        return Err(io::Error::other("the JSON is larger than the room kept for it"));
    }
    out.resize(BEFORE_BINARY - 8, b' ');
    out.extend(word(length)?);
    out.extend(b"BIN\0");
    Ok(out)
}

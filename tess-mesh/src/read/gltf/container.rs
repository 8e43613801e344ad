//! GLB: a header, the JSON document, and optionally the contents of the first buffer.

/// "glTF" as a little-endian number, and the types of chunks alike.
const MAGIC: &[u8] = b"glTF";
const JSON: &[u8] = b"JSON";
const BIN: &[u8] = b"BIN\0";

/// The JSON of a file, and the chunk of bytes that a GLB file may have. Lengths that are not
/// multiples of 4, and bytes beyond the length in the header, are counted by `irregular`. Errors: a
/// GLB file whose header or first chunks are cut off.
pub(crate) fn split(
    bytes: &[u8],
    mut irregular: impl FnMut(String),
) -> Result<(&[u8], Option<&[u8]>), String> {
    let Some(rest) = bytes.strip_prefix(MAGIC) else { return Ok((bytes, None)) };
    let (version, rest) = word(rest).ok_or("GLB header: it is cut off")?;
    let (length, mut rest) = word(rest).ok_or("GLB header: it is cut off")?;
    if version != 2 {
        let more =
            if version == 1 { "; convert the file, or export the model as glTF 2" } else { "" };
        return Err(format!("GLB header: version {version}; only 2 is read{more}"));
    }
    if length as usize != bytes.len() {
        irregular("GLB header: length".to_owned());
        let length = (length as usize).checked_sub(12);
        rest = length.and_then(|length| rest.get(..length)).unwrap_or(rest);
    }
    let mut chunks = Vec::new();
    // Later chunks are those of extensions.
    while !rest.is_empty() && chunks.len() < 2 {
        let number = chunks.len();
        let chunk = chunk(rest).map_err(|what| format!("GLB chunk {number}: {what}"))?;
        if !chunk.content.len().is_multiple_of(4) {
            irregular(format!("GLB chunk {number}: length"));
        }
        chunks.push((chunk.kind, chunk.content));
        rest = chunk.rest;
    }
    match chunks[..] {
        [(JSON, json), (BIN, bin)] => Ok((json, Some(bin))),
        [(JSON, json), ..] => Ok((json, None)),
        _ => Err("GLB chunk 0: it must be of type JSON".to_owned()),
    }
}

struct Chunk<'a> {
    kind: &'a [u8],
    content: &'a [u8],
    rest: &'a [u8],
}

fn chunk(bytes: &[u8]) -> Result<Chunk<'_>, String> {
    let header = word(bytes).and_then(|(length, rest)| Some((length, rest.split_at_checked(4)?)));
    let (length, (kind, rest)) = header.ok_or("its header is cut off")?;
    let split = rest.split_at_checked(length as usize);
    let (content, rest) =
        split.ok_or_else(|| format!("its length is {length}, but {} bytes follow", rest.len()))?;
    Ok(Chunk { kind, content, rest })
}

fn word(bytes: &[u8]) -> Option<(u32, &[u8])> {
    bytes.split_first_chunk().map(|(&word, rest)| (u32::from_le_bytes(word), rest))
}

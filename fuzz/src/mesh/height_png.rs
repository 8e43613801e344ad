//! PNG files as heights, compared with another decoder's numbers.

use super::naive::{self, bits};
use lodepng::{ColorType, Decoder, Error, Image};
use miniz_oxide::inflate::decompress_to_vec_with_limit;
use std::io::{Cursor, Write};
use tess_mesh::height::{self, Heights};

/// The most pixels.
const MOST: u64 = 1 << 16;

/// Compares one file. Errors: the first difference, or an empty message.
pub fn check(data: &[u8]) -> Result<(), String> {
    let read = height::decode(Cursor::new(data), MOST).map_err(|error| error.to_string());
    let independent = read.as_ref().ok().and_then(|_| naive(data));
    // The decoders decide which files are valid, and this one is stricter.
    if read.is_ok() && independent.is_none() {
        return Ok(());
    }
    let words = |Heights { width, height, texels }: &Heights| {
        let size = [*width as u32, *height as u32];
        size.into_iter().chain(texels.iter().map(|&texel| bits(texel))).collect()
    };
    // A file of numbers has no places that a user could look at, so the message only names the
    // fault.
    naive::check(read, words, |message| !message.is_empty(), || independent)
}

fn naive(data: &[u8]) -> Option<Heights> {
    let mut decoder = Decoder::new();
    decoder.info_raw_mut().colortype = ColorType::RGBA;
    decoder.info_raw_mut().set_bitdepth(16);
    decoder.set_custom_zlib(Some(|data, output, _| inflate(data, output)), std::ptr::null());
    let Ok(Image::RGBA16(image)) = decoder.decode(data) else { return None };
    let is_grey = matches!(data[25], 0 | 4);
    let texels = image.buffer.iter().map(|pixel| {
        // The most significant byte comes first, as in the file.
        let value = |channel| f32::from(u16::from_be(channel)) / 65535.0;
        let [r, g, b] = [pixel.r, pixel.g, pixel.b].map(value);
        if is_grey { r } else { 0.2126 * r + 0.7152 * g + 0.0722 * b }
    });
    Some(Heights { width: image.width, height: image.height, texels: texels.collect() })
}

/// The data after the two bytes of zlib's header; its checksum at the end is ignored.
fn inflate(data: &[u8], output: &mut dyn Write) -> Result<(), Error> {
    let raw = decompress_to_vec_with_limit(data.get(2..).unwrap_or_default(), 1 << 24);
    let raw = raw.unwrap_or_else(|error| error.output);
    output.write_all(&raw).map_err(|_| Error::new(83))
}

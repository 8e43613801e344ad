//! Height images: PNG files whose brightness is a height in 0..=1.

use crate::error::{LoadError, LoadErrorKind};
use png::{BitDepth, ColorType, Decoder, Limits, Transformations};
use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;
use tess_surface::HeightMap;

/// The largest memory in bytes that decoding may need besides the pixels and one row of them: for
/// tables and text in the file.
const MOST_BESIDE: usize = 16 << 20;

/// The largest size of a pixel in bytes: four channels of 16 bits.
const MOST_OF_PIXEL: usize = 8;

/// A grey image, row by row from the top.
#[derive(Debug)]
pub struct Heights {
    /// The width in pixels.
    pub width: usize,
    /// The height in pixels.
    pub height: usize,
    /// `width * height` heights in 0..=1.
    pub texels: Vec<f32>,
}

/// Loads a PNG of at most `most` pixels.
///
/// # Errors
/// A file that cannot be read, is not a PNG or is too large.
pub fn load(path: &Path, most: u64) -> Result<HeightMap, LoadError> {
    let refused = |kind, why: &dyn std::fmt::Display| {
        LoadError::new(kind, format!("cannot read {}: {why}", path.display()))
    };
    let file = File::open(path).map_err(|error| refused(LoadErrorKind::File, &error))?;
    let in_file = |what: String| refused(LoadErrorKind::Content, &what);
    let Heights { width, height, texels } = texels(BufReader::new(file), most).map_err(in_file)?;
    HeightMap::new(width, height, texels).map_err(|error| in_file(error.to_string()))
}

/// Decodes a PNG. Grey images keep up to 16 bits; colours are converted to Rec. 709 luma.
///
/// # Errors
/// The malformed part, or the size and the limit.
pub fn decode(file: impl BufRead + Seek, most: u64) -> Result<Heights, LoadError> {
    texels(file, most).map_err(|message| LoadError::new(LoadErrorKind::Content, message))
}

fn texels(file: impl BufRead + Seek, most: u64) -> Result<Heights, String> {
    let mut decoder = Decoder::new_with_limits(file, Limits { bytes: MOST_BESIDE });
    decoder.set_transformations(Transformations::EXPAND);
    let header = decoder.read_header_info().map_err(|error| error.to_string())?;
    let (width, height) = header.size();
    if u64::from(width) * u64::from(height) > most {
        return Err(format!(
            "{width} x {height} are more than {most} pixels; scale the image down, or raise \
             --max-pixels"
        ));
    }
    let row = (width as usize).saturating_mul(MOST_OF_PIXEL);
    decoder.set_limits(Limits { bytes: MOST_BESIDE.saturating_add(row) });
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    check_palette(reader.info().palette.as_deref())?;
    let size = reader.output_buffer_size().ok_or("the image does not fit into memory")?;
    let mut bytes = vec![0; size];
    let info = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
    reader.finish().map_err(|error| error.to_string())?;
    let channels = match info.color_type {
        ColorType::Grayscale | ColorType::Indexed => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb => 3,
        ColorType::Rgba => 4,
    };
    let texels = match info.bit_depth {
        BitDepth::Sixteen => {
            let words = |pixel: &[[u8; 2]]| {
                luma(pixel, |&word| f32::from(u16::from_be_bytes(word)) / 65535.0)
            };
            bytes.as_chunks().0.chunks_exact(channels).map(words).collect()
        }
        _ => {
            let octets = |pixel: &[u8]| luma(pixel, |&byte| f32::from(byte) / 255.0);
            bytes.chunks_exact(channels).map(octets).collect()
        }
    };
    Ok(Heights { width: info.width as usize, height: info.height as usize, texels })
}

/// Refuses a palette that ends within a colour, because the decoder would panic. The decoder itself
/// refuses palettes that are too long.
fn check_palette(palette: Option<&[u8]>) -> Result<(), String> {
    match palette.map(<[u8]>::len) {
        Some(length) if !length.is_multiple_of(3) => {
            Err(format!("the palette has {length} bytes; it must be whole colours of three bytes"))
        }
        _ => Ok(()),
    }
}

fn luma<T>(pixel: &[T], value: impl Fn(&T) -> f32) -> f32 {
    match pixel {
        [grey] | [grey, _] => value(grey),
        [r, g, b, ..] => 0.2126 * value(r) + 0.7152 * value(g) + 0.0722 * value(b),
        [] => 0.0,
    }
}

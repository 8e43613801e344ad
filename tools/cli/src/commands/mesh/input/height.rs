//! Height images: PNG files, the brightness taken as height 0..=1.

use crate::failure::Failure;
use png::{ColorType, Decoder, Transformations};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use tess_surface::HeightMap;

/// Reads a PNG. Grey images keep up to 16 bits; of colours the Rec. 709 luma is taken.
///
/// # Errors
/// A file that cannot be read or is no PNG.
pub(crate) fn load(path: &Path) -> Result<HeightMap, Failure> {
    let file = File::open(path).map_err(|error| Failure::file("read", path, &error))?;
    let bad = |error: png::DecodingError| Failure::file("read", path, &error);
    let mut decoder = Decoder::new(BufReader::new(file));
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(bad)?;
    let size = reader.output_buffer_size().unwrap_or_default();
    let mut bytes = vec![0; size];
    let info = reader.next_frame(&mut bytes).map_err(bad)?;
    let samples: Vec<f32> = match info.bit_depth {
        png::BitDepth::Sixteen => {
            let words = bytes.as_chunks::<2>().0.iter();
            words.map(|&word| f32::from(u16::from_be_bytes(word)) / 65535.0).collect()
        }
        _ => bytes.iter().map(|&byte| f32::from(byte) / 255.0).collect(),
    };
    let luma = |pixel: &[f32]| match *pixel {
        [grey] | [grey, _] => grey,
        [r, g, b, ..] => 0.2126 * r + 0.7152 * g + 0.0722 * b,
        [] => 0.0,
    };
    let channels = match info.color_type {
        ColorType::Grayscale | ColorType::Indexed => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb => 3,
        ColorType::Rgba => 4,
    };
    let texels = samples.chunks_exact(channels).map(luma).collect();
    let map = HeightMap::new(info.width as usize, info.height as usize, texels);
    map.ok_or_else(|| Failure::bad_input(format!("{}: no pixels", path.display())))
}

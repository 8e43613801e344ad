//! Writing a picture.

use std::error::Error;
use std::fs::File;

/// Writes RGBA pixels, row by row, as a PNG file.
pub(crate) fn write(path: &str, size: [u32; 2], pixels: &[u8]) -> Result<(), Box<dyn Error>> {
    let mut encoder = png::Encoder::new(File::create(path)?, size[0], size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(())
}

//! Writing a picture.

use crate::picture::{HEIGHT, WIDTH};
use std::fs::File;

/// Writes RGBA pixels, row by row, as a PNG file.
pub(crate) fn write(path: &str, pixels: &[u8]) -> Result<(), Box<dyn std::error::Error>> {
    let mut encoder = png::Encoder::new(File::create(path)?, WIDTH, HEIGHT);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(())
}

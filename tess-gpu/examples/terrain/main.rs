//! A displaced terrain: see README.md beside this file.

mod terrain;

use std::fs::File;
use tess_gpu::runner::Gpu;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "terrain.png".to_owned());
    let gpu = pollster::block_on(Gpu::open())?;
    let pixels = terrain::render(&gpu, None)?;
    let mut encoder = png::Encoder::new(File::create(path)?, terrain::WIDTH, terrain::HEIGHT);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&pixels)?;
    let cracks = terrain::background_pixels(&pixels);
    if cracks > 0 { Err(format!("{cracks} pixels show the background").into()) } else { Ok(()) }
}

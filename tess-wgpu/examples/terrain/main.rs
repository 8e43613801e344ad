//! A displaced terrain: see README.md beside this file.

#[path = "../shared/png_file.rs"]
mod png_file;
mod terrain;

use terrain::picture;
use tess_wgpu::Gpu;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "terrain.png".to_owned());
    let gpu = pollster::block_on(Gpu::open())?;
    let pixels = terrain::render(&gpu, None)?;
    png_file::write(&path, &pixels)?;
    let cracks = terrain::background_pixels(&pixels);
    if cracks > 0 { Err(format!("{cracks} pixels show the background").into()) } else { Ok(()) }
}

//! A displaced terrain: see README.md beside this file.

mod batch;
#[path = "../shared/png_of.rs"]
mod png_of;

use batch::picture::{HEIGHT, WIDTH};
use tess_wgpu::Gpu;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "batch.png".to_owned());
    let gpu = pollster::block_on(Gpu::open())?;
    let pixels = batch::render(&gpu, None)?;
    png_of::write(&path, [WIDTH, HEIGHT], &pixels)?;
    let cracks = batch::background_pixels(&pixels);
    if cracks > 0 { Err(format!("{cracks} pixels show the background").into()) } else { Ok(()) }
}

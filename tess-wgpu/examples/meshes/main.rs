//! Several meshes in one batch: see README.md beside this file.

mod meshes;
#[path = "../shared/png_of.rs"]
mod png_of;

use meshes::picture::{HEIGHT, WIDTH};
use tess_wgpu::Gpu;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "meshes.png".to_owned());
    let gpu = pollster::block_on(Gpu::open())?;
    png_of::write(&path, [WIDTH, HEIGHT], &meshes::render(&gpu)?)
}

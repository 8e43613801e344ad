//! The teapot: see README.md beside this file.

#[path = "../shared/png_file.rs"]
mod png_file;
mod teapot;

use teapot::picture;
use tess_wgpu::Gpu;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "teapot.png".to_owned());
    let gpu = pollster::block_on(Gpu::open())?;
    png_file::write(&path, &teapot::render(&gpu)?)
}

//! Several meshes in one batch: see README.md beside this file.

mod meshes;
#[path = "../shared/png_file.rs"]
mod png_file;

use meshes::teapot::picture;
use tess_wgpu::Gpu;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "meshes.png".to_owned());
    let gpu = pollster::block_on(Gpu::open())?;
    png_file::write(&path, &meshes::render(&gpu)?)
}

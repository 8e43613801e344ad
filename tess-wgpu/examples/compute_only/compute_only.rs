//! Patches in, points and indices out: see README.md in this folder.

use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, TriangleFactors};
use tess_gpu::Setup;
use tess_gpu::layout::PackedPoint;
use tess_wgpu::{Gpu, Tessellator};

pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let gpu = pollster::block_on(Gpu::open())?;
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let setup = Setup::new(Domain::Triangle, config);
    let factors = TriangleFactors { u0: 2.5, v0: 3.0, w0: 1.0, inside: 3.25 };
    let patches = [PatchFactors::Triangle(factors); 2];
    let output = Tessellator::new(&gpu.device).tessellate(&gpu, setup, &patches)?;
    println!("{} on {}", output.draw.index_count, gpu.name());
    for &words in &output.points {
        let packed = PackedPoint(words);
        let [u, v] = packed.point().to_f32();
        println!("patch {}: {u:.4} {v:.4}", packed.patch());
    }
    for triangle in output.indices.chunks(3) {
        println!("{triangle:?}");
    }
    Ok(())
}

//! Times the Rust call with which `benches/speed.py` compares the Python call: seconds for 10000
//! quads of factor 8 into existing buffers, the best of 30 calls.
#![expect(clippy::print_stdout, reason = "a program prints its result")]

use std::time::{Duration, Instant};
use tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
use tess_simd::{Buffers, Error, Numbering, PatchRange, Tessellator};

fn main() -> Result<(), Error> {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patches = vec![QuadFactors::uniform(8.0); 10_000];
    let mut tessellator = Tessellator::new(config);
    let counts = tessellator.count(&patches)?.counts();
    let mut points = vec![[0.0_f32; 2]; counts.points];
    let mut indices = vec![0_u32; counts.indices];
    let mut ranges = vec![PatchRange::default(); counts.patches];
    let mut best = Duration::MAX;
    for _ in 0..30 {
        let start = Instant::now();
        let buffers = Buffers::new(&mut points, &mut indices).with_ranges(&mut ranges);
        tessellator.write(&patches, Numbering::PerPatch, buffers)?;
        best = best.min(start.elapsed());
    }
    println!("{}", best.as_secs_f64());
    Ok(())
}

//! Times the Rust call with which `run.py` compares the calls of other languages: one quad of
//! factor K, with 16.16 points and 32-bit indices. Prints nanoseconds per call for each K, the
//! smallest of 60 runs of 2000 calls.
#![expect(clippy::print_stdout, reason = "a program prints its result")]
#![expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "the mean of a measurement"
)]

use std::hint::black_box;
use std::time::Instant;
use tess_core::{Config, DomainPoint, OutputPrimitive, Partitioning, QuadFactors};
use tess_core::{MAX_INDICES, MAX_POINTS};
use tess_simd::{Error, Tessellator};

fn main() -> Result<(), Error> {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let mut tessellator = Tessellator::new(config);
    let mut points = vec![DomainPoint::default(); MAX_POINTS];
    let mut indices = vec![0_u32; MAX_INDICES];
    for factor in [1_u16, 2, 4, 8, 64] {
        let factors = QuadFactors::uniform(f32::from(factor));
        let mut best = u128::MAX;
        for _ in 0..60 {
            let start = Instant::now();
            for _ in 0..2000 {
                black_box(tessellator.patch(black_box(factors), &mut points, &mut indices)?);
            }
            best = best.min(start.elapsed().as_nanos());
        }
        println!("{factor} {:.1}", best as f64 / 2000.0);
    }
    Ok(())
}

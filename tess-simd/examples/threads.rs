//! Tessellates a terrain's patches on several threads; the output does not depend on their number.
//!
//! Run it with `cargo run -p tess-simd --features rayon --example threads`.
#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use tess_simd::tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
use tess_simd::{Error, Numbering, Output, Tessellator};

pub(crate) fn main() -> Result<(), Error> {
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    // Nearer patches are cut more finely.
    let patches: Vec<QuadFactors> =
        (0..2000_u16).map(|i| QuadFactors::uniform(f32::from(64 - i % 50))).collect();
    let numbering = Numbering::PerBatch { base_vertex: 0 };

    let mut one: Output<[f32; 2], u32> = Output::new();
    Tessellator::new(config).tessellate(&patches, numbering, &mut one)?;

    let threads = std::thread::available_parallelism().map_or(2, |count| count.get());
    let mut tessellator = Tessellator::new(config).with_threads(threads);
    let mut several: Output<[f32; 2], u32> = Output::new();
    let counts = tessellator.tessellate(&patches, numbering, &mut several)?;

    assert!(one.points() == several.points(), "the same points");
    assert!(one.indices() == several.indices(), "the same indices");
    assert_eq!(one.ranges(), several.ranges(), "the same ranges");
    println!(
        "{} patches on {threads} threads: {} points, {} triangles",
        counts.patches,
        counts.points,
        counts.indices / 3
    );
    Ok(())
}

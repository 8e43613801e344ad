//! Fills large vertex and index buffers batch by batch, without an allocation for each batch.
//!
//! Run it with `cargo run -p tess-simd --example own_buffers`.
#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use tess_simd::tess_core::{Config, OutputPrimitive, Partitioning, TriangleFactors};
use tess_simd::{Buffers, Error, Numbering, PatchRange, Tessellator};

/// Room for vertices and for indices.
const VERTICES: usize = 100_000;
const INDICES: usize = 500_000;

pub(crate) fn main() -> Result<(), Error> {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let mut tessellator = Tessellator::new(config);
    let mut vertices = vec![[0.0_f32; 2]; VERTICES];
    let mut indices = vec![0_u32; INDICES];
    let mut ranges = [PatchRange::default(); 32];

    let (mut used_vertices, mut used_indices, mut batches) = (0, 0, 0);
    for factor in (1..=60_u8).map(f32::from) {
        let patches = [TriangleFactors::uniform(factor); 32];
        let mut counted = tessellator.count(&patches)?;
        let (free_vertices, free_indices) =
            (&mut vertices[used_vertices..], &mut indices[used_indices..]);
        if counted.points() > free_vertices.len() || counted.indices() > free_indices.len() {
            break; // a renderer draws here and starts again with empty buffers
        }
        // All batches share one vertex buffer: each one's indices continue where the last ended.
        let base_vertex = u32::try_from(used_vertices).expect("there are 100000 vertices");
        let numbering = Numbering::PerBatch { base_vertex };
        let buffers = Buffers::new(free_vertices, free_indices).with_ranges(&mut ranges);
        let counts = counted.write(numbering, buffers)?;

        let last = ranges[31];
        assert_eq!((last.first_point + last.points) as usize, counts.points, "the ranges' end");
        let written = &indices[used_indices..used_indices + counts.indices];
        let numbers = used_vertices..used_vertices + counts.points;
        assert!(written.iter().all(|&index| numbers.contains(&(index as usize))), "own vertices");
        used_vertices += counts.points;
        used_indices += counts.indices;
        batches += 1;
    }
    println!("{batches} batches: {used_vertices} vertices, {used_indices} indices");
    assert!(batches > 10 && batches < 60, "the buffers fill up before the last batch");
    Ok(())
}

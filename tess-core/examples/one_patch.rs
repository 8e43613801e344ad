//! Tessellates one triangle patch and prints its points and triangles.
#![expect(clippy::print_stdout, reason = "an example prints")]

use tess_core::{Config, OutputPrimitive, Partitioning, Patch, TriangleFactors};

pub(crate) fn main() {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let factors = TriangleFactors { u0: 2.5, v0: 3.0, w0: 1.0, inside: 3.25 };
    let patch = Patch::new(config, factors);

    let whole = patch.tessellate();
    for (number, point) in whole.points.iter().enumerate() {
        println!("point {number}: u = {}, v = {}", point.u, point.v);
    }
    for triangle in whole.indices.chunks(3) {
        println!("triangle {triangle:?}");
    }
    assert_eq!(whole.points.len(), patch.counts().points as usize, "counts are known beforehand");
}

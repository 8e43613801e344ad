//! Computes single elements of a patch, in any order, without the rest of it.
#![expect(clippy::print_stdout, reason = "an example prints")]

use tess_core::{Config, OutputPrimitive, Partitioning, Patch, QuadFactors};

pub(crate) fn main() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patch = Patch::new(config, QuadFactors::uniform(64.0));
    let counts = patch.counts();

    // Each thread of a parallel implementation computes one element from only its number.
    for number in [0, counts.points / 2, counts.points - 1] {
        let point = patch.point(number).expect("the patch has this point");
        let origin = patch.locate_point(number).expect("the patch has this point");
        println!("point {number}: ({}, {}) from {origin:?}", point.u, point.v);
    }
    for number in [0, counts.primitives - 1] {
        let primitive = patch.primitive(number).expect("the patch has this triangle");
        println!("triangle {number}: {:?}", primitive.indices());
    }
    assert_eq!(patch.point(counts.points), None, "there are no more");
}

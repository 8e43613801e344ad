//! Prints the signals of one patch: processed factors, factor contexts, and one placement.
#![expect(clippy::print_stdout, reason = "an example prints")]

use tess_core::place::placement;
use tess_core::{Config, OutputPrimitive, Partitioning, Patch, QuadFactors};

pub(crate) fn main() {
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let factors = QuadFactors { u0: 3.0, v0: 4.5, u1: 5.0, v1: 66.0, inside_u: 4.0, inside_v: 7.0 };
    let patch = Patch::new(config, factors);

    let processed = patch.processed().factors().expect("no outer factor is zero");
    for (name, factor) in processed.domain().factor_names().iter().zip(processed.iter()) {
        println!("{name}: 15.16 {:#08x}, {:?}", factor.fixed.to_bits(), factor.context);
    }

    let tess_core::PatchFactors::Quad(quad) = processed else { unreachable!("it is a quad") };
    let steps = placement(&quad.v0.context, 3);
    println!("point 3 of the edge v = 0: {steps:?}");
    if let Some(blend) = steps.blend {
        assert_eq!(blend.half_location(), steps.half_location, "the blend gives the location");
    }
}

//! Faults are seen in the pass that has them, whatever they break behind it.

use super::cases::{catalogued, cut_up, of, random, runs, setup, too_many};
use super::run::{Batch, Machine};
use tess_core::{Domain, Partitioning};
use tess_gpu::Resource::{self, Arguments, Catalogue, Draws, Indices, Offsets, Points, Tiles};
use tess_gpu::{Fault, Stage};

/// Faults of `src/faults.txt`, with the pass and the buffer that must be named.
const FAULTS: &[(&str, Stage, Resource)] = &[];

#[test]
fn a_fault_is_named_with_its_pass_and_buffer() {
    let _ = (catalogued, cut_up, of, random, runs, setup, too_many, FAULTS);
    let _ = (
        Domain::Quad,
        Partitioning::Integer,
        Arguments,
        Catalogue,
        Draws,
        Indices,
        Offsets,
        Points,
        Tiles,
    );
    let _ = |batch: &Batch, machine: &mut Machine| {
        machine.run(batch).is_ok() && Fault::named("a").is_some()
    };
}

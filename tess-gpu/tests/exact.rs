//! Everything that the shaders write against the golden model, on whatever adapter there is.

mod common;

use common::{all_configs, device::Machine};
use tess_check::random::SplitMix64;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::{Numbering, PointFormat, Setup};

/// Random patches of each configuration, through the whole pipeline.
#[test]
fn random_patches_in_every_configuration() {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(1);
    for (domain, config) in all_configs() {
        let patches = common::patches::random(domain, 300, &mut random);
        machine.assert_equal(Setup::new(domain, config), &patches);
    }
}

#[test]
fn quads_first() {
    let mut machine = Machine::open();
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let setup = Setup {
        point_format: PointFormat::Float,
        numbering: Numbering::PerPatch,
        ..Setup::new(Domain::Quad, config)
    };
    let mut random = SplitMix64::new(2);
    let patches = common::patches::random(Domain::Quad, 50, &mut random);
    machine.assert_equal(setup, &patches);
}

//! Everything that the shaders write against the golden model, on whatever adapter there is.

mod common;

use common::{all_configs, device::Machine};
use tess_check::random::SplitMix64;
use tess_gpu::Setup;

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

/// As many patches per configuration as a night has time for.
#[test]
#[ignore = "hours in software: cargo test -p tess-gpu --features wgpu --test exact -- --ignored"]
fn a_hundred_thousand_patches_in_every_configuration() {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(6);
    for (domain, config) in all_configs() {
        for _ in 0..100 {
            let patches = common::patches::random(domain, 1000, &mut random);
            machine.assert_equal(Setup::new(domain, config), &patches);
        }
    }
}

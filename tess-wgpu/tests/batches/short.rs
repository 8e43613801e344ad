//! Short batches, which one workgroup prepares, up to the largest, and the smallest batch that is
//! not short.

use crate::common::device::{Machine, POISON};
use crate::common::expected::Expected;
use crate::common::patches::random;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::sizes::{SHORT_ELEMENTS, SHORT_PATCHES};
use tess_gpu::{Capacity, Limits, Plan, Setup, Stage};
use tess_verify::generate::{SplitMix64, configurations};

fn setup(domain: Domain) -> Setup {
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    Setup::new(domain, config)
}

#[test]
#[ignore = "slow: every configuration in short batches"]
fn the_room_and_the_patches_decide() {
    let setup = setup(Domain::Quad);
    let is_short = |patches, points, primitives| {
        let room = Capacity { points, primitives };
        let plan = Plan::new(setup, patches, room, Limits::WEBGPU);
        let stages: Vec<_> = plan.dispatches().map(|dispatch| dispatch.stage()).collect();
        assert_eq!(plan.is_short(), stages.contains(&Stage::Short), "{stages:?}");
        assert_eq!(plan.is_short(), !stages.contains(&Stage::Partition), "{stages:?}");
        plan.is_short()
    };
    let most = SHORT_ELEMENTS;
    assert!(is_short(1, 100, 100) && is_short(SHORT_PATCHES, most / 2, most / 2), "short ones");
    assert!(!is_short(SHORT_PATCHES + 1, 100, 100), "too many patches");
    assert!(!is_short(1, most / 2, most / 2 + 1), "too much room");
}

/// Everything that a short batch writes, in every configuration and around the sizes of blocks.
#[test]
#[ignore = "slow: every configuration in short batches"]
fn short_batches_in_every_configuration() {
    let mut machine = Machine::open();
    let mut numbers = SplitMix64::new(41);
    let counts = [1, 255, 256, 257, 600];
    for ((domain, config), count) in configurations().zip(counts.into_iter().cycle()) {
        let patches = random(domain, count, &mut numbers);
        machine.assert_equal(Setup::new(domain, config), &patches);
    }
    for count in [SHORT_PATCHES - 1, SHORT_PATCHES, SHORT_PATCHES + 1] {
        machine.assert_equal(setup(Domain::Quad), &low(count));
    }
}

/// Patches of few triangles, including culled ones.
fn low(count: u32) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(42);
    let mut factor = |_| [0.0, 2.0, 2.5, 3.0, 5.0, 6.0][random.below(6) as usize];
    (0..count).map(|_| PatchFactors::from_fn(Domain::Quad, &mut factor)).collect()
}

/// A batch, short or not, writes the same when it runs again: nothing has to be cleared in between.
fn run_twice(machine: &mut Machine, patches: &[PatchFactors]) -> Result<(), String> {
    let setup = setup(Domain::Quad);
    let expected = Expected::new(setup, patches);
    let (point_words, index_words) = expected.words();
    let (batch, outputs) = machine.batch(setup, patches, [point_words, index_words]);
    machine.run(&batch);
    machine.run(&batch);
    expected.compare(&machine.written(&batch, &outputs))
}

#[test]
#[ignore = "slow: every configuration in short batches"]
fn a_batch_can_run_again() {
    let mut machine = Machine::open();
    for count in [300, 3000] {
        assert_eq!(run_twice(&mut machine, &low(count)), Ok(()), "{count} patches");
    }
    machine.plant(setup(Domain::Quad), "totals: the first portion begins at the last run's end");
    assert!(run_twice(&mut machine, &low(3000)).is_err(), "totals that are not reset");
}

#[test]
#[ignore = "slow: every configuration in short batches"]
fn planted_faults_are_seen() {
    let mut machine = Machine::open();
    let (setup, mut patches) = (setup(Domain::Quad), low(600));
    // So that there are more tiles than threads.
    patches.extend(vec![PatchFactors::uniform(Domain::Quad, 20.0); 300]);
    machine.assert_noticed(
        setup,
        &patches,
        &[
            "short_batch: every block begins at 0",
            "short_batch: a block begins where it ends",
            "short_batch: the section begins at 1",
            "short_batch: primitives end where points do",
            "write_tiles: a tile that begins with a patch is not its own",
            "write_tiles: a patch is entered for one tile",
            "write_tiles: primitives are entered for points",
            "short_batch: no entry follows the last tile of points",
            "short_batch: no entry follows the last tile of primitives",
            "short_batch: the last block is left out",
        ],
    );
    let (points, indices) = Expected::new(setup, &patches).words();
    machine.plant(setup, "write_primitive_tile: output that overflows is written");
    let written = machine.write(setup, &patches, points - 2, indices);
    let mut all = written.points.iter().chain(&written.indices);
    assert!(all.any(|&word| word != POISON), "what does not fit is written");
}

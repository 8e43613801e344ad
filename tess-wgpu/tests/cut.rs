//! Batches that are cut up: several chunks, windows and rows of workgroups; and the prefix sums.

mod common;

use common::device::Machine;
use common::expected::{Expected, by_simd};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::sizes::{BLOCK, GROUP, TILE};
use tess_gpu::{Capacity, IndexType, Limits, Numbering, Plan, Setup};
use tess_verify::random::SplitMix64;
use tess_wgpu::{Gpu, Outputs, Tessellator, Wanted};

/// Limits that cut after 65536 patches, a few hundred tiles and 5 workgroups.
const LOW: Limits = Limits { storage_binding: 4 << 20, workgroups: 5 };

fn setup(domain: Domain) -> Setup {
    Setup::new(domain, Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw))
}

/// Small patches, culled ones among them, with odd numbers of triangles.
fn small(domain: Domain, count: u32) -> Vec<PatchFactors> {
    of_these(domain, count, [0.0, 1.0, 1.0, 1.5, 2.0, 3.0])
}

fn of_these(domain: Domain, count: u32, factors: [f32; 6]) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(12);
    let all = (0..count).map(|_| PatchFactors::from_fn(domain, |_| factors[random.below(6) as usize]));
    all.collect()
}

/// A device with [`LOW`] limits, and shaders in which something is replaced.
fn low_machine(right: &'static str, wrong: &'static str) -> Machine {
    let mut machine = Machine::open();
    let edit = move |_, source: String| {
        source
            .replace("const MAX_WORKGROUPS = 65535u;", "const MAX_WORKGROUPS = 5u;")
            .replace(right, wrong)
    };
    machine.tessellator = Tessellator::with_edit(&machine.gpu.device, edit).limited(LOW);
    machine
}

/// Everything is written once and in its place wherever the batch is cut.
#[test]
fn chunks_windows_and_rows() {
    let mut machine = low_machine("", "");
    let patches = small(Domain::Triangle, 150_000);
    let setup = setup(Domain::Triangle);
    let factors = machine.factors(&patches);
    let batch =
        machine.tessellator.batch(setup, 150_000, &factors, Outputs::CountOnly).expect("valid");
    machine.run(&batch);
    let (status, _) = machine.status(&batch);
    let all = |elements: u64| u32::try_from(elements).expect("a test's output");
    let room = Capacity { points: all(status.points()), primitives: all(status.primitives()) };
    let plan = Plan::new(setup, 150_000, room, LOW);
    assert!(plan.chunks() > 1 && plan.factors_workgroups(0)[1] > 1, "{plan:?}");
    assert!(plan.point_windows() > 1 && plan.primitive_windows() > 1, "{plan:?}");
    machine.assert_equal(setup, &patches);
    let (numbering, index_type) = (Numbering::PerPatch, IndexType::U16);
    machine.assert_equal(Setup { numbering, index_type, ..setup }, &patches);
}

/// A window that begins at another tile and workgroups that take each row for the first are noticed.
#[test]
fn wrong_windows_and_rows_are_seen() {
    let patches = small(Domain::Triangle, 150_000);
    let setup = setup(Domain::Triangle);
    let expected = Expected::new(setup, &patches);
    let (points, indices) = expected.words();
    for (right, wrong) in [
        ("tile.base - job.window_first * TILE;", "tile.base;"),
        ("let number = workgroup.x + workgroup.y * workgroups.x;", "let number = workgroup.x;"),
        ("let block = workgroup.x + workgroup.y * workgroups.x;", "let block = workgroup.x;"),
    ] {
        let written = low_machine(right, wrong).write(setup, &patches, points, indices);
        assert!(expected.compare(&written).is_err(), "{wrong} went unnoticed");
    }
}

/// Rows of 65535 workgroups where a device binds gigabytes: 16 million patches in one chunk and one
/// window, compared with tess-simd.
#[test]
#[ignore = "6 GiB on a device that binds 3 at once: cargo test --release -p tess-wgpu \
            --test cut -- --ignored"]
fn more_workgroups_than_a_row_has() {
    let everything = Gpu::open_with(Wanted::Everything, wgpu::Features::empty());
    let gpu = pollster::block_on(everything).unwrap_or_else(|error| panic!("{error}"));
    let tessellator = Tessellator::new(&gpu.device);
    let mut machine = Machine { gpu, tessellator };
    let count = 1 << 24;
    let patches = of_these(Domain::Quad, count, [0.0, 1.0, 2.0, 3.0, 3.0, 4.0]);
    let setup = Setup { numbering: Numbering::PerPatch, ..setup(Domain::Quad) };
    let (points, indices) = by_simd(setup, &patches);
    let words = |words: &[u32]| u32::try_from(words.len()).expect("a test's output");
    let room = Capacity { points: words(&points) / 2, primitives: words(&indices) / 3 };
    let device = machine.gpu.device.limits();
    let limits = Limits {
        storage_binding: device.max_storage_buffer_binding_size,
        workgroups: device.max_compute_workgroups_per_dimension,
    };
    let plan = Plan::new(setup, count, room, limits);
    assert!(plan.factors_workgroups(0)[1] > 1, "{plan:?}");
    let tiles = room.primitives.div_ceil(TILE);
    assert!(plan.primitive_windows() == 1 && tiles > 65535, "{tiles} tiles, {plan:?}");
    let written = machine.write(setup, &patches, words(&points), words(&indices));
    assert!(written.status.fits(), "{:?}", written.status);
    assert!(written.points == points, "points");
    assert!(written.indices == indices, "indices");
}

/// Each level of the prefix sums against a scalar scan.
#[test]
fn prefix_sums_are_those_of_a_scalar_scan() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        for count in [1, 255, 256, 257, 65_536, 70_000] {
            compare_sums(&mut machine, setup(domain), &small(domain, count));
        }
    }
}

fn compare_sums(machine: &mut Machine, setup: Setup, patches: &[PatchFactors]) {
    let count = u32::try_from(patches.len()).expect("a test's patches");
    let factors = machine.factors(patches);
    let batch = machine.tessellator.batch(setup, count, &factors, Outputs::CountOnly);
    let batch = batch.expect("valid");
    machine.run(&batch);
    let observed = machine.words(batch.offsets());
    let at = |entry: u64| {
        let first = usize::try_from(2 * entry).expect("in memory");
        [observed[first], observed[first + 1]]
    };
    // Sums so far of the whole batch, and at the beginning of the group and of the block.
    let (mut all, mut group, mut block) = ([0; 2], [0; 2], [0; 2]);
    for (patch, &raw) in (0..).zip(patches) {
        if patch % GROUP == 0 {
            group = all;
        }
        if patch % BLOCK == 0 {
            block = all;
        }
        let less = |a: [u32; 2], b: [u32; 2]| [a[0] - b[0], a[1] - b[1]];
        let expected = [less(all, block), less(block, group), group];
        assert_eq!(batch.plan().offset_entries(patch).map(at), expected, "patch {patch}");
        let counts = Patch::new(setup.config, raw).counts();
        all = [all[0] + counts.points, all[1] + counts.primitives];
    }
    let (status, _) = machine.status(&batch);
    assert_eq!([status.points(), status.primitives()], all.map(u64::from), "totals");
}

//! Batches that are divided into several portions, windows and rows of workgroups; and the prefix
//! sums.

use crate::common::device::Machine;
use crate::common::expected::{Expected, by_simd};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::sizes::{BLOCK, SECTION, TILE};
use tess_gpu::{Capacity, Dispatch, IndexType, Limits, Numbering, Plan, Setup, Stage, Workgroups};
use tess_verify::generate::SplitMix64;
use tess_wgpu::{DeviceLimits, Gpu, Outputs, Tessellator};
use wgpu::BufferUsages;

/// Limits that divide batches after 65536 patches, a few hundred tiles and 5 workgroups.
const LOW: Limits = Limits { storage_binding: 4 << 20, workgroups: 5 };
/// WebGPU's limits, except that of workgroups.
const TWO: Limits = Limits { workgroups: 2, ..Limits::WEBGPU };

fn setup(domain: Domain) -> Setup {
    Setup::new(domain, Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw))
}

/// Small patches, culled ones among them, with odd numbers of triangles.
fn small(domain: Domain, count: u32) -> Vec<PatchFactors> {
    of_these(domain, count, [0.0, 1.0, 1.0, 1.5, 2.0, 3.0])
}

fn of_these(domain: Domain, count: u32, factors: [f32; 6]) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(12);
    let all =
        (0..count).map(|_| PatchFactors::from_fn(domain, |_| factors[random.below(6) as usize]));
    all.collect()
}

/// Wherever the batch is divided, everything is written once and in its place.
#[test]
#[ignore = "slow: batches of many patches"]
fn portions_windows_and_rows() {
    let mut machine = Machine::open();
    machine.limit(LOW);
    let patches = small(Domain::Triangle, 150_000);
    let setup = setup(Domain::Triangle);
    let plan = Plan::new(setup, 150_000, needed(&mut machine, setup, &patches), LOW);
    assert!(plan.portions() > 1 && rows(&plan, Stage::Factors) > 1, "{plan:?}");
    assert!(plan.point_windows() > 1 && plan.primitive_windows() > 1, "{plan:?}");
    machine.assert_equal(setup, &patches);
    let (numbering, index_type) = (Numbering::PerPatch, IndexType::U16);
    machine.assert_equal(Setup { numbering, index_type, ..setup }, &patches);
}

/// Three sections of blocks in rows of two, with one workgroup too many.
#[test]
#[ignore = "slow: batches of many patches"]
fn rows_of_sections() {
    let mut machine = Machine::open();
    machine.limit(TWO);
    let patches = small(Domain::Triangle, 150_000);
    let setup = setup(Domain::Triangle);
    let plan = Plan::new(setup, 150_000, Capacity::default(), TWO);
    assert!(plan.portions() == 1 && rows(&plan, Stage::Scan) == 2, "{plan:?}");
    machine.assert_equal(setup, &patches);
}

/// Batches that write no points are not divided; and a packed point has 30 bits for its patch's
/// number.
#[test]
#[ignore = "slow: batches of many patches"]
fn batches_too_large_for_their_outputs() {
    let mut machine = Machine::open();
    machine.limit(LOW);
    let setup = setup(Domain::Triangle);
    let most = Plan::new(setup, u32::MAX, Capacity::default(), LOW).portion_patches();
    let factors = machine.factors(&small(Domain::Triangle, most + 1));
    let indices = machine.upload(&[0; 64], BufferUsages::STORAGE);
    let mut refused = |patches: u32, outputs: Outputs<'_>| {
        let batch = machine.tessellator.batch(setup, patches, &factors, outputs);
        batch.err().map(|error| error.to_string())
    };
    let alone = Outputs::Indices { indices: &indices, points: 64 };
    assert_eq!(refused(most, alone), None, "as many as a binding holds");
    let error = refused(most + 1, alone).expect("not all in one binding");
    let words = "patches without a point buffer are more than one binding holds";
    assert!(error.starts_with(&format!("{} {words}, {most};", most + 1)), "{error}");
    assert_eq!(refused(most + 1, Outputs::CountOnly), None, "cut up");
    let too_short = refused(1 << 30, Outputs::CountOnly).expect("there are not as many factors");
    assert!(too_short.contains("bytes of factors"), "{too_short}");
    let too_many = refused((1 << 30) + 1, Outputs::CountOnly).expect("too many");
    assert!(too_many.starts_with("1073741825 patches"), "{too_many}");
}

/// The comparison notices a window that begins at another tile, and workgroups that take each row
/// for the first.
#[test]
#[ignore = "slow: batches of many patches"]
fn wrong_windows_and_rows_are_seen() {
    let patches = small(Domain::Triangle, 150_000);
    let setup = setup(Domain::Triangle);
    let expected = Expected::new(setup, &patches);
    let (points, indices) = expected.words();
    let mut machine = Machine::open();
    for (limits, fault) in [
        (LOW, "write_primitive_tile: windows write from the first one"),
        (LOW, "tiles of further rows of workgroups are those of the first"),
        (LOW, "factors: blocks of further rows are those of the first"),
        (TWO, "scan: sections of further rows are those of the first"),
    ] {
        machine.plant(setup, fault);
        machine.limit(limits);
        let written = machine.write(setup, &patches, points, indices);
        assert!(expected.compare(&written).is_err(), "{fault} went unnoticed");
    }
}

/// The dispatch sizes that the device writes are within the limit, and the check notices others.
#[test]
#[ignore = "slow: batches of many patches"]
fn written_dispatch_sizes_keep_to_the_limit() {
    let mut machine = Machine::open();
    let setup = setup(Domain::Quad);
    let patches = small(Domain::Quad, 100_000);
    for limits in [LOW, TWO] {
        machine.limit(limits);
        let sizes = dispatch_sizes(&mut machine, setup, &patches);
        assert!(sizes.iter().any(|&[_, rows, _]| rows > 1), "there are rows");
        assert!(keep_to(limits, &sizes), "{sizes:?}");
    }
    machine.plant(setup, "write_dispatch: rows have 65535 workgroups");
    machine.limit(LOW);
    assert!(!keep_to(LOW, &dispatch_sizes(&mut machine, setup, &patches)), "longer rows");
}

fn keep_to(limits: Limits, sizes: &[[u32; 3]]) -> bool {
    sizes.iter().all(|&[x, _, z]| x <= limits.workgroups && z == 1)
}

/// The sizes of a batch's indirect dispatches, in order.
fn dispatch_sizes(machine: &mut Machine, setup: Setup, patches: &[PatchFactors]) -> Vec<[u32; 3]> {
    let room = needed(machine, setup, patches);
    let words = [2 * room.points, (3 * room.primitives).next_multiple_of(2)];
    let (batch, _) = machine.batch(setup, patches, words);
    machine.run(&batch);
    assert!(machine.status(&batch).0.fits(), "it fits");
    let arguments = machine.words(batch.draw_arguments());
    let size = |dispatch: Dispatch| match dispatch.workgroups() {
        Workgroups::Direct(_) => None,
        Workgroups::Indirect(at) => {
            let at = usize::try_from(at / 4).expect("in memory");
            arguments[at..].first_chunk().copied()
        }
    };
    batch.plan().dispatches().filter_map(size).collect()
}

/// The patches' needs.
fn needed(machine: &mut Machine, setup: Setup, patches: &[PatchFactors]) -> Capacity {
    let batch = machine.counted(setup, patches);
    let (status, _) = machine.status(&batch);
    let all = |elements: u64| u32::try_from(elements).expect("a test's output");
    Capacity { points: all(status.points()), primitives: all(status.primitives()) }
}

/// The rows of workgroups of a stage's first dispatch.
fn rows(plan: &Plan, stage: Stage) -> u32 {
    let first = plan.dispatches().find(|dispatch| dispatch.stage() == stage);
    match first.expect("it is dispatched").workgroups() {
        Workgroups::Direct([_, rows, _]) => rows,
        Workgroups::Indirect(_) => panic!("{stage:?} is dispatched by the device"),
    }
}

/// Rows of 65535 workgroups on a device that binds gigabytes: 16 million patches in one portion and
/// one window, compared with tess-simd.
#[test]
#[ignore = "6 GiB on a device that binds 3 at once: cargo test --release -p tess-wgpu \
            --test batches cut -- --ignored"]
fn more_workgroups_than_a_row_has_on_request() {
    let everything = Gpu::open_with(DeviceLimits::Highest, wgpu::Features::empty());
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
    assert!(rows(&plan, Stage::Factors) > 1, "{plan:?}");
    let tiles = room.primitives.div_ceil(TILE);
    assert!(plan.primitive_windows() == 1 && tiles > 65535, "{tiles} tiles, {plan:?}");
    let written = machine.write(setup, &patches, words(&points), words(&indices));
    assert!(written.status.fits(), "{:?}", written.status);
    assert!(written.points == points, "points");
    assert!(written.indices == indices, "indices");
}

/// Each level of the prefix sums against a scalar scan.
#[test]
#[ignore = "slow: batches of many patches"]
fn prefix_sums_are_those_of_a_scalar_scan() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        for count in [1, 255, 256, 257, 65_536, 70_000] {
            compare_sums(&mut machine, setup(domain), &small(domain, count));
        }
    }
}

fn compare_sums(machine: &mut Machine, setup: Setup, patches: &[PatchFactors]) {
    let batch = machine.counted(setup, patches);
    let observed = machine.words(batch.offsets());
    let at = |entry: u64| {
        let first = usize::try_from(2 * entry).expect("in memory");
        [observed[first], observed[first + 1]]
    };
    // The running sums of the whole batch, and those at the beginning of the section and of the
    // block.
    let (mut all, mut section, mut block) = ([0; 2], [0; 2], [0; 2]);
    for (patch, &raw) in (0..).zip(patches) {
        if patch % SECTION == 0 {
            section = all;
        }
        if patch % BLOCK == 0 {
            block = all;
        }
        let less = |a: [u32; 2], b: [u32; 2]| [a[0] - b[0], a[1] - b[1]];
        let expected = [less(all, block), less(block, section), section];
        assert_eq!(batch.plan().offset_entries(patch).map(at), expected, "patch {patch}");
        let counts = Patch::new(setup.config, raw).counts();
        all = [all[0] + counts.points, all[1] + counts.primitives];
    }
    let (status, _) = machine.status(&batch);
    assert_eq!([status.points(), status.primitives()], all.map(u64::from), "totals");
}

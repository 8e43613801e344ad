//! Batches in groups: the draw arguments of each group, wherever the batch is divided.

use crate::common::device::Machine;
use crate::common::patches::random;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::layout::DrawIndexed;
use tess_gpu::{Limits, Setup};
use tess_verify::generate::SplitMix64;
use tess_wgpu::{Batch, Error, Outputs};
use wgpu::BufferUsages as Usage;

fn setup(domain: Domain, output: OutputPrimitive) -> Setup {
    Setup::new(domain, Config::new(Partitioning::FractionalOdd, output))
}

/// A batch with room for `points` points and `indices` indices, after it has run.
fn run(
    machine: &mut Machine,
    setup: Setup,
    (patches, groups): (&[PatchFactors], &[u32]),
    [points, indices]: [u32; 2],
) -> Batch {
    let factors = machine.factors(patches);
    let points = machine.upload(&vec![0; 2 * points as usize], Usage::STORAGE);
    let indices = machine.upload(&vec![0; indices.next_multiple_of(2) as usize], Usage::STORAGE);
    let outputs = Outputs::Buffers { points: &points, indices: &indices };
    let count = u32::try_from(patches.len()).expect("a test's patches");
    let batch = machine.tessellator.batch_in_groups(setup, count, groups, &factors, outputs);
    let batch = batch.expect("groups ascend");
    machine.run(&batch);
    batch
}

/// The arguments that a batch left for its groups.
fn observed(machine: &Machine, batch: &Batch, groups: usize) -> Vec<DrawIndexed> {
    let bytes = machine.gpu.read(batch.group_arguments(), 20 * groups as u64);
    bytemuck::pod_collect_to_vec(&bytes.expect("the device answers"))
}

/// The model's numbers of points and indices before each patch and after the last.
fn sums(setup: Setup, patches: &[PatchFactors]) -> Vec<[u32; 2]> {
    let mut sum = [0; 2];
    let mut sums = vec![sum];
    for &factors in patches {
        let counts = Patch::new(setup.config, factors).counts();
        sum = [sum[0] + counts.points, sum[1] + counts.indices];
        sums.push(sum);
    }
    sums
}

/// The arguments that the groups must have.
fn expected(sums: &[[u32; 2]], groups: &[u32]) -> Vec<DrawIndexed> {
    let index = |patch: u32| sums[patch as usize][1];
    let end = u32::try_from(sums.len() - 1).expect("a test's patches");
    let ends = groups.iter().skip(1).copied().chain([end]);
    let draw = |(&begin, end)| DrawIndexed {
        index_count: index(end) - index(begin),
        instance_count: 1,
        first_index: index(begin),
        ..DrawIndexed::default()
    };
    groups.iter().zip(ends).map(draw).collect()
}

/// Whether every group's arguments are right.
fn are_right(
    machine: &mut Machine,
    setup: Setup,
    patches: &[PatchFactors],
    groups: &[u32],
) -> bool {
    let sums = sums(setup, patches);
    let room = sums[patches.len()];
    let batch = run(machine, setup, (patches, groups), room);
    assert!(machine.status(&batch).0.fits(), "there is room");
    observed(machine, &batch, groups.len()) == expected(&sums, groups)
}

/// Groups that begin anywhere, including empty ones and those after the last patch.
fn some_groups(patches: u32, count: u32) -> Vec<u32> {
    let mut random = SplitMix64::new(21);
    let mut groups: Vec<u32> = (0..count).map(|_| random.below(patches)).collect();
    groups.extend([patches / 2, patches / 2, patches, patches]);
    groups.sort_unstable();
    groups
}

#[test]
fn each_group_has_its_own_draw() {
    let mut machine = Machine::open();
    let mut numbers = SplitMix64::new(3);
    for domain in Domain::ALL {
        for output in OutputPrimitive::ALL {
            for count in [1, 300, 1500] {
                let patches = random(domain, count, &mut numbers);
                let setup = setup(domain, output);
                let groups = some_groups(count, 200);
                assert!(are_right(&mut machine, setup, &patches, &groups), "{setup:?}, {count}");
                assert!(are_right(&mut machine, setup, &patches, &[0]), "{setup:?}, {count}");
            }
        }
    }
    let isolines = setup(Domain::Isoline, OutputPrimitive::Line);
    assert!(are_right(&mut machine, isolines, &[], &[0, 0]), "no patches");
}

/// Limits that divide batches after 65536 patches and put five workgroups in a row.
const LOW: Limits = Limits { storage_binding: 4 << 20, workgroups: 5 };

fn many() -> Vec<PatchFactors> {
    let factor = |number: u8| PatchFactors::from_fn(Domain::Triangle, |_| f32::from(number % 3));
    (0..150_000_u32).map(|number| factor(number.to_le_bytes()[0])).collect()
}

/// Groups that end in a later portion than they begin in, and groups that begin with a portion.
fn across_portions() -> Vec<u32> {
    let mut groups = some_groups(150_000, 700);
    groups.extend([65_535, 65_536, 65_537, 131_072]);
    groups.sort_unstable();
    groups
}

#[test]
fn groups_reach_across_portions() {
    let mut machine = Machine::open();
    machine.limit(LOW);
    let setup = setup(Domain::Triangle, OutputPrimitive::TriangleCw);
    let patches = many();
    assert!(are_right(&mut machine, setup, &patches, &across_portions()), "three portions");
    assert!(are_right(&mut machine, setup, &patches, &[10, 149_000]), "two groups");
}

#[test]
#[ignore = "slow: a pipeline for each planted fault"]
fn planted_faults_are_seen() {
    let mut machine = Machine::open();
    let setup = setup(Domain::Triangle, OutputPrimitive::TriangleCw);
    let (patches, groups) = (many(), across_portions());
    for fault in [
        "groups: a group begins in the first portion",
        "groups: a group ends in the first portion",
        "first_index_of: the end of a portion is a patch",
        "first_index_of: patches are numbered from the batch",
        "groups: a group ends where it begins",
        "groups: workgroups have one group",
        "groups: a count is an end",
        "first_index_of: points are counted",
        "first_index_of: a portion ends where it begins",
    ] {
        machine.plant(setup, fault);
        machine.limit(LOW);
        assert!(!are_right(&mut machine, setup, &patches, &groups), "{fault} went unnoticed");
    }
}

#[test]
fn nothing_is_drawn_if_the_output_does_not_fit() {
    let mut machine = Machine::open();
    let setup = setup(Domain::Quad, OutputPrimitive::TriangleCcw);
    let patches = vec![PatchFactors::uniform(Domain::Quad, 5.0); 100];
    let [points, indices] = sums(setup, &patches)[100];
    for room in [[points - 1, indices], [points, indices - 3]] {
        let batch = run(&mut machine, setup, (&patches, &[0, 7, 50]), room);
        let draws = observed(&machine, &batch, 3);
        assert!(draws.iter().all(|draw| draw.index_count == 0), "{draws:?}");
    }
    machine.plant(setup, "groups: a group of output that overflows is drawn");
    let batch = run(&mut machine, setup, (&patches, &[0, 7, 50]), [points - 1, indices]);
    assert_ne!(observed(&machine, &batch, 3)[1].index_count, 0, "the comparison would see it");
}

#[test]
fn misplaced_groups_are_refused() {
    let mut machine = Machine::open();
    let setup = setup(Domain::Quad, OutputPrimitive::TriangleCw);
    let factors = machine.factors(&random(Domain::Quad, 10, &mut SplitMix64::new(1)));
    let mut refused = |groups: &[u32]| {
        let outputs = Outputs::CountOnly;
        machine.tessellator.batch_in_groups(setup, 10, groups, &factors, outputs).err()
    };
    let misplaced = |group, begin, range| Some(Error::MisplacedGroup { group, begin, range });
    assert_eq!(refused(&[0, 4, 3]), misplaced(2, 3, [4, 10]), "they ascend");
    assert_eq!(refused(&[11]), misplaced(0, 11, [0, 10]), "within the batch");
    assert_eq!(refused(&[0, 0, 10]), None, "empty ones may be");
    let text = misplaced(2, 3, [4, 10]).map(|error| error.to_string()).unwrap_or_default();
    assert!(text.contains("group 2 begins at patch 3") && text.contains("4 to 10"), "{text}");
}

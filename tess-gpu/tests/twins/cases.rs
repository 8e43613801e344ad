//! Batches that reach every branch of the passes.

use super::run::{Batch, Machine, PlanForm};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_gpu::sizes::CATALOGUE_PATCHES;
use tess_gpu::{
    Capacity, Copies, IndexType, Limits, Numbering, Order, PointFormat, Resource, Setup, Stage,
    Written,
};
use tess_verify::generate::{SplitMix64, random_patch};

/// Limits that cut after 65536 patches, a few hundred tiles and 5 workgroups.
const LOW: Limits = Limits { storage_binding: 4 << 20, workgroups: 5 };

pub(crate) fn setup(domain: Domain, partitioning: Partitioning) -> Setup {
    Setup::new(domain, Config::new(partitioning, OutputPrimitive::TriangleCw))
}

/// Random patches, boundary values, culled and degenerate ones, and one patch of factor 1.
fn random(domain: Domain, count: u32) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(u64::from(count));
    let mut all: Vec<_> = (1..count).map(|_| random_patch(domain, &mut random)).collect();
    all.push(PatchFactors::uniform(domain, 1.0));
    all
}

/// Patches with random choices of these factors.
pub(crate) fn of(domain: Domain, count: u32, factors: &[f32]) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(77);
    let most = u32::try_from(factors.len()).expect("some factors");
    let mut factor = |_| factors[random.below(most) as usize];
    (0..count).map(|_| PatchFactors::from_fn(domain, &mut factor)).collect()
}

/// Runs of equal patches that begin and end within blocks.
pub(crate) fn runs(domain: Domain, runs: &[(f32, usize)]) -> Vec<PatchFactors> {
    let run = |&(factor, count)| vec![PatchFactors::uniform(domain, factor); count];
    runs.iter().flat_map(run).collect()
}

fn assert_equal(machine: &mut Machine, batch: &Batch) -> Vec<Stage> {
    machine.run(batch).unwrap_or_else(|difference| panic!("{difference}"))
}

/// Every domain and partitioning as a short and as a long batch, with outputs, formats, numberings,
/// index types, orders and split orders in turn.
#[test]
fn every_configuration() {
    let mut machine = Machine::open();
    let mut turn = 0;
    for domain in Domain::ALL {
        let patches = random(domain, 90);
        for partitioning in Partitioning::ALL {
            let mut setup = setup(domain, partitioning);
            setup.config.output = OutputPrimitive::ALL[(turn + turn / 4) % 4];
            setup.config.split = SplitOrder::ALL[turn / 2 % 2];
            setup.point_format = [PointFormat::Packed, PointFormat::F32][(turn + turn / 4) % 2];
            setup.numbering = [Numbering::PerBatch, Numbering::PerPatch][turn / 3 % 2];
            setup.order = [Order::Specification, Order::VertexCache][turn % 2];
            if setup.numbering == Numbering::PerPatch {
                setup.index_type = IndexType::U16;
            }
            turn += 1;
            let batch = Batch::new(setup, patches.clone());
            let short = assert_equal(&mut machine, &batch);
            assert_eq!(short, [Stage::Short, Stage::ExpandShort], "{setup:?}");
            assert_eq!(assert_equal(&mut machine, &batch.long()).len(), 6, "{setup:?}");
        }
    }
}

/// Triangles in both orders and both numberings.
#[test]
fn orders_and_numberings() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        for order in [Order::Specification, Order::VertexCache] {
            for numbering in [Numbering::PerBatch, Numbering::PerPatch] {
                let plain = setup(domain, Partitioning::FractionalOdd);
                let setup = Setup { order, numbering, ..plain };
                let batch = Batch::new(setup, random(domain, 40));
                assert_equal(&mut machine, &batch);
                assert_equal(&mut machine, &batch.long());
            }
        }
    }
}

/// Output that does not fit by one element (points, primitives or both), no room at all, and no
/// patches.
#[test]
fn overflow_and_nothing() {
    let mut machine = Machine::open();
    let setup = setup(Domain::Quad, Partitioning::Integer);
    let patches = of(Domain::Quad, 700, &[1.0, 2.0, 3.0]);
    let counts = patches.iter().map(|&raw| tess_core::Patch::new(setup.config, raw).counts());
    let (points, primitives) = counts.fold((0, 0), |(points, primitives), counts| {
        (points + counts.points, primitives + counts.primitives)
    });
    let rooms = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(less_points, less_primitives)| Capacity {
        points: points - less_points,
        primitives: primitives - less_primitives,
    });
    for room in rooms.into_iter().chain([Capacity::default()]) {
        for groups in [vec![], vec![0, 3, 3, 699]] {
            let batch = Batch { room: Some(room), groups, ..Batch::new(setup, patches.clone()) };
            assert_equal(&mut machine, &batch);
            assert_equal(&mut machine, &batch.long());
        }
    }
    assert_eq!(assert_equal(&mut machine, &Batch::new(setup, Vec::new())), [Stage::Totals]);
}

/// Runs of equal patches, which are copied, and the same without copies.
#[test]
fn copies() {
    let mut machine = Machine::open();
    for partitioning in [Partitioning::Integer, Partitioning::FractionalEven] {
        for copies in [Copies::WhereAlike, Copies::Never] {
            let setup = Setup { copies, ..setup(Domain::Quad, partitioning) };
            let patches =
                runs(Domain::Quad, &[(2.0, 800), (0.0, 600), (5.0, 1), (3.5, 700), (1.0, 900)]);
            assert_equal(&mut machine, &Batch::new(setup, patches));
        }
    }
}

/// A catalogue that holds every topology: unlike patches, equal ones, culled ones, and ones too
/// large for it.
pub(crate) fn catalogued(domain: Domain) -> Vec<PatchFactors> {
    let mut patches = of(domain, CATALOGUE_PATCHES, &[1.0, 1.25, 2.0, 2.75, 4.0]);
    patches.extend(runs(domain, &[(3.0, 700), (0.0, 300), (17.0, 40)]));
    patches
}

#[test]
fn catalogue() {
    let mut machine = Machine::open();
    for (domain, partitioning) in [
        (Domain::Quad, Partitioning::Integer),
        (Domain::Quad, Partitioning::FractionalEven),
        (Domain::Triangle, Partitioning::FractionalOdd),
    ] {
        let batch = Batch::new(setup(domain, partitioning), catalogued(domain));
        assert!(assert_equal(&mut machine, &batch).contains(&Stage::List), "it has a catalogue");
    }
}

/// The numbers of blocks, and of patches in the last block, that the steps of the search in the
/// table of tiles add up to, and one more. Each patch has several tiles, so the search looks for
/// every patch.
#[test]
fn searches_end_at_every_step() {
    let mut machine = Machine::open();
    let setup = Setup { copies: Copies::Never, ..setup(Domain::Quad, Partitioning::Integer) };
    for patches in [15, 16, 17, 31, 32, 33, 63, 64, 65, 1025, 1040, 1041, 1056, 1057] {
        let batch = Batch::new(setup, of(Domain::Quad, patches, &[15.0, 16.0, 17.0])).long();
        assert_equal(&mut machine, &batch);
    }
}

/// More topologies than the catalogue has slots and room for.
pub(crate) fn too_many() -> Batch {
    let patches = of(Domain::Quad, CATALOGUE_PATCHES, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    Batch::new(setup(Domain::Quad, Partitioning::Integer), patches)
}

#[test]
fn full_catalogue() {
    let stages = assert_equal(&mut Machine::open(), &too_many());
    assert!(stages.contains(&Stage::List), "it has a catalogue");
}

/// Groups that begin and end in blocks, between portions and at the end, and empty ones.
const GROUPS: [u32; 8] = [0, 7, 7, 300, 65_000, 65_536, 66_000, 66_500];

/// Two portions, several windows of both outputs and rows of workgroups, with groups.
pub(crate) fn cut_up() -> Batch {
    let mut patches = of(Domain::Quad, 66_300, &[1.0, 1.5, 2.0, 3.0]);
    patches.extend(runs(Domain::Quad, &[(0.0, 100), (4.5, 100)]));
    let setup = setup(Domain::Quad, Partitioning::FractionalOdd);
    let groups = GROUPS.to_vec();
    Batch { limits: LOW, groups, ..Batch::new(setup, patches) }
}

#[test]
fn portions_windows_and_groups() {
    let stages = assert_equal(&mut Machine::open(), &cut_up());
    let count = |stage| stages.iter().filter(|it| **it == stage).count();
    assert_eq!((count(Stage::Factors), count(Stage::Groups)), (2, 2), "two portions: {stages:?}");
    let windows = [Stage::ExpandPoints, Stage::ExpandPrimitives].map(count);
    assert!(windows.iter().all(|&windows| windows >= 4), "two windows or more: {stages:?}");
}

/// Indices without points, and neither.
#[test]
fn batches_that_write_less() {
    let mut machine = Machine::open();
    let setup = setup(Domain::Triangle, Partitioning::Pow2);
    for (written, stages) in [(Written::Indices, 5), (Written::Arguments, 4)] {
        let batch = Batch::new(setup, of(Domain::Triangle, 1500, &[0.0, 1.0, 2.5, 7.0]));
        let batch = Batch { form: PlanForm::Writing(written), ..batch };
        assert_eq!(assert_equal(&mut machine, &batch).len(), stages, "{written:?}");
    }
}

/// Sums of sections that exceed 2^32 several times, which no test's patches reach.
#[test]
fn totals_beyond_32_bits() {
    let patches = of(Domain::Isoline, 300_000, &[1.0]);
    let batch = Batch::new(setup(Domain::Isoline, Partitioning::Integer), patches);
    let batch = Batch { room: Some(Capacity { points: 9, primitives: 9 }), ..batch };
    let mut random = SplitMix64::new(3);
    let large = || u32::MAX - random.below(1 << 20);
    let compared = Machine::open().run_alone(&batch, Stage::Totals, Resource::Offsets, large);
    compared.unwrap_or_else(|difference| panic!("{difference}"));
}

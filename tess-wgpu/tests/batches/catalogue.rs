//! Patches unlike their neighbours, whose elements are looked up in the catalogue of topologies.

use crate::common::device::Machine;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::sizes::CATALOGUE_PATCHES;
use tess_gpu::{Copies, Setup};
use tess_verify::generate::SplitMix64;

/// The fewest patches of a batch that has a catalogue.
const COUNT: u32 = CATALOGUE_PATCHES;

fn setup(domain: Domain, partitioning: Partitioning) -> Setup {
    Setup::new(domain, Config::new(partitioning, OutputPrimitive::TriangleCw))
}

/// Patches each of whose factors is one of these, chosen at random.
fn unlike(domain: Domain, count: u32, factors: &[f32]) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(77);
    let most = u32::try_from(factors.len()).expect("some factors");
    let mut factor = |_| factors[random.below(most) as usize];
    (0..count).map(|_| PatchFactors::from_fn(domain, &mut factor)).collect()
}

/// Factors with so few topologies that the catalogue holds all of them.
const SMALL: [f32; 5] = [1.0, 1.25, 2.0, 2.75, 4.0];

#[test]
fn unlike_neighbours_in_every_configuration() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        let patches = unlike(domain, COUNT, &SMALL);
        for partitioning in Partitioning::ALL {
            for output in [OutputPrimitive::TriangleCw, OutputPrimitive::TriangleCcw] {
                let config = Config::new(partitioning, output);
                machine.assert_equal(Setup::new(domain, config), &patches);
            }
        }
    }
}

#[test]
fn unlike_neighbours_in_every_format() {
    let mut machine = Machine::open();
    for partitioning in [Partitioning::Pow2, Partitioning::FractionalEven] {
        let patches = unlike(Domain::Quad, COUNT, &SMALL);
        let setup = setup(Domain::Quad, partitioning);
        machine.assert_equal_in_every_format(setup, &patches);
    }
}

/// Culled patches, patches of factor 1, large ones that the catalogue does not take, and blocks of
/// equal patches among the others.
#[test]
fn every_kind_of_patch_in_one_batch() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        for partitioning in [Partitioning::Integer, Partitioning::FractionalOdd] {
            let mut patches = unlike(domain, COUNT, &SMALL);
            patches.extend(unlike(domain, 300, &[0.0, 1.0, 1.0, 1.0]));
            patches.extend(unlike(domain, 600, &[2.0]));
            patches.extend(unlike(domain, 600, &[0.0, 3.0, 16.0]));
            patches.extend(unlike(domain, 600, &[1.0, 15.0, 17.0, 31.0, 33.0, 34.0]));
            patches.extend(unlike(domain, 600, &[1.0]));
            machine.assert_equal(setup(domain, partitioning), &patches);
        }
    }
}

/// More topologies than the catalogue has slots and room for.
fn too_many() -> Vec<PatchFactors> {
    unlike(Domain::Quad, COUNT, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0])
}

#[test]
fn more_topologies_than_there_is_room_for() {
    let mut machine = Machine::open();
    machine.assert_equal(setup(Domain::Quad, Partitioning::Integer), &too_many());
}

#[test]
fn equal_neighbours_without_copies() {
    let mut machine = Machine::open();
    for factor in [1.0, 4.0, 17.0] {
        let patches = unlike(Domain::Quad, COUNT, &[factor]);
        let setup = setup(Domain::Quad, Partitioning::Integer);
        machine.assert_equal(Setup { copies: Copies::Never, ..setup }, &patches);
    }
}

#[test]
#[ignore = "slow: a pipeline for each planted fault"]
fn planted_faults_are_seen() {
    let mut machine = Machine::open();
    let integer = setup(Domain::Quad, Partitioning::Integer);
    let odd = setup(Domain::Triangle, Partitioning::FractionalOdd);
    let even = setup(Domain::Quad, Partitioning::FractionalEven);
    let centred = setup(Domain::Triangle, Partitioning::FractionalEven);
    let quads = unlike(Domain::Quad, COUNT, &SMALL);
    let triangles = unlike(Domain::Triangle, COUNT, &[1.0, 1.0, 1.0, 2.5, 5.0, 9.5]);
    machine.assert_noticed(
        integer,
        &quads,
        &[
            "load_patch: the catalogue's points are one word each",
            "unpacked_triangle: the second vertex is one bit high",
            "write_listed_triangles: the second of a pair is of the same patch",
            "write_listed_points: the second of a pair is of the same patch",
            "key_of: inside u and v share a bit",
            "slot_of: any used slot is taken",
            "listed_point: v is 0",
        ],
    );
    machine.assert_noticed(
        integer,
        &with_some(34.0),
        &["load_patch: patches that are not listed are taken as listed"],
    );
    machine.assert_noticed(integer, &one_long_edge(), &["has_key: 34 points fit a key"]);
    machine.assert_noticed(integer, &too_many(), &["take_room: the catalogue has no end"]);
    machine.assert_noticed(odd, &triangles, &["described_point: every corner is the first"]);
    machine.assert_noticed(centred, &triangles, &["described_point: the centre is not marked"]);
    machine.assert_noticed(
        even,
        &quads,
        &[
            "described_point: far constants are near",
            "described_point: constants come from one factor",
            "placed_point: positions have two bits",
        ],
    );
    machine.assert_noticed(
        even,
        &unlike(Domain::Quad, COUNT, &[2.0, 5.0, 8.0]),
        &["placed_point: rings have one bit"],
    );
}

/// Patches of factor 2, in which one factor in ten is replaced by this one.
fn with_some(factor: f32) -> Vec<PatchFactors> {
    unlike(Domain::Quad, COUNT, &[2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, factor])
}

/// Patches with one edge of 33 or 34 points, and 2 to 4 points along everything else: few
/// triangles, but one point more than a key has room for.
fn one_long_edge() -> Vec<PatchFactors> {
    let long = unlike(Domain::Isoline, COUNT, &[1.0, 32.0, 33.0]);
    let rest = unlike(Domain::Quad, COUNT, &[1.0, 2.0, 3.0]);
    let joined = |(long, rest): (&PatchFactors, &PatchFactors)| {
        let (mut first, mut others) = (long.iter(), rest.iter());
        PatchFactors::from_fn(Domain::Quad, |k| {
            let other = others.next().expect("six factors");
            if k == 0 { first.next().expect("two factors") } else { other }
        })
    };
    long.iter().zip(&rest).map(joined).collect()
}

#[test]
fn edges_of_as_many_points_as_a_key_holds() {
    let mut machine = Machine::open();
    machine.assert_equal(setup(Domain::Quad, Partitioning::Integer), &one_long_edge());
}

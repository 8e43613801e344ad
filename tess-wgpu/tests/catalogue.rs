//! Patches unlike their neighbours, whose elements are looked up in the catalogue of topologies.

mod common;

use common::device::Machine;
use common::expected::Expected;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::sizes::CATALOGUE_PATCHES;
use tess_gpu::{Copies, IndexType, Numbering, PointFormat, Setup};
use tess_verify::random::SplitMix64;
use tess_wgpu::Tessellator;

/// As many patches as a batch with a catalogue has.
const COUNT: u32 = CATALOGUE_PATCHES;

fn setup(domain: Domain, partitioning: Partitioning) -> Setup {
    Setup::new(domain, Config::new(partitioning, OutputPrimitive::TriangleCw))
}

/// Patches with these factors at random, each on its own.
fn unlike(domain: Domain, count: u32, factors: &[f32]) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(77);
    let most = u32::try_from(factors.len()).expect("some factors");
    let mut factor = |_| factors[random.below(most) as usize];
    (0..count).map(|_| PatchFactors::from_fn(domain, &mut factor)).collect()
}

/// They give so few topologies that the catalogue holds all of them.
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
        for point_format in [PointFormat::Packed, PointFormat::F32] {
            for numbering in [Numbering::PerBatch, Numbering::PerPatch] {
                machine.assert_equal(Setup { point_format, numbering, ..setup }, &patches);
            }
        }
        let (numbering, index_type) = (Numbering::PerPatch, IndexType::U16);
        machine.assert_equal(Setup { numbering, index_type, ..setup }, &patches);
    }
}

/// Culled patches, patches of factor 1, large ones that the catalogue does not take, and blocks of equal
/// patches among the others.
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
fn planted_faults_are_seen() {
    let mut machine = Machine::open();
    let integer = setup(Domain::Quad, Partitioning::Integer);
    let odd = setup(Domain::Triangle, Partitioning::FractionalOdd);
    let even = setup(Domain::Quad, Partitioning::FractionalEven);
    let centred = setup(Domain::Triangle, Partitioning::FractionalEven);
    let quads = unlike(Domain::Quad, COUNT, &SMALL);
    let triangles = unlike(Domain::Triangle, COUNT, &[1.0, 1.0, 1.0, 2.5, 5.0, 9.5]);
    let large = unlike(Domain::Quad, COUNT, &[2.0, 5.0, 8.0]);
    let unlisted =
        unlike(Domain::Quad, COUNT, &[2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 34.0]);
    let too_many = too_many();
    for (setup, patches, right, wrong) in [
        (integer, &quads, "vec2<u32>(found - words * begin,", "vec2<u32>(found - begin,"),
        (integer, &quads, "packed & 1023u, (packed >> 10u)", "packed & 1023u, (packed >> 11u)"),
        (integer, &quads, "listed_triangle(next, element", "listed_triangle(number, element"),
        (
            integer,
            &quads,
            "listed_point(round, next, element",
            "listed_point(round, number, element",
        ),
        (integer, &unlisted, "if found == 0u && state_of(topology) != CULLED", "if false"),
        (integer, &quads, "(inside_v(topology) - 2u) << 25u", "(inside_v(topology) - 2u) << 24u"),
        (integer, &quads, "if found == key {", "if found != 0u {"),
        (integer, &quads, "catalogue_word(at + 1u)), patch_number", "0u), patch_number"),
        (
            integer,
            &too_many,
            "if points + counts.x > CATALOGUE_POINTS || triangles + counts.y > CATALOGUE_TRIANGLES",
            "if false",
        ),
        (odd, &triangles, "(i << 6u) | (FORM_CORNER << 18u)", "(FORM_CORNER << 18u)"),
        (centred, &triangles, "select(0u, 1u << 21u, constant.is_centre)", "0u"),
        (even, &quads, "select(0u, 1u << 20u, constant.is_far)", "0u"),
        (even, &large, "(described >> 13u) & 31u", "(described >> 13u) & 1u"),
        (even, &quads, "(constant.factor << 3u)", "(4u << 3u)"),
        (even, &quads, "(described >> 6u) & 127u", "(described >> 6u) & 3u"),
    ] {
        let expected = Expected::new(setup, patches);
        let (points, indices) = expected.words();
        machine.tessellator = Tessellator::new(&machine.gpu.device);
        let written = machine.write(setup, patches, points, indices);
        assert_eq!(expected.compare(&written), Ok(()), "without a fault");
        machine.plant(setup, right, wrong);
        let written = machine.write(setup, patches, points, indices);
        assert!(expected.compare(&written).is_err(), "{right} to {wrong} went unnoticed");
    }
}

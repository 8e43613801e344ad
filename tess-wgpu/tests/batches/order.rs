//! The vertex-cache order: equal to the model's, bit for bit, whichever way a tile is made.

use crate::common::device::Machine;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::sizes::CATALOGUE_PATCHES;
use tess_gpu::{Copies, IndexType, Limits, Numbering, Order, Setup};
use tess_verify::generate::SplitMix64;

fn setup(domain: Domain, partitioning: Partitioning, output: OutputPrimitive) -> Setup {
    Setup { order: Order::VertexCache, ..Setup::new(domain, Config::new(partitioning, output)) }
}

fn triangles(domain: Domain) -> Setup {
    setup(domain, Partitioning::FractionalOdd, OutputPrimitive::TriangleCw)
}

/// Patches with random factors from 0 to `most`; every eighth patch has the same factor everywhere.
#[expect(clippy::float_arithmetic, reason = "quarters are exact")]
fn patches(domain: Domain, count: u32, most: u32) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(5);
    let mut factor = || random.below(4 * most + 1) as f32 / 4.0;
    let mut patch = |number: u32| {
        if number.is_multiple_of(8) {
            return PatchFactors::uniform(domain, factor());
        }
        PatchFactors::from_fn(domain, |_| factor())
    };
    (0..count).map(&mut patch).collect()
}

/// Short batches in every partitioning; domains without rings keep the specification's order.
#[test]
#[ignore = "slow: every configuration in another order"]
fn every_configuration() {
    let mut machine = Machine::open();
    let mut check = |domain, partitioning, output| {
        machine.assert_equal(setup(domain, partitioning, output), &patches(domain, 150, 40));
    };
    for domain in [Domain::Triangle, Domain::Quad] {
        for partitioning in Partitioning::ALL {
            check(domain, partitioning, OutputPrimitive::TriangleCw);
        }
        check(domain, Partitioning::Integer, OutputPrimitive::Line);
    }
    check(Domain::Quad, Partitioning::Pow2, OutputPrimitive::TriangleCcw);
    check(Domain::Isoline, Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
}

/// Tiles that are computed, from factors of every size.
#[test]
#[ignore = "slow: every configuration in another order"]
fn large_patches_in_every_format() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        let patches = patches(domain, 1500, 66);
        machine.assert_equal(triangles(domain), &patches);
        let (numbering, index_type) = (Numbering::PerPatch, IndexType::U16);
        machine.assert_equal(Setup { numbering, index_type, ..triangles(domain) }, &patches);
    }
}

/// Tiles that are looked up in the catalogue, and others next to them.
#[test]
#[ignore = "slow: every configuration in another order"]
fn small_patches_of_a_long_batch() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        let mut patches = patches(domain, CATALOGUE_PATCHES, 4);
        patches.extend(self::patches(domain, 100, 40));
        machine.assert_equal(triangles(domain), &patches);
    }
}

/// Tiles that are copies of one patch.
#[test]
#[ignore = "slow: every configuration in another order"]
fn like_neighbours() {
    let mut machine = Machine::open();
    for factor in [2.0, 5.0, 9.0, 16.0, 24.0] {
        let setup = setup(Domain::Quad, Partitioning::Integer, OutputPrimitive::TriangleCcw);
        let patches = vec![PatchFactors::uniform(Domain::Quad, factor); 1100];
        machine.assert_equal(setup, &patches);
        machine.assert_equal(Setup { copies: Copies::Never, ..setup }, &patches);
    }
}

/// Windows of the output end within patches.
#[test]
#[ignore = "slow: every configuration in another order"]
fn output_in_windows() {
    let mut machine = Machine::open();
    machine.limit(Limits { storage_binding: 4 << 20, workgroups: 5 });
    machine.assert_equal(triangles(Domain::Quad), &patches(Domain::Quad, 1500, 40));
}

#[test]
#[ignore = "slow: every configuration in another order"]
fn planted_faults_are_seen() {
    let patches = patches(Domain::Quad, 1500, 40);
    Machine::open().assert_noticed(
        triangles(Domain::Quad),
        &patches,
        &[
            "triangle_location: the vertex-cache order is ignored",
            "borders: no ring is cut",
            "drawn_behind: a column is one step too long",
            "drawn_behind: a column goes on past the last ring",
            "borders: each cut is one step too large",
            "location_in_sector: the transition is one step too long",
            "drawn_next: the next triangle is the same one",
        ],
    );
}

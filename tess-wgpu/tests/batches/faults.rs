//! A comparison counts only after it has been seen to fail: the tests notice damaged shaders.

use crate::common::device::Machine;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::Setup;
use tess_gpu::sizes::SHORT_PATCHES;
use tess_testkit::shader_faults;
use tess_verify::generate::SplitMix64;

#[test]
fn planted_faults_are_seen() {
    let mut machine = Machine::open();
    for (domain, partitioning, faults) in FAULTS {
        let config = Config::new(*partitioning, OutputPrimitive::TriangleCw);
        let setup = Setup::new(*domain, config);
        let mut patches = crate::common::patches::random(*domain, 200, &mut SplitMix64::new(5));
        patches.push(PatchFactors::uniform(*domain, 1.0));
        machine.assert_noticed(setup, &patches, faults);
    }
}

/// The search for the patch of a tile, which a short batch does without.
#[test]
fn a_tile_of_another_patch_is_seen() {
    let mut machine = Machine::open();
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let setup = Setup::new(Domain::Quad, config);
    let count = SHORT_PATCHES + 1;
    let patches = crate::common::patches::random(Domain::Quad, count, &mut SplitMix64::new(5));
    machine.assert_noticed(setup, &patches, &["entry_of"]);
}

/// A test of this folder names each fault of the list.
#[test]
fn every_fault_of_the_list_is_planted() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/batches");
    let files = std::fs::read_dir(folder).expect(folder).map(|entry| entry.expect(folder).path());
    let texts: Vec<String> = files.filter_map(|path| std::fs::read_to_string(path).ok()).collect();
    let is_planted = |name: &str| texts.iter().any(|text| text.contains(&format!("\"{name}\"")));
    let names = shader_faults::all().into_iter().map(|fault| fault.name);
    let forgotten: Vec<_> = names.filter(|name| !is_planted(name)).collect();
    assert!(forgotten.is_empty(), "no test plants {forgotten:?}");
}

/// Faults of shaders by name.
const FAULTS: &[(Domain, Partitioning, &[&str])] = &[
    (
        Domain::Quad,
        Partitioning::FractionalOdd,
        &[
            "HALF",
            "place_before_middle",
            "place_before_middle_2",
            "centre_stitch",
            "centre_stitch_2",
            "stitch_triangles",
            "transition_stitch",
            "nearer_ring",
            "nearer_patch",
            "prefix_sums",
        ],
    ),
    (
        Domain::Triangle,
        Partitioning::FractionalEven,
        &["TWO_THIRDS", "next_patch", "point_of_run", "shape_of", "place"],
    ),
    (
        Domain::Triangle,
        Partitioning::Integer,
        &["ONE_THIRD", "centre_stitch_3", "next_edge", "edge_points"],
    ),
    (
        Domain::Quad,
        Partitioning::Pow2,
        &["rows", "rows_2", "place_2", "place_3", "point_location", "centre_stitch_4", "corner"],
    ),
    (Domain::Isoline, Partitioning::FractionalOdd, &["sequence_first"]),
];

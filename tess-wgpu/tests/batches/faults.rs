//! A comparison counts only after it has been seen to fail: the tests notice damaged shaders.

use crate::common::device::Machine;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::Setup;
use tess_gpu::sizes::SHORT_PATCHES;
use tess_testkit::wgsl_faults;
use tess_verify::generate::SplitMix64;

#[test]
#[ignore = "slow: a pipeline for each planted fault"]
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
    machine.assert_noticed(setup, &patches, &["entry_of: every tile begins in patch 0"]);
}

/// A test of this folder names each fault of the list.
#[test]
fn every_fault_of_the_list_is_planted() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/batches");
    let files = std::fs::read_dir(folder).expect(folder).map(|entry| entry.expect(folder).path());
    let texts: Vec<String> = files.filter_map(|path| std::fs::read_to_string(path).ok()).collect();
    let is_planted = |name: &str| texts.iter().any(|text| text.contains(&format!("\"{name}\"")));
    let names = wgsl_faults::of_batches().into_iter().map(|fault| fault.name);
    let forgotten: Vec<_> = names.filter(|name| !is_planted(name)).collect();
    assert!(forgotten.is_empty(), "no test plants {forgotten:?}");
}

/// Faults of shaders by name.
const FAULTS: &[(Domain, Partitioning, &[&str])] = &[
    (
        Domain::Quad,
        Partitioning::FractionalOdd,
        &[
            "one half is a unit too large",
            "place_before_middle: a fraction is a unit too large",
            "place_before_middle: the split itself counts as behind it",
            "centre_stitch: diagonals turn for the wrong parity",
            "centre_stitch: the second row begins one index late",
            "stitch_triangles: the first triangle has the turn of the second",
            "transition_stitch: the steps are those of the next pair",
            "nearer_ring: a ring begins one element late",
            "nearer_patch: a patch begins one element late",
            "prefix_sums: sixteens are taken for thirty-twos",
        ],
    ),
    (
        Domain::Triangle,
        Partitioning::FractionalEven,
        &[
            "two thirds are a unit too large",
            "next_patch: the next patch begins one element late",
            "point_of_run: half of a distance is rounded down",
            "shape_of: another edge descends",
            "place: the middle is one point late",
        ],
    ),
    (
        Domain::Triangle,
        Partitioning::Integer,
        &[
            "one third is a unit too large",
            "centre_stitch: the centre triangle has a corner twice",
            "next_edge: no edge is the last",
            "edge_points: factor 1 has a point for the other parity",
        ],
    ),
    (
        Domain::Quad,
        Partitioning::Pow2,
        &[
            "rows: a row that walks back does not turn",
            "rows: a row that walks back turns at its end",
            "place: the second half is not mirrored",
            "place: the middle of an even edge is computed",
            "point_location: the row has two edges",
            "centre_stitch: the strip runs along the shorter axis",
            "corner: the last corner of a quad is at u = 1",
        ],
    ),
    (
        Domain::Isoline,
        Partitioning::FractionalOdd,
        &["sequence_first: lines have one segment more"],
    ),
];

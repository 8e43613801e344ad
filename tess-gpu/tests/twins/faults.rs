//! A fault is detected in the pass that has it, whatever it breaks in later passes.

use super::cases::{catalogued, cut_up, of, runs, setup, too_many};
use super::run::{Batch, Machine};
use tess_core::{Domain, Partitioning};
use tess_gpu::{Limits, Resource, Stage};
use tess_testkit::wgsl_faults;

/// Plants faults by name and demands that the first difference is in this pass and buffer.
fn assert_named(batch: &Batch, faults: &[(&str, Stage, Resource)]) {
    let mut machine = Machine::open();
    if let Err(difference) = machine.run(batch) {
        panic!("without a fault: {difference}");
    }
    for &(name, stage, resource) in faults {
        let fault = wgsl_faults::named(name);
        let seen = machine.run_with(batch, |_, source| fault.planted(source)).err();
        let seen = seen.unwrap_or_else(|| panic!("{name} went unnoticed"));
        assert_eq!((seen.stage, seen.resource), (stage, resource), "{name}: {seen}");
    }
}

#[test]
fn of_a_short_batch() {
    use Resource::{Indices, Offsets, Points, Status, Tiles, Topologies};
    let odd = setup(Domain::Quad, Partitioning::FractionalOdd);
    let batch = Batch::new(odd, of(Domain::Quad, 600, &[0.0, 1.0, 1.5, 3.25, 7.5]));
    assert_named(
        &batch,
        &[
            ("prefix_sums: sixteens are taken for thirty-twos", Stage::Short, Offsets),
            ("short_batch: a block begins where it ends", Stage::Short, Offsets),
            ("short_batch: primitives end where points do", Stage::Short, Status),
            ("write_tiles: primitives are entered for points", Stage::Short, Tiles),
            (
                "place_before_middle: the split itself counts as behind it",
                Stage::ExpandShort,
                Points,
            ),
            ("centre_stitch: diagonals turn for the wrong parity", Stage::ExpandShort, Indices),
        ],
    );
    let integer = setup(Domain::Triangle, Partitioning::Integer);
    let batch = Batch::new(integer, of(Domain::Triangle, 600, &[0.0, 1.0, 3.25, 7.5]));
    assert_named(
        &batch,
        &[("edge_points: factor 1 has a point for the other parity", Stage::Short, Topologies)],
    );
}

#[test]
fn of_a_long_batch() {
    use Resource::{Indices, Offsets, Points, Tiles};
    let integer = setup(Domain::Quad, Partitioning::Integer);
    let like = runs(Domain::Quad, &[(2.0, 1350), (1.0, 3600), (10.0, 750), (5.0, 920)]);
    assert_named(
        &Batch::new(integer, like),
        &[
            ("process_block: every block is alike", Stage::Factors, Offsets),
            ("entry_of: every tile begins in patch 0", Stage::Partition, Tiles),
            ("copy_points: patches are numbered from the tile", Stage::ExpandPoints, Points),
            ("kept_index: copies forget the first index", Stage::ExpandPrimitives, Indices),
        ],
    );
    let rows = Limits { workgroups: 1, ..Limits::WEBGPU };
    let unlike = of(Domain::Isoline, 66_000, &[1.0, 2.0]);
    let batch = Batch::new(setup(Domain::Isoline, Partitioning::Integer), unlike);
    assert_named(
        &Batch { limits: rows, ..batch },
        &[("scan: sections of further rows are those of the first", Stage::Scan, Offsets)],
    );
}

#[test]
fn of_a_batch_that_is_cut_up() {
    use Resource::{Arguments, Draws, Offsets};
    assert_named(
        &cut_up(),
        &[
            (
                "factors: blocks of further rows are those of the first",
                Stage::Factors,
                Resource::Catalogue,
            ),
            ("totals: the first portion begins at the last run's end", Stage::Totals, Offsets),
            ("write_dispatch: rows have 65535 workgroups", Stage::Totals, Arguments),
            ("groups: a count is an end", Stage::Groups, Draws),
            (
                "write_primitive_tile: windows write from the first one",
                Stage::ExpandPoints,
                Resource::Points,
            ),
        ],
    );
}

#[test]
fn of_a_catalogue() {
    use Resource::{Catalogue, Indices, Points};
    let even = setup(Domain::Quad, Partitioning::FractionalEven);
    assert_named(
        &Batch::new(even, catalogued(Domain::Quad)),
        &[
            ("key_of: inside u and v share a bit", Stage::Factors, Catalogue),
            ("described_point: far constants are near", Stage::List, Catalogue),
            ("placed_point: positions have two bits", Stage::ExpandPoints, Points),
        ],
    );
    let integer = setup(Domain::Quad, Partitioning::Integer);
    let listed = Batch::new(integer, catalogued(Domain::Quad));
    let fault = (
        "write_listed_triangles: the second of a pair is of the same patch",
        Stage::ExpandPrimitives,
        Indices,
    );
    assert_named(&listed, &[("listed_point: v is 0", Stage::ExpandPoints, Points), fault]);
    assert_named(&too_many(), &[("take_room: the catalogue has no end", Stage::List, Catalogue)]);
}

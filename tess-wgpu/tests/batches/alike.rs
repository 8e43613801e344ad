//! Runs of patches of equal topology, whose elements are copied, and patches that are not copied.

use crate::common::device::Machine;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::Setup;
use tess_gpu::sizes::{BLOCK, SHORT_PATCHES};
use tess_verify::generate::SplitMix64;

/// Runs of patches with these factors, of these lengths. They begin and end within blocks, and each
/// is long enough for tiles within whole blocks; the copies begin at various elements of a patch.
fn runs(domain: Domain, runs: &[(f32, usize)]) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(31);
    let mut all = Vec::new();
    for (number, &(factor, length)) in runs.iter().enumerate() {
        let outer = if number % 3 == 2 { 13.0 } else { factor };
        let like =
            PatchFactors::from_fn(domain, |position| if position == 1 { outer } else { factor });
        all.extend(std::iter::repeat_n(like, length));
        let other = [1.0, 2.5, 7.0][random.below(3) as usize];
        all.extend(std::iter::repeat_n(PatchFactors::uniform(domain, other), number % 2));
    }
    all
}

#[test]
#[ignore = "slow: many pipelines"]
fn like_patches_in_every_domain_partitioning_and_output() {
    let mut machine = Machine::open();
    for domain in Domain::ALL {
        let patches = runs(
            domain,
            &[
                (1.0, 3560),
                (2.0, 1390),
                (0.0, 3680),
                (3.0, 1053),
                (1.0, 3720),
                (4.75, 1030),
                (1.0, 3800),
                (9.0, 1157),
            ],
        );
        for partitioning in Partitioning::ALL {
            for output in OutputPrimitive::ALL {
                let config = Config::new(partitioning, output);
                machine.assert_equal(Setup::new(domain, config), &patches);
            }
        }
    }
}

/// Copies in every format, and patches just below and above the largest that are copied.
#[test]
#[ignore = "slow: many pipelines"]
fn like_patches_of_every_size_and_format() {
    let mut machine = Machine::open();
    for domain in [Domain::Triangle, Domain::Quad] {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCcw);
        let setup = Setup::new(domain, config);
        for factor in (1_u8..=19).map(f32::from) {
            let count = if factor > 4.0 { SHORT_PATCHES as usize + 1 } else { 3000 };
            machine.assert_equal(setup, &vec![PatchFactors::uniform(domain, factor); count]);
        }
        let patches = runs(domain, &[(1.0, 3560), (6.0, 680), (2.0, 1430)]);
        machine.assert_equal_in_every_format(setup, &patches);
    }
}

/// Patches of the same topology with other points: factors that round up to the same number of
/// segments.
#[test]
#[ignore = "slow: many pipelines"]
fn equal_topologies_with_different_points() {
    let mut machine = Machine::open();
    let mut random = SplitMix64::new(6);
    for domain in Domain::ALL {
        for partitioning in [Partitioning::FractionalOdd, Partitioning::FractionalEven] {
            let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
            let factors = [3.25, 3.5, 3.625, 3.75];
            let mut similar = |_| factors[random.below(4) as usize];
            let patches: Vec<_> =
                (0..2000).map(|_| PatchFactors::from_fn(domain, &mut similar)).collect();
            machine.assert_equal(Setup::new(domain, config), &patches);
        }
    }
}

/// Whether the patches of each block are alike, by `factors`.
#[test]
#[ignore = "slow: many pipelines"]
fn blocks_know_whether_their_patches_are_alike() {
    let mut machine = Machine::open();
    let setup =
        Setup::new(Domain::Quad, Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw));
    let of = |factor: f32, count: usize| vec![PatchFactors::uniform(Domain::Quad, factor); count];
    let patches = [
        of(2.0, 256),
        of(5.0, 255),
        of(6.0, 1),
        of(7.0, 1),
        of(8.0, 255),
        of(0.0, 256),
        of(9.0, 7),
    ]
    .concat();
    let batch = machine.counted(setup, &patches);
    let (offsets, topologies) = (machine.words(batch.offsets()), machine.words(batch.topologies()));
    let words =
        |words: &[u32], at: u64| words[2 * usize::try_from(at).expect("in memory")..][..2].to_vec();
    let block = |number: u32| words(&offsets, batch.plan().alike_entry(BLOCK * number));
    for (number, alike) in [(0, true), (1, false), (2, false), (4, true)] {
        let first = words(&topologies, u64::from(number * BLOCK));
        assert_eq!(block(number), if alike { first } else { vec![0, 0] }, "block {number}");
    }
    assert_eq!(block(3)[0] >> 28, 0, "culled patches are alike, and culled");
}

#[test]
#[ignore = "slow: many pipelines"]
fn planted_faults_are_seen() {
    let mut machine = Machine::open();
    let setup = |partitioning| {
        Setup::new(Domain::Quad, Config::new(partitioning, OutputPrimitive::TriangleCw))
    };
    let integer = setup(Partitioning::Integer);
    let fractional = setup(Partitioning::FractionalOdd);
    let alike = runs(Domain::Quad, &[(2.0, 1350), (1.0, 3600), (10.0, 750), (5.0, 920)]);
    let similar: Vec<_> = (0..SHORT_PATCHES + 200)
        .map(|n| PatchFactors::from_fn(Domain::Quad, |_| f32::from_bits(0x4050_0000 + 512 * n)))
        .collect();
    machine.assert_noticed(
        integer,
        &alike,
        &[
            "process_block: every block is alike",
            "common_topology: one block decides for a tile",
            "repeat_of: the inverse of a size is rounded down",
            "repeat_of: a tile begins with its first patch",
            "kept_index: copies forget the first index",
            "packed_triangle: the third vertex is one bit high",
            "corner_at: a third is too small",
            "next_corner: a patch ends one triangle late",
            "copy_points: patches are numbered from the tile",
            "keep_triangles: the second half replaces the first",
        ],
    );
    machine.assert_noticed(
        integer,
        &different_inside(),
        &["process_block: inside factors are not compared"],
    );
    machine.assert_noticed(
        fractional,
        &similar,
        &["has_same_points: fractional points are copied"],
    );
}

/// A batch whose patches differ only in an inside factor.
fn different_inside() -> Vec<PatchFactors> {
    let inside = |number: u32| if number.is_multiple_of(3) { 5.0 } else { 3.0 };
    let patch =
        |number| PatchFactors::from_fn(Domain::Quad, |k| if k == 5 { inside(number) } else { 3.0 });
    (0..SHORT_PATCHES + 200).map(patch).collect()
}

#[test]
#[ignore = "slow: many pipelines"]
fn patches_that_differ_inside_alone() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    Machine::open().assert_equal(Setup::new(Domain::Quad, config), &different_inside());
}

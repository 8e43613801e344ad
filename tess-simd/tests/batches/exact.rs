//! Whole batches, equal to the core's bit for bit: every configuration, level, format and
//! numbering.

use crate::patches::{Patches, compare, configs, difference};
use tess_core::{
    Config, Domain, DomainPoint, OutputPrimitive, Partitioning, PatchFactors, QuadFactors,
    SplitOrder, Tessellation, TriangleFactors,
};
use tess_simd::{IndexFormat, Level, Numbering, Output, PatchRange, Tessellator};
use tess_testkit::levels::levels;
use tess_verify::generate::SplitMix64;

const SAME: fn(DomainPoint) -> DomainPoint = |point| point;

/// One batch in every format and numbering.
fn compare_all(tessellator: &mut Tessellator, domain: Domain, patches: &Patches) {
    let expected = patches.expected(tessellator.config());
    let structures = (patches, patches.structures(domain));
    let columns = (patches, patches.columns(domain));
    let of_any_domain = (patches, (&patches.all).into());
    let to_f32 = DomainPoint::to_f32;
    for numbering in [Numbering::PerPatch, Numbering::PerBatch { base_vertex: 77 }] {
        compare::<DomainPoint, u32>(tessellator, structures, &expected, numbering, SAME);
        compare::<[f32; 2], u16>(tessellator, columns, &expected, numbering, to_f32);
    }
    compare::<DomainPoint, u16>(tessellator, of_any_domain, &expected, Numbering::PerPatch, SAME);
    compare::<[f32; 2], u32>(tessellator, structures, &expected, Numbering::PerPatch, to_f32);
}

fn tessellator(config: Config, level: Level) -> Tessellator {
    Tessellator::with_level(config, level).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_configuration_at_every_level() {
    for level in levels() {
        for (seed, config) in (0..).zip(configs()) {
            let mut tessellator = tessellator(config, level);
            for domain in Domain::ALL {
                compare_all(&mut tessellator, domain, &Patches::random(seed, domain, 203));
            }
        }
    }
}

/// Equal patches, alone and with another patch before or after them, at every length that is
/// processed differently: up to 4 patches go one by one, from 8 copying pays, and 64 are a chunk.
#[test]
fn runs_of_every_length() {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    for level in levels() {
        let mut tessellator = tessellator(config, level);
        for domain in Domain::ALL {
            for equal in (1..=9).chain([15, 16, 17, 62, 63, 64, 65, 127, 128, 129]) {
                for factor in [0.0, 1.0, 4.0, 20.0] {
                    let mut all = vec![PatchFactors::uniform(domain, factor); equal];
                    compare_all(&mut tessellator, domain, &Patches::new(all.clone()));
                    all.push(PatchFactors::uniform(domain, 2.5));
                    compare_all(&mut tessellator, domain, &Patches::new(all.clone()));
                    all.rotate_right(1);
                    compare_all(&mut tessellator, domain, &Patches::new(all));
                }
            }
        }
    }
}

/// Many patches, so that templates replace each other.
#[test]
fn large_batches() {
    let outputs = [OutputPrimitive::TriangleCcw, OutputPrimitive::Line];
    for (seed, level) in (200..).zip(levels()) {
        for output in outputs {
            for partitioning in Partitioning::ALL {
                let mut tessellator = tessellator(Config::new(partitioning, output), level);
                for domain in Domain::ALL {
                    let patches = Patches::random(seed, domain, 803);
                    compare_all(&mut tessellator, domain, &patches);
                }
            }
        }
    }
}

/// More topologies of compact patches than there is room for, and then the first ones again: the
/// room is emptied several times, and lost templates are made again. With points as primitives the
/// room for points is full first, with triangles the room for indices.
#[test]
fn more_compact_templates_than_there_is_room_for() {
    let mut random = SplitMix64::new(41);
    let mut factor = || f32::from(u8::try_from(1 + random.below(14)).unwrap_or(1));
    let mut all: Vec<_> =
        (0..6000).map(|_| PatchFactors::from_fn(Domain::Quad, |_| factor())).collect();
    all.extend_from_within(..3000);
    // Every quad of factors 1 and 2, twice: the minimum patch has the counts of another.
    let small = |bits: u8| PatchFactors::from_fn(Domain::Quad, |i| f32::from(1 + (bits >> i & 1)));
    all.extend((0..128).map(small));
    let patches = Patches::new(all);
    for level in levels() {
        for output in [OutputPrimitive::Point, OutputPrimitive::TriangleCw] {
            for partitioning in [Partitioning::Integer, Partitioning::FractionalEven] {
                let config = Config::new(partitioning, output);
                let expected = patches.expected(config);
                let batch = (&patches, patches.structures(Domain::Quad));
                let mut tessellator = tessellator(config, level);
                let numbering = Numbering::PerPatch;
                compare::<DomainPoint, u32>(&mut tessellator, batch, &expected, numbering, SAME);
            }
        }
    }
}

/// Every pair of integer factors: outer and inside factor of triangles, both inside factors of
/// quads.
#[test]
fn every_pair_of_counts() {
    let pairs = (1..=64u8).flat_map(|a| (1..=64u8).map(move |b| (f32::from(a), f32::from(b))));
    let triangle = |(a, b)| {
        PatchFactors::Triangle(TriangleFactors { u0: a, v0: 65.0 - a, w0: 1.0, inside: b })
    };
    let quad = |(a, b)| {
        PatchFactors::Quad(QuadFactors {
            u0: b,
            v0: a,
            u1: 65.0 - a,
            v1: 65.0 - b,
            inside_u: a,
            inside_v: b,
        })
    };
    let triangles = Patches::new(pairs.clone().map(triangle).collect());
    let quads = Patches::new(pairs.map(quad).collect());
    for level in levels() {
        for split in SplitOrder::ALL {
            let config = Config {
                partitioning: Partitioning::Integer,
                output: OutputPrimitive::TriangleCw,
                split,
            };
            let mut tessellator = tessellator(config, level);
            for (domain, patches) in [(Domain::Triangle, &triangles), (Domain::Quad, &quads)] {
                let expected = patches.expected(config);
                let batch = (patches, patches.structures(domain));
                compare::<DomainPoint, u32>(
                    &mut tessellator,
                    batch,
                    &expected,
                    Numbering::PerPatch,
                    SAME,
                );
            }
        }
    }
}

/// A run of more equal patches than 16 bits can count, numbered through the batch: minimum
/// triangles, of which patch k has the points 3k to 3k + 2.
#[test]
fn long_runs() {
    const PATCHES: u32 = 70_000;
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patches = vec![TriangleFactors { u0: 1.0, v0: 1.0, w0: 1.0, inside: 1.0 }; 70_000];
    let one = PatchFactors::from(patches[0]);
    let Tessellation { points, indices } = tess_core::Patch::new(config, one).tessellate();
    for level in levels() {
        let mut output = Output::<DomainPoint, u32>::new();
        let numbering = Numbering::PerBatch { base_vertex: 5 };
        let counts = tessellator(config, level).tessellate(&patches, numbering, &mut output);
        assert!(counts.is_ok_and(|counts| counts.patches == 70_000), "{level}");
        let all = (0..PATCHES).zip(output.ranges());
        for (k, &range) in all {
            let expected =
                PatchRange { first_point: 3 * k, points: 3, first_index: 3 * k, indices: 3 };
            assert_eq!(range, expected, "{level}, patch {k}");
            let (of_patch, numbers) = output.patch(k as usize).expect("a patch of the batch");
            assert_eq!(of_patch, points, "{level}, points of patch {k}");
            let expected = indices.iter().map(|index| 5 + 3 * k + index);
            assert!(numbers.iter().copied().eq(expected), "{level}, patch {k}: {numbers:?}");
        }
    }
}

/// The largest batch that 16 bits number without the index that restarts primitives: 21 845
/// triangles.
#[test]
fn sixteen_bits_without_the_restart_index() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patches = vec![TriangleFactors { u0: 1.0, v0: 1.0, w0: 1.0, inside: 1.0 }; 21_845];
    let mut tessellator = Tessellator::new(config);
    let counted = tessellator.count(&patches).expect("few patches");
    let (points, numbering) = (counted.points() as u64, Numbering::PerBatch { base_vertex: 0 });
    assert_eq!(points, <u16 as IndexFormat>::POINTS_WITHOUT_RESTART);
    assert_eq!(counted.largest_index(numbering), Some(<u16 as IndexFormat>::LARGEST - 1));
}

/// The largest index of batches of one patch, of a culled one, and of equal ones, each counted in
/// its own way.
#[test]
fn the_largest_index_of_few_patches() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let mut tessellator = Tessellator::new(config);
    for (factor, patches, of_patch, of_batch) in [
        (2.0, 1, Some(8), Some(77 + 8)),
        (0.0, 1, None, None),
        (2.0, 3, Some(8), Some(77 + 26)),
        (2.0, 100, Some(8), Some(77 + 899)),
    ] {
        let all = vec![QuadFactors::uniform(factor); patches];
        let counted = tessellator.count(&all).expect("few patches");
        let numberings = [Numbering::PerPatch, Numbering::PerBatch { base_vertex: 77 }];
        let found = numberings.map(|numbering| counted.largest_index(numbering));
        assert_eq!(found, [of_patch, of_batch], "{patches} patches of factor {factor}");
    }
}

/// The comparison above detects a fault in any element.
#[test]
fn planted_faults_are_seen() {
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let patches = Patches::random(5, Domain::Quad, 17);
    let mut output = Output::<DomainPoint, u32>::new();
    let numbering = Numbering::PerPatch;
    let batch = patches.structures(Domain::Quad);
    let counts = Tessellator::new(config).tessellate(batch, numbering, &mut output);
    assert!(counts.is_ok_and(|counts| counts.indices > 0), "something to compare");
    let right = patches.expected(config);
    let seen = |expected: &[Tessellation]| {
        difference((config, &patches.all), expected, numbering, &output, SAME)
    };
    assert_eq!(seen(&right), None, "no fault yet");
    for (patch, whole) in right.iter().enumerate().filter(|(_, whole)| !whole.points.is_empty()) {
        for element in [0, whole.points.len() - 1] {
            let mut wrong = right.clone();
            let point = wrong[patch].points[element];
            wrong[patch].points[element] =
                DomainPoint::from_bits(point.u.to_bits(), point.v.to_bits() ^ 1);
            let named = format!("patch {patch}, case quad fractional_even triangle_cw ruler ");
            let element = format!(": point {element} (Some(");
            let found = seen(&wrong).unwrap_or_default();
            assert!(found.starts_with(&named) && found.contains(&element), "{element}: {found}");
        }
        for element in [0, whole.indices.len() - 1] {
            let mut wrong = right.clone();
            wrong[patch].indices[element] ^= 1;
            assert!(seen(&wrong).is_some_and(|d| d.contains("index")), "index of patch {patch}");
        }
        let mut wrong = right.clone();
        wrong[patch].indices.pop();
        assert!(seen(&wrong).is_some(), "count of patch {patch}");
    }
}

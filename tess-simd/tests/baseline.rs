//! Every stage at the baseline level: a small test program that finds a fault anywhere soon. The
//! other tests cover every level and combination of formats and numberings.

#[path = "common/patches.rs"]
mod patches;

use allocation_counter::measure;
use patches::{Patches, compare, configs};
use tess_core::{
    Config, Counts, Domain, DomainPoint, IsolineFactors, MAX_INDICES, MAX_POINTS, OutputPrimitive,
    Partitioning, PatchFactors, QuadFactors, SplitOrder,
};
use tess_simd::{Batch, BatchBuffer, Error, Level, LevelUnavailableError, Numbering, Tessellator};

/// One test, with the fastest parts first: it ends at the first difference.
#[test]
fn every_stage() {
    messages();
    memory();
    picture_frames();
    levels_that_are_missing();
    batches_know_their_size();
    #[cfg(feature = "taps")]
    taps::every_tap();
    random_patches_in_every_configuration();
    factors_that_differ_in_one_bit();
    topologies_that_differ_in_one_factor();
    interiors();
    many_patches();
}

/// Compares patches in both layouts, numberings and kinds of points and indices with the core's.
fn check(config: Config, domain: Domain, patches: &Patches) {
    let mut tessellator =
        Tessellator::with_level(config, Level::Baseline).expect("always available");
    let expected = patches.expected(config);
    for (batch, numbering) in [
        (Batch::from(&patches.all), Numbering::PerPatch),
        (patches.columns(domain), Numbering::PerBatch { base_vertex: 77 }),
    ] {
        let same = |point| point;
        compare::<DomainPoint, u32>(&mut tessellator, (patches, batch), &expected, numbering, same);
    }
    let batch = (patches, patches.structures(domain));
    let to_f32 = DomainPoint::to_f32;
    compare::<[f32; 2], u16>(&mut tessellator, batch, &expected, Numbering::PerPatch, to_f32);
    let (mut points, mut indices) =
        (vec![DomainPoint::default(); MAX_POINTS], vec![0_u32; MAX_INDICES]);
    for (&factors, expected) in patches.all.iter().zip(&expected) {
        let written = tessellator.patch(factors, &mut points, &mut indices);
        let Counts { points: count, indices: index_count, .. } = written.expect("there is room");
        assert!(points[..count as usize] == expected.points, "{config:?} {factors:?}: points");
        assert!(
            indices[..index_count as usize] == expected.indices,
            "{config:?} {factors:?}: indices"
        );
    }
}

fn random_patches_in_every_configuration() {
    for (seed, config) in (0..).zip(configs()) {
        for domain in Domain::ALL {
            check(config, domain, &Patches::random(seed, domain, 21));
        }
    }
}

fn many_patches() {
    for domain in Domain::ALL {
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCcw);
        check(config, domain, &Patches::random(300, domain, 600));
    }
}

/// One line per factor, all with the same number of points and different locations: factors that
/// differ in one of their lowest bits.
#[expect(clippy::float_arithmetic, reason = "exact: multiples of 2^-16 below 64")]
fn factors_that_differ_in_one_bit() {
    for partitioning in [Partitioning::FractionalOdd, Partitioning::FractionalEven] {
        let config = Config::new(partitioning, OutputPrimitive::Point);
        let line = |detail| PatchFactors::Isoline(IsolineFactors { density: 1.0, detail });
        let factors = (8..100_u8).map(|n| f32::from(n) * 0.625);
        let pair = |f: f32| (0..7).flat_map(move |bit| [f, f + f32::from(1_u8 << bit) / 65536.0]);
        check(config, Domain::Isoline, &Patches::new(factors.flat_map(pair).map(line).collect()));
    }
}

/// Batches in which one factor takes every integer, up and down again: each topology differs from
/// its neighbour by one point and recurs.
fn topologies_that_differ_in_one_factor() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    for domain in [Domain::Triangle, Domain::Quad] {
        for position in 0..domain.factors() {
            let patch = |n: u8| {
                let mut factors = [3.0, 5.0, 2.0, 4.0, 6.0, 3.0];
                factors[position] = f32::from(n);
                PatchFactors::from_fn(domain, |factor| factors[factor])
            };
            let all = (1..=16).chain((1..=16).rev()).chain(1..=64).map(patch).collect();
            check(config, domain, &Patches::new(all));
        }
    }
}

/// Quads of most pairs of inside factors, each outer factor with each parity of inside factor.
fn interiors() {
    let pairs = (1..=64u8).flat_map(|u| (1..=64u8).map(move |v| (u, v)));
    let some = pairs.filter(|(u, v)| u.max(v) <= &12 || (u % 7 * 3 + v) % 7 == 0);
    let quad = |(u, v): (u8, u8)| {
        let [u0, v0, u1, v1] = [v, u, 65 - v, 65 - u].map(f32::from);
        let [inside_u, inside_v] = [u, v].map(f32::from);
        PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v })
    };
    let patches = Patches::new(some.map(quad).collect());
    for split in SplitOrder::ALL {
        let config =
            Config { split, ..Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw) };
        check(config, Domain::Quad, &patches);
    }
}

/// Errors say what was needed and what there was.
fn messages() {
    let error = Error::BufferTooSmall { buffer: BatchBuffer::Indices, needed: 66, got: 65 };
    let message = "the index buffer holds 65 elements, but 66 are needed";
    assert_eq!(error.to_string(), message, "a buffer");
    let error = Error::UnevenColumns { lengths: [8, 9] };
    let message = "a column has 8 factors and another 9; all need one length";
    assert_eq!(error.to_string(), message, "columns");
    let (found, expected) = (Domain::Quad, Domain::Triangle);
    let message = "patch 3 has the domain Quad, its batch Triangle; a batch has one domain";
    assert_eq!(Error::MixedDomains { patch: 3, found, expected }.to_string(), message, "domains");
    let message = "this machine cannot run the CPU level avx512";
    assert_eq!(LevelUnavailableError(Level::Avx512).to_string(), message, "a level");
}

/// `Tessellator::memory` is the memory that a tessellator allocates, and the little that it is
/// itself. The shared tables exist beforehand.
fn memory() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    drop(Tessellator::new(config));
    let mut made = None;
    let allocated = measure(|| {
        made = Tessellator::with_level(config, Level::Baseline).ok();
        let patches = [QuadFactors::uniform(3.0)];
        let counted = made.as_mut().map(|tessellator| {
            let mut output = tess_simd::ExactOutput::new();
            tessellator.tessellate(&patches, Numbering::PerPatch, &mut output)
        });
        assert!(matches!(counted, Some(Ok(_))), "{counted:?}");
    });
    let memory = made.map_or(0, |tessellator| tessellator.memory());
    let allocated = usize::try_from(allocated.bytes_current).unwrap_or(0);
    let within = allocated..allocated + 2048;
    assert!(within.contains(&memory), "{memory} bytes, {allocated} allocated");
}

/// Levels that this machine lacks are refused; without `std` the machine cannot be asked.
fn levels_that_are_missing() {
    if cfg!(not(feature = "std")) {
        let available = Level::ALL.map(Level::is_available);
        assert_eq!(available, [true, false, false], "the baseline alone");
    }
    let config = Config::new(Partitioning::Integer, OutputPrimitive::Point);
    for level in Level::ALL {
        let is_made = Tessellator::with_level(config, level).is_ok();
        assert_eq!(is_made, level.is_available(), "{level}");
    }
}

fn batches_know_their_size() {
    for domain in Domain::ALL {
        let [none, some] = [0, 21].map(|count| Patches::random(1, domain, count));
        for empty in [none.structures(domain), none.columns(domain)] {
            assert!(empty.is_empty(), "{empty:?}");
            assert_eq!(empty.domain(), domain, "{empty:?}");
        }
        for batch in [some.structures(domain), some.columns(domain), (&some.all).into()] {
            let size = (batch.len(), batch.is_empty(), batch.domain());
            assert_eq!(size, (21, false, domain), "{domain:?}");
        }
    }
    let none: Vec<PatchFactors> = Vec::new();
    assert_eq!((Batch::from(&none).len(), Batch::from(&none).domain()), (0, Domain::Quad), "none");
    let (long, short) = ([2.0; 9], [2.0; 8]);
    let uneven = Batch::from(IsolineFactors { density: &long[..], detail: &short[..] });
    assert_eq!(uneven.len(), 8, "the shortest column's length");
}

/// Patches whose factors are at, below and above the smallest one that needs a picture frame.
fn picture_frames() {
    let near_one = [0x3F80_0000, 0x3F80_003F, 0x3F80_0040, 0x3F80_0041].map(f32::from_bits);
    for domain in [Domain::Triangle, Domain::Quad] {
        let patch =
            |n: usize| PatchFactors::from_fn(domain, |position| near_one[n >> (2 * position) & 3]);
        let patches = Patches::new((0..1 << (2 * domain.factors())).map(patch).collect());
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        check(config, domain, &patches);
    }
}

/// Single stages compared with the core's.
#[cfg(feature = "taps")]
mod taps {
    use tess_core::fixed_point::ONE;
    use tess_core::{FixedFactor, Parity, Partitioning, SplitOrder};
    use tess_simd::{Level, contexts, fixed_factors, locations};
    use tess_verify::{Backend, CoreBackend};

    pub(super) fn every_tap() {
        levels_that_are_missing();
        factors();
        factor_contexts_and_locations();
    }

    fn levels_that_are_missing() {
        for level in Level::ALL {
            let answers = [
                fixed_factors(level, Partitioning::Integer, &[2.0]).is_ok(),
                contexts(level, SplitOrder::Ruler, Parity::Even, &[FixedFactor::ONE]).is_ok(),
                locations(level, &[]).is_ok(),
            ];
            assert_eq!(answers, [level.is_available(); 3], "{level}");
        }
    }

    fn factors() {
        let near = |integer: u8| {
            let centre = f32::from(integer).to_bits();
            (centre.saturating_sub(200)..centre + 200).map(f32::from_bits)
        };
        let spread = (0..=u32::MAX).step_by(65_521).map(f32::from_bits);
        let values: Vec<f32> = (0..=66).flat_map(near).chain(spread).collect();
        for partitioning in Partitioning::ALL {
            let observed =
                fixed_factors(Level::Baseline, partitioning, &values).expect("available");
            let expected = CoreBackend.fixed_factors(partitioning, &values).expect("the core");
            let different = observed.iter().zip(&expected).position(|(a, b)| a != b);
            assert_eq!(different.map(|at| values[at].to_bits()), None, "{partitioning:?}");
            assert_eq!(observed.len(), expected.len(), "every value");
        }
    }

    fn factor_contexts_and_locations() {
        let pairs = |split| [Parity::Even, Parity::Odd].map(|parity| (split, parity));
        for (split, parity) in SplitOrder::ALL.into_iter().flat_map(pairs) {
            let out_of_range = [0, 1, ONE - 1, 64 * ONE + 1, 65 * ONE, FixedFactor::MAX.to_bits()];
            let factors: Vec<FixedFactor> = (ONE..=64 * ONE)
                .filter(|bits| bits % 997 == 0 || (bits + 3) & 0xFFFF < 6)
                .chain(out_of_range)
                .map(FixedFactor::from_bits)
                .collect();
            let observed = contexts(Level::Baseline, split, parity, &factors).expect("available");
            let expected = CoreBackend.contexts(split, parity, &factors).expect("the core");
            assert_eq!(observed, expected, "contexts {split:?} {parity:?}");
            let observed = locations(Level::Baseline, &expected).expect("available");
            let expected = CoreBackend.locations(&expected).expect("the core");
            assert!(observed == expected, "locations {split:?} {parity:?}");
        }
    }
}

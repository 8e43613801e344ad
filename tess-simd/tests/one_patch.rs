//! One patch a call: the core's bits and the batches' errors, at every level, whatever came before.

#[path = "common/levels.rs"]
mod levels;
#[path = "common/patches.rs"]
mod patches;

use allocation_counter::measure;
use levels::levels;
use patches::{Bits, Patches, compare as batches, configs, patch};
use tess_core::{
    Config, Counts, Domain, DomainPoint, IsolineFactors, MAX_INDICES, OutputPrimitive,
    Partitioning, Patch, PatchFactors, QuadFactors, SplitOrder, Tessellation, TriangleFactors,
};
use tess_simd::{
    Batch, Buffer, Buffers, Error, IndexFormat, Level, Numbering, Order, OutputPoint, Tessellator,
};
use tess_verify::generate::{GenLevel, Selection, SplitMix64};

/// Points and indices that no patch has.
const FIXED: DomainPoint = DomainPoint::from_bits(u32::MAX, u32::MAX);
const FLOAT: [f32; 2] = [-1.0; 2];

/// Makes a patch in one of the ways there are and says how it differs from the core's.
fn difference<P: OutputPoint + Bits, I: IndexFormat + Bits>(
    tessellator: &mut Tessellator,
    factors: PatchFactors,
    expected: &Tessellation,
    (way, room): (u32, usize),
    (poison, point): (P, impl Fn(DomainPoint) -> P),
) -> Option<String> {
    let counts = Patch::new(tessellator.config(), factors).counts();
    let (points, indices) = (counts.points as usize, counts.indices as usize);
    let mut all_points = vec![poison; points + room];
    let mut all_indices = vec![I::wrapping_from(u32::MAX); indices + room];
    let (to_points, to_indices) = (&mut all_points[..], &mut all_indices[..]);
    let found = match way {
        0 => Some(tessellator.count_patch(factors).counts()),
        1 => tessellator.patch(factors, to_points, to_indices).ok(),
        _ => {
            let patches = [factors];
            let (batch, numbering) = (Batch::Patches(&patches), Numbering::PerPatch);
            let buffers = Buffers::new(to_points, to_indices);
            tessellator.write(batch, numbering, buffers).ok().map(|_| counts)
        }
    };
    if found != Some(counts) {
        return Some(format!("{found:?} instead of {counts:?}"));
    }
    let same = all_points.iter().zip(&expected.points).all(|(a, &b)| a.bits() == point(b).bits())
        && all_indices.iter().zip(&expected.indices).all(|(a, &b)| a.bits() == [b, 0]);
    (way > 0 && !same).then(|| String::from("points or indices differ"))
}

/// Makes patches of one configuration one after another, each in a way of its own.
fn compare(level: Level, config: Config, order: Order, all: &[(PatchFactors, Tessellation)]) {
    let tessellator = Tessellator::with_level(config, level);
    let mut tessellator = tessellator.unwrap_or_else(|error| panic!("{error}")).order(order);
    let mut random = SplitMix64::new(7);
    for &(factors, ref expected) in all {
        let (t, way) = (&mut tessellator, (random.below(3), 100 * random.below(2) as usize));
        let difference = if random.below(2) == 0 {
            let float = (FLOAT, DomainPoint::to_f32);
            difference::<_, u16>(t, factors, expected, way, float)
        } else {
            difference::<_, u32>(t, factors, expected, way, (FIXED, |point| point))
        };
        if let Some(difference) = difference {
            panic!("{level} {config:?} {order:?} {factors:?} {way:?}: {difference}");
        }
    }
}

/// Level 1 of the kit and random patches, domains mixed, in an order that makes neighbours unlike.
#[test]
fn one_patch_a_call_is_the_core() {
    let cases: Vec<_> = Selection::level(GenLevel::One, 1).cases().collect();
    for (seed, config) in (0..).zip(configs()) {
        let own = cases.iter().filter(|case| case.config == config).map(|case| case.factors);
        let mut all: Vec<_> = own.collect();
        let mut random = SplitMix64::new(seed);
        all.extend((0..60).map(|i| patch(&mut random, Domain::ALL[i % 3])));
        for i in (1..all.len()).rev() {
            all.swap(i, random.below(u32::try_from(i).expect("few cases")) as usize);
        }
        all.extend_from_within(..all.len() / 2);
        for order in [Order::Specification, Order::VertexCache] {
            let expected = |f| (f, Patch::new(config, f).tessellate_in(order));
            let all: Vec<_> = all.iter().copied().map(expected).collect();
            levels().into_iter().for_each(|level| compare(level, config, order, &all));
        }
    }
}

/// Batches of a few patches, which go the way of single ones, after each other and after larger ones.
#[test]
fn a_few_patches() {
    let configs: Vec<_> = configs().filter(|config| config.split == SplitOrder::Ruler).collect();
    for (config, level) in
        configs.into_iter().flat_map(|c| levels().into_iter().map(move |l| (c, l)))
    {
        let tessellator = Tessellator::with_level(config, level);
        let mut tessellator = tessellator.unwrap_or_else(|error| panic!("{error}"));
        for (seed, patches) in (0..).zip([1, 4, 20, 2, 5, 3, 1, 6, 4]) {
            for domain in Domain::ALL {
                let all = Patches::random(seed, domain, patches);
                let expected = all.expected(config);
                let numbering = Numbering::PerBatch { base_vertex: 7 };
                for batch in [all.structures(domain), all.columns(domain), Batch::from(&all.all)] {
                    let same = |point| point;
                    let t = &mut tessellator;
                    batches::<DomainPoint, u32>(t, (&all, batch), &expected, numbering, same);
                }
            }
        }
    }
}

/// Patches that differ from the one before in one bit of one factor or in their domain alone, some patches twice.
fn nearly_the_same() -> Vec<PatchFactors> {
    let quad = [3.0f32, 4.5, 5.0, 6.0, 4.0, 7.0];
    let mut all = Vec::new();
    for factor in 0..quad.len() {
        let mut changed = quad;
        changed[factor] = f32::from_bits(quad[factor].to_bits() + (1 << 12));
        all.extend(
            [quad, quad, changed].map(|factors| PatchFactors::from(QuadFactors::from(factors))),
        );
    }
    let triangle: PatchFactors = TriangleFactors::from([3.0, 2.0, 4.0, 5.0]).into();
    let line: PatchFactors = IsolineFactors::from([3.0, 2.0]).into();
    all.extend([triangle, QuadFactors::from([3.0, 2.0, 4.0, 5.0, 0.0, 0.0]).into(), triangle]);
    all.extend([line, TriangleFactors::from([3.0, 2.0, 0.0, 0.0]).into(), line, line]);
    all
}

/// A patch is not taken for the one before it, nor a batch that came between for either.
#[test]
fn neighbours_that_are_nearly_the_same() {
    for (config, level) in configs().flat_map(|c| levels().into_iter().map(move |l| (c, l))) {
        let expected = |f| (f, Patch::new(config, f).tessellate());
        let all: Vec<_> = nearly_the_same().into_iter().map(expected).collect();
        compare(level, config, Order::Specification, &all);

        let tessellator = Tessellator::with_level(config, level);
        let mut tessellator = tessellator.unwrap_or_else(|error| panic!("{error}"));
        let between = Patches::random(3, Domain::Quad, 40);
        let batch_expected = between.expected(config);
        for &(factors, ref expected) in &all {
            let (t, numbering, same) = (&mut tessellator, Numbering::PerPatch, |point| point);
            let found = difference::<_, u32>(t, factors, expected, (1, 100), (FIXED, same));
            assert_eq!(found, None, "{level} {config:?} {factors:?}");
            let batch = between.structures(Domain::Quad);
            batches::<DomainPoint, u32>(t, (&between, batch), &batch_expected, numbering, same);
            let found = difference::<_, u32>(t, factors, expected, (1, 0), (FIXED, same));
            assert_eq!(found, None, "{level} {config:?} {factors:?}, after a batch");
        }
    }
}

/// Errors are those of a batch of one, and nothing is written.
#[test]
fn buffers_that_are_too_small() {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let mut tessellator = Tessellator::new(config);
    let factors = TriangleFactors::uniform(4.5);
    let Counts { points, indices, .. } = tessellator.count_patch(factors).counts();
    for (buffer, lacks) in [(Buffer::Points, [1, 0]), (Buffer::Indices, [0, 1])] {
        let (points, indices) = (points as usize - lacks[0], indices as usize - lacks[1]);
        let (mut to_points, mut to_indices) = (vec![FIXED; points], vec![u16::MAX; indices]);
        let error = tessellator.patch(factors, &mut to_points, &mut to_indices);
        let got = if buffer == Buffer::Points { points } else { indices };
        assert_eq!(error, Err(Error::BufferTooSmall { buffer, needed: got + 1, got }), "one less");
        let batch = [factors];
        let buffers = Buffers::new(&mut to_points, &mut to_indices);
        let of_batch = tessellator.write(&batch, Numbering::PerPatch, buffers);
        assert_eq!(error.err(), of_batch.err(), "{buffer:?}");
        assert!(to_points.iter().all(|&point| point == FIXED), "{buffer:?}: points are written");
        assert!(to_indices.iter().all(|&index| index == u16::MAX), "{buffer:?}: indices are");
    }
}

/// A second tessellator of a configuration has its tables; a small patch takes little memory, and one that was
/// seen none.
#[test]
fn memory() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    drop(Tessellator::new(config));
    let mut made = None;
    let allocated = measure(|| made = Some(Tessellator::new(config)));
    let mut tessellator = made.expect("made");
    if cfg!(feature = "std") {
        let bytes = allocated.bytes_max + size_of::<Tessellator>() as u64;
        assert!(bytes <= 4096, "{bytes} bytes for a tessellator");
    }
    let (mut points, mut indices) = ([FLOAT; 100], vec![0u32; MAX_INDICES]);
    let mut once = || {
        for factor in [1.0, 2.0, 7.0] {
            let factors = QuadFactors::uniform(factor);
            let written = tessellator.patch(factors, &mut points, &mut indices);
            assert!(written.is_ok(), "{written:?}");
        }
    };
    let first = measure(&mut once).bytes_max;
    assert!(first <= 32 << 10, "{first} bytes for the first patches");
    assert_eq!(measure(once).count_total, 0, "allocations");
    let (memory, first) = (tessellator.memory(), usize::try_from(first).expect("few"));
    let tables = if cfg!(feature = "std") { 0 } else { 1 << 20 };
    assert!((first / 2..=first + 2048 + tables).contains(&memory), "{memory} bytes, {first}");
}

//! Buffers and batches: what does not fit is an error, what is not needed is not touched, and nothing is allocated
//! once a tessellator is warm.

use allocation_counter::measure;
use tess_core::{
    Config, Domain, OutputPrimitive, Partitioning, PatchFactors, QuadFactors, TriangleFactors,
};
use tess_simd::{
    Batch, BatchCounts, Buffers, Error, Level, LevelUnavailable, Numbering, Output, OwnedBatch,
    PatchRange, Tessellator,
};

const CONFIG: Config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
const POISON: u32 = 0xDEAD_BEEF;

fn quad(f: f32) -> QuadFactors {
    QuadFactors { u0: f, v0: 1.0, u1: f, v1: 3.0, inside_u: 2.0, inside_v: f }
}

/// Buffers of these sizes, poisoned.
fn poisoned(
    points: usize,
    indices: usize,
    ranges: usize,
) -> (Vec<[f32; 2]>, Vec<u32>, Vec<PatchRange>) {
    let range =
        PatchRange { first_point: POISON, points: POISON, first_index: POISON, indices: POISON };
    (vec![[f32::from_bits(POISON); 2]; points], vec![POISON; indices], vec![range; ranges])
}

/// Blocks may reach past a run, never past the output: at every level and for every length.
#[test]
fn what_lies_behind_the_output_stays() {
    for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
        let mut tessellator = Tessellator::with_level(CONFIG, level).expect("available");
        for step in 0..120u8 {
            let patches = [quad(2.0), quad(1.0 + f32::from(step) / 2.0)];
            let counts = tessellator.count(&patches).expect("a small batch").counts();
            let (mut p, mut i, mut r) = poisoned(counts.points + 40, counts.indices + 40, 3);
            let buffers = Buffers::new(&mut p, &mut i).with_ranges(&mut r);
            let result = tessellator.write(&patches[..], Numbering::PerPatch, buffers);
            assert_eq!(result, Ok(counts), "step {step}");
            let behind = p[counts.points..].iter().flatten();
            assert!(behind.clone().all(|x| x.to_bits() == POISON), "points, step {step} {level}");
            assert!(i[counts.indices..].iter().all(|&x| x == POISON), "indices, step {step}");
            assert_eq!(r[2].points, POISON, "ranges, step {step}");
            assert!(p[..counts.points].iter().flatten().all(|x| x.to_bits() != POISON), "all");
            assert!(i[..counts.indices].iter().all(|&x| x != POISON), "all indices written");
        }
    }
}

#[test]
fn indices_that_do_not_fit() {
    let mut tessellator = Tessellator::new(CONFIG);
    let mut output = Output::<[f32; 2], u16>::new();
    let patches = [quad(63.0); 20];
    let counts = tessellator.count(&patches).expect("a small batch").counts();
    let base = |spare: usize| {
        let base_vertex = u32::try_from(65536 - counts.points + spare).expect("small");
        Numbering::PerBatch { base_vertex }
    };
    assert_eq!(tessellator.tessellate(&patches[..], base(0), &mut output), Ok(counts), "just fits");
    assert_eq!(output.indices().iter().max(), Some(&65535), "the largest index");
    let before = output.clone();
    let error = Error::IndexTooLarge { largest: 65536, format: 65535 };
    let result = tessellator.tessellate(&patches[..], base(1), &mut output);
    assert_eq!(result, Err(error), "one too many");
    assert_eq!(before.indices(), output.indices(), "the output stays");
    let mut wide = Output::<[f32; 2], u32>::new();
    let numbering = Numbering::PerBatch { base_vertex: u32::MAX };
    let result = tessellator.tessellate(&patches[..], numbering, &mut wide);
    assert!(matches!(result, Err(Error::IndexTooLarge { .. })), "beyond 32 bits: {result:?}");
}

/// A batch without points has no largest index, whatever its numbering begins with.
#[test]
fn no_points_fit_any_numbering() {
    let mut output = Output::<[f32; 2], u16>::new();
    let numbering = Numbering::PerBatch { base_vertex: u32::MAX };
    let result = Tessellator::new(CONFIG).tessellate(&[quad(0.0)][..], numbering, &mut output);
    assert_eq!(result, Ok(BatchCounts { patches: 1, points: 0, indices: 0 }));
}

/// The largest batch has 2^32 - 1 indices.
#[test]
fn batches_of_2_pow_32_indices_are_too_large() {
    let all = |f: f32| TriangleFactors { u0: f, v0: f, w0: f, inside: f };
    // 18432 indices each, and 3.
    let mut patches = vec![all(64.0); 233_016];
    patches.resize(233_016 + 5461, all(1.0));
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let mut tessellator = Tessellator::new(config);
    let counts = tessellator.count(&patches).expect("just countable").counts();
    assert_eq!(counts.indices, 0xFFFF_FFFF, "indices");
    patches.push(all(1.0));
    let points = counts.points as u64 + 3;
    let error = Error::BatchTooLarge { points, indices: 0x1_0000_0002 };
    let result = tessellator.count(&patches).map(|counted| counted.counts());
    assert_eq!(result, Err(error), "one triangle more");
}

/// What is wrong with a batch.
fn refused(batch: Batch<'_>) -> Option<Error> {
    Tessellator::new(CONFIG).count(batch).err()
}

#[test]
fn uneven_columns() {
    let (long, short) = ([2.0; 9], [2.0; 8]);
    let columns =
        TriangleFactors { u0: &long[..], v0: &long[..], w0: &short[..], inside: &long[..] };
    assert_eq!(refused(columns.into()), Some(Error::UnevenColumns { lengths: [8, 9] }));
}

#[test]
fn patches_of_several_domains() {
    let (found, expected) = (Domain::Triangle, Domain::Quad);
    for count in [1, 70, 300] {
        let mut patches = vec![PatchFactors::Quad(quad(3.0)); count];
        assert_eq!(refused((&patches).into()), None, "{count} quads");
        patches.push(PatchFactors::uniform(found, 2.0));
        let error = Error::MixedDomains { patch: count, found, expected };
        assert_eq!(refused((&patches).into()), Some(error), "and a triangle");
    }
}

#[test]
fn owned_batches_have_one_domain() {
    let (found, expected) = (Domain::Triangle, Domain::Isoline);
    for domain in Domain::ALL {
        let patches = [1.0, 2.0, 3.0].map(|factor| PatchFactors::uniform(domain, factor));
        let columns: Vec<_> = (0..domain.factors()).map(|_| [1.0, 2.0, 3.0]).collect();
        let columns = Batch::from(PatchFactors::from_fn(domain, |i| &columns[i][..]));
        let owned = OwnedBatch::try_from(columns).expect("one domain");
        assert_eq!(OwnedBatch::try_from(&patches[..]), Ok(owned.clone()), "patch by patch");
        let size = (owned.batch().len(), owned.batch().domain());
        assert_eq!(size, (3, domain), "all of them");
        assert_eq!(owned.get(1..3).map(|part| part.len()), Some(2), "a part of them");
        assert!(owned.get(1..4).is_none(), "more than there are");
    }
    let mut owned = OwnedBatch::new(expected);
    assert_eq!(owned.push(PatchFactors::uniform(expected, 2.0)), Ok(()), "an isoline");
    let error = Error::MixedDomains { patch: 1, found, expected };
    assert_eq!(owned.push(PatchFactors::uniform(found, 2.0)), Err(error), "a triangle");
    assert_eq!(owned.batch().len(), 1, "the isoline alone");
    let mixed = [PatchFactors::uniform(expected, 1.0), PatchFactors::uniform(found, 1.0)];
    assert_eq!(OwnedBatch::try_from(&mixed[..]), Err(error), "both");
    let uneven = PatchFactors::from_fn(expected, |i| &[1.0, 2.0][..=i]);
    let error = Error::UnevenColumns { lengths: [1, 2] };
    assert_eq!(OwnedBatch::try_from(Batch::from(uneven)), Err(error), "uneven columns");
}

#[test]
fn levels_that_this_machine_lacks_are_errors() {
    for level in Level::ALL {
        let made = Tessellator::with_level(CONFIG, level).map(|made| made.level());
        let expected = if level.is_available() { Ok(level) } else { Err(LevelUnavailable(level)) };
        assert_eq!(made, expected, "{level}");
    }
}

/// What the machine is asked for, in one list.
#[cfg(target_arch = "x86_64")]
#[test]
fn the_machine_is_asked_for_every_instruction() {
    use std::is_x86_feature_detected as has;
    let avx2 = [has!("avx2"), has!("bmi1"), has!("bmi2"), has!("lzcnt"), has!("popcnt")];
    let avx512 = [
        [has!("avx512f"), has!("avx512bw"), has!("avx512cd"), has!("avx512dq"), has!("avx512vl")],
        [has!("avx512bitalg"), has!("avx512ifma"), has!("avx512vbmi"), has!("gfni"), has!("vaes")],
    ];
    let others =
        [has!("avx512vbmi2"), has!("avx512vnni"), has!("avx512vpopcntdq"), has!("vpclmulqdq")];
    let has_avx2 = avx2 == [true; 5];
    let has_avx512 = has_avx2 && avx512 == [[true; 5]; 2] && others == [true; 4];
    let available = [Level::Avx2, Level::Avx512].map(Level::is_available);
    assert_eq!(available, [has_avx2, has_avx512], "{avx2:?} {avx512:?} {others:?}");
}

#[test]
fn a_warm_tessellator_allocates_nothing() {
    let small: Vec<_> = (0..250u16).map(|i| quad(f32::from(i % 40) / 4.0)).collect();
    let large: Vec<_> = (0..300u16).map(|i| quad(f32::from(i) / 4.0)).collect();
    let mut tessellator = Tessellator::new(CONFIG);
    let mut output = Output::<[f32; 2], u32>::new();
    let mut run = |patches: &[QuadFactors]| {
        measure(|| {
            let result = tessellator.tessellate(patches, Numbering::PerPatch, &mut output);
            assert!(result.is_ok(), "{result:?}");
        })
        .count_total
    };
    assert!(run(&large) > 0, "the output grows, and the counter sees it");
    assert_eq!(run(&large), 0, "warm");
    assert_eq!(run(&small), 0, "a smaller batch");
    assert_eq!(run(&[]), 0, "an empty batch");
}

/// All memory at once: no patch and no batch allocates, whatever comes, and there is not more in the end.
#[test]
fn a_reserved_tessellator_allocates_nothing() {
    for partitioning in Partitioning::ALL {
        let mut tessellator = Tessellator::new(Config { partitioning, ..CONFIG });
        tessellator.reserve();
        let memory = tessellator.memory();
        assert!((1 << 20..1_200_000).contains(&memory), "{memory} bytes");
        let mut output = Output::<[f32; 2], u32>::new();
        let largest = Tessellator::new(CONFIG).tessellate(
            &[QuadFactors::uniform(64.0); 300],
            Numbering::PerPatch,
            &mut output,
        );
        assert!(largest.is_ok(), "{largest:?}");
        let (mut points, mut indices) = (vec![[0.0_f32; 2]; 5000], vec![0u16; 25_000]);
        let patch = |i: u16| QuadFactors {
            u0: f32::from(i % 7 + 1),
            v1: f32::from(i % 5 + 1),
            ..quad(f32::from(i % 250) / 4.0 + 1.0)
        };
        let all: Vec<_> = (0..6000).map(patch).collect();
        let allocated = measure(|| {
            for few in all.chunks(300) {
                let result = tessellator.tessellate(few, Numbering::PerPatch, &mut output);
                assert!(result.is_ok(), "{result:?}");
            }
            for &patch in &all {
                let result = tessellator.patch(patch, &mut points, &mut indices);
                assert!(result.is_ok(), "{result:?}");
            }
        });
        assert_eq!(allocated.count_total, 0, "{partitioning:?}: allocations");
        assert_eq!(tessellator.memory(), memory, "{partitioning:?}: memory");
    }
}

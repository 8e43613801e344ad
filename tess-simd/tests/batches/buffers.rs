//! Memory of tessellators, owned batches, the largest batch, and levels. `sequences.rs` tests
//! buffers of every size and refused batches.

use allocation_counter::measure;
use tess_core::{
    Config, Domain, MAX_INDICES, OutputPrimitive, Partitioning, PatchFactors, QuadFactors,
    TriangleFactors,
};
use tess_simd::{
    Batch, Error, Level, LevelUnavailableError, Numbering, Output, OwnedBatch, Tessellator,
};

const CONFIG: Config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
fn quad(f: f32) -> QuadFactors {
    QuadFactors { u0: f, v0: 1.0, u1: f, v1: 3.0, inside_u: 2.0, inside_v: f }
}

/// The largest batch has 2^32 - 1 indices.
#[test]
fn batches_of_2_pow_32_indices_are_too_large() {
    let all = |f: f32| TriangleFactors { u0: f, v0: f, w0: f, inside: f };
    // 18432 indices each, and 3 more.
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
        let expected =
            if level.is_available() { Ok(level) } else { Err(LevelUnavailableError(level)) };
        assert_eq!(made, expected, "{level}");
    }
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

/// After all memory is reserved, no patch and no batch allocates, and the memory does not grow.
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

/// A second tessellator of a configuration shares its tables; a small patch takes little memory,
/// and a patch that was seen before takes none.
#[test]
fn small_patches_take_little_memory() {
    let config = Config { partitioning: Partitioning::Integer, ..CONFIG };
    drop(Tessellator::new(config));
    let mut made = None;
    let allocated = measure(|| made = Some(Tessellator::new(config)));
    let mut tessellator = made.expect("made");
    if cfg!(feature = "std") {
        let bytes = allocated.bytes_max + size_of::<Tessellator>() as u64;
        assert!(bytes <= 4096, "{bytes} bytes for a tessellator");
    }
    let (mut points, mut indices) = ([[0.0_f32; 2]; 100], vec![0_u32; MAX_INDICES]);
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

//! Points in two arrays: those of the pairs, which other tests compare with the core, at every level.

#[path = "common/levels.rs"]
mod levels;
#[expect(dead_code, reason = "the expected points are pairs here")]
#[path = "common/patches.rs"]
mod patches;

use levels::levels;
use patches::{Patches, configs};
use tess_core::{Domain, PatchFactors};
use tess_simd::{
    ApartBuffers, Buffer, CountedPatch, Error, IndexFormat, Numbering, Output, PatchRange,
    Tessellator,
};

/// A coordinate that no point has.
const NONE: f32 = -1.0;

/// Patches of all sizes, in runs too, and at the end of the buffers one of each.
fn patches(seed: u64, domain: Domain) -> Vec<PatchFactors> {
    let different = Patches::random(seed, domain, 120).all;
    let runs = different.iter().take(9).enumerate();
    let runs = runs.flat_map(|(length, &patch)| std::iter::repeat_n(patch, 2 * length));
    let uniform = [64.0, 17.5, 8.0, 3.0, 1.0].map(|factor| PatchFactors::uniform(domain, factor));
    runs.chain(different.iter().copied()).chain(uniform).collect()
}

fn bits(u: &[f32], v: &[f32]) -> Vec<[u32; 2]> {
    assert_eq!(u.len(), v.len(), "as many u as v");
    u.iter().zip(v).map(|(u, v)| [u.to_bits(), v.to_bits()]).collect()
}

fn bits_of_pairs(pairs: &[[f32; 2]]) -> Vec<[u32; 2]> {
    pairs.iter().map(|pair| pair.map(f32::to_bits)).collect()
}

/// Compares a batch in buffers of exactly its sizes, and in larger ones, which it must not touch.
fn compare<I: IndexFormat + PartialEq + std::fmt::Debug>(
    tessellator: &mut Tessellator,
    patches: &[PatchFactors],
    numbering: Numbering,
) {
    let mut pairs = Output::<[f32; 2], I>::new();
    tessellator.tessellate(patches, numbering, &mut pairs).expect("it fits");
    let expected = bits_of_pairs(pairs.points());
    for room in [0, 70] {
        let [mut u, mut v] = [(); 2].map(|()| vec![NONE; expected.len() + room]);
        let mut indices = vec![I::default(); pairs.indices().len()];
        let mut ranges = vec![PatchRange::default(); patches.len()];
        let buffers = ApartBuffers::new(&mut u, &mut v, &mut indices).with_ranges(&mut ranges);
        let mut counted = tessellator.count(patches).expect("it fits");
        counted.write_apart(numbering, buffers).expect("there is room");
        assert_eq!(bits(&u[..expected.len()], &v[..expected.len()]), expected, "points");
        assert!(u[expected.len()..].iter().chain(&v[expected.len()..]).all(|&x| x == NONE), "room");
        assert_eq!(indices, pairs.indices(), "indices");
        assert_eq!(ranges, pairs.ranges(), "ranges");
    }
}

#[test]
fn batches_are_those_in_pairs() {
    for level in levels() {
        for (seed, config) in (900..).zip(configs()) {
            let mut tessellator = Tessellator::with_level(config, level).expect("available");
            for domain in Domain::ALL {
                let patches = patches(seed, domain);
                compare::<u32>(&mut tessellator, &patches, Numbering::PerBatch { base_vertex: 7 });
                compare::<u16>(&mut tessellator, &patches, Numbering::PerPatch);
            }
        }
    }
}

/// Each thread has its own part of both arrays.
#[cfg(feature = "rayon")]
#[test]
fn threads_write_what_one_writes() {
    for (seed, config) in (990..).zip(configs()).step_by(5) {
        let mut tessellator = Tessellator::new(config).threads(4);
        for domain in Domain::ALL {
            // Some megabytes, so that all threads have work.
            let patches = patches(seed, domain).repeat(8);
            compare::<u32>(&mut tessellator, &patches, Numbering::PerBatch { base_vertex: 7 });
        }
    }
}

/// Patch by patch, in arrays of all lengths between the patch's and what it may overwrite.
#[test]
fn patches_are_those_in_pairs() {
    for level in levels() {
        for (seed, config) in (950..).zip(configs()) {
            let mut tessellator = Tessellator::with_level(config, level).expect("available");
            for domain in Domain::ALL {
                for (number, patch) in patches(seed, domain).into_iter().enumerate() {
                    let mut counted = tessellator.count_patch(patch);
                    let counts = counted.counts();
                    let (points, indices) = (counts.points as usize, counts.indices as usize);
                    let mut pairs = vec![[NONE; 2]; points];
                    let mut expected = vec![0_u16; indices];
                    counted.write(&mut pairs, &mut expected).expect("there is room");
                    let room = number % (CountedPatch::OVERRUN + 5);
                    let [mut u, mut v] = [(); 2].map(|()| vec![NONE; points + room]);
                    let mut indices = vec![0_u16; indices];
                    counted.write_apart(&mut u, &mut v, &mut indices).expect("there is room");
                    assert_eq!(
                        bits(&u[..points], &v[..points]),
                        bits_of_pairs(&pairs),
                        "{patch:?}"
                    );
                    assert_eq!(indices, expected, "{patch:?}");
                }
            }
        }
    }
}

/// Nothing is written if either array is too small.
#[test]
fn small_arrays_are_refused() {
    let config = configs().next().expect("there are some");
    let mut tessellator = Tessellator::new(config);
    let patch = [PatchFactors::uniform(Domain::Quad, 2.0)];
    for (u, v) in [(8, 9), (9, 8)] {
        let [mut u, mut v] = [u, v].map(|length| vec![NONE; length]);
        let mut indices = vec![0_u32; 24];
        let refused = Error::BufferTooSmall { buffer: Buffer::Points, needed: 9, got: 8 };
        let mut counted = tessellator.count_patch(patch[0]);
        assert_eq!(counted.write_apart(&mut u, &mut v, &mut indices), Err(refused), "one");
        let mut counted = tessellator.count(&patch).expect("it fits");
        let buffers = ApartBuffers::new(&mut u, &mut v, &mut indices);
        assert_eq!(counted.write_apart(Numbering::PerPatch, buffers), Err(refused), "a batch");
        assert!(u.iter().chain(&v).all(|&x| x == NONE), "nothing is written");
    }
}

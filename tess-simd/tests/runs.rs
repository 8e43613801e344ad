//! Runs of equal patches, whose output is repeated instead of computed.

#[path = "common/levels.rs"]
mod levels;
#[path = "common/patches.rs"]
mod patches;

use levels::levels;
use patches::{Patches, compare, configs};
use tess_core::{Domain, DomainPoint, PatchFactors};
use tess_simd::{Numbering, Tessellator};

/// Runs of every length up to 40, every other one of small patches, and one that is longer than what is
/// copied at a time.
fn runs(seed: u64, domain: Domain) -> Patches {
    let small = [1.0, 2.0, 2.5, 3.0, 4.0].map(|factor| PatchFactors::uniform(domain, factor));
    let one = |length: usize, any| if length.is_multiple_of(2) { small[length % 5] } else { any };
    let different = Patches::random(seed, domain, 40).all;
    let of_length = |(length, any)| std::iter::repeat_n(one(length, any), length);
    let mut all: Vec<_> = (1..).zip(different).flat_map(of_length).collect();
    all.extend(std::iter::repeat_n(small[1], 300));
    Patches::new(all)
}

#[test]
fn every_layout_and_numbering() {
    for level in levels() {
        for (seed, config) in (700..).zip(configs()) {
            let mut tessellator = Tessellator::with_level(config, level).expect("available");
            for domain in Domain::ALL {
                let patches = runs(seed, domain);
                let expected = patches.expected(config);
                let batches = [
                    patches.structures(domain),
                    patches.columns(domain),
                    (&patches.all[..]).into(),
                ];
                for (number, batch) in batches.into_iter().enumerate() {
                    let numbering = match number {
                        0 => Numbering::PerBatch { base_vertex: 7 },
                        _ => Numbering::PerPatch,
                    };
                    let with = (&patches, batch);
                    compare::<DomainPoint, u32>(
                        &mut tessellator,
                        with,
                        &expected,
                        numbering,
                        |p| p,
                    );
                }
            }
        }
    }
}

/// NaNs and zeros of different bits are different patches, or culled ones; their output is the same.
#[test]
fn equal_output_of_different_bits() {
    for level in levels() {
        for config in configs() {
            let mut tessellator = Tessellator::with_level(config, level).expect("available");
            let factors = [f32::NAN, -f32::NAN, 0.0, -0.0, 64.0, 65.0, f32::INFINITY];
            let of = |f| std::iter::repeat_n(PatchFactors::uniform(Domain::Quad, f), 11);
            let patches = Patches::new(factors.into_iter().flat_map(of).collect());
            let (expected, batch) = (patches.expected(config), patches.structures(Domain::Quad));
            let with = (&patches, batch);
            compare::<DomainPoint, u32>(
                &mut tessellator,
                with,
                &expected,
                Numbering::PerPatch,
                |p| p,
            );
        }
    }
}

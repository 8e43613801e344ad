//! The front end against the core, value by value: sampled here, over every binary32 and every
//! fixed-point factor in the slow suite (`cargo test --release -p tess-simd --test front_end --
//! --ignored`).

#[path = "common/levels.rs"]
mod levels;

use levels::levels;
use tess_core::{FactorContext, FixedFactor, Parity, Partitioning, SplitOrder};
use tess_simd::{Level, contexts, fixed_factors, locations};
use tess_verify::backend::Backend;
use tess_verify::core_backend::CoreBackend;

/// Values compared at a time.
const BATCH: usize = 1 << 16;

fn compare_factors(level: Level, partitioning: Partitioning, values: &[f32]) {
    let observed = fixed_factors(level, partitioning, values).expect("an available level");
    let expected = CoreBackend.fixed_factors(partitioning, values).expect("the core");
    assert_eq!(observed.len(), expected.len(), "every value");
    for ((value, observed), expected) in values.iter().zip(&observed).zip(&expected) {
        let bits = value.to_bits();
        assert_eq!(observed, expected, "binary32 {bits:#010x} {partitioning:?} {level}");
    }
}

/// Compares the values of every `step`-th bit pattern.
fn compare_values(step: usize) {
    for level in levels() {
        for partitioning in Partitioning::ALL {
            let mut bits = (0..=u32::MAX).step_by(step);
            loop {
                let values: Vec<_> = bits.by_ref().take(BATCH).map(f32::from_bits).collect();
                if values.is_empty() {
                    break;
                }
                compare_factors(level, partitioning, &values);
            }
        }
    }
}

#[test]
fn factors_of_some_values() {
    compare_values(4093);
}

/// Where rounding and clamping change: around every multiple of 2^-17 near integers.
#[test]
fn factors_around_integers() {
    let near = |integer: u8| {
        let centre = f32::from(integer).to_bits();
        (centre.saturating_sub(600)..centre + 600).map(f32::from_bits)
    };
    let values: Vec<_> = (0..=66).flat_map(near).collect();
    for level in levels() {
        for partitioning in Partitioning::ALL {
            compare_factors(level, partitioning, &values);
        }
    }
}

#[test]
#[ignore = "every binary32 at each level: an hour of one core"]
fn factors_of_every_value() {
    compare_values(1);
}

/// Compares contexts and all their locations for every `step`-th fixed-point factor.
fn compare_contexts(step: u32) {
    for level in levels() {
        for (split, parity) in [
            (SplitOrder::Ruler, Parity::Even),
            (SplitOrder::Ruler, Parity::Odd),
            (SplitOrder::Center, Parity::Even),
            (SplitOrder::Center, Parity::Odd),
        ] {
            let last = (64 - parity.odd()) << 16;
            let all: Vec<_> = (1 << 16..=last)
                .filter(|bits| bits % step == 0 || (bits + 40) & 0xFFFF < 80)
                .map(FixedFactor::from_bits)
                .collect();
            for factors in all.chunks(BATCH) {
                compare_contexts_of(level, split, parity, factors);
            }
        }
    }
}

fn compare_contexts_of(level: Level, split: SplitOrder, parity: Parity, factors: &[FixedFactor]) {
    let observed = contexts(level, split, parity, factors).expect("an available level");
    let expected = CoreBackend.contexts(split, parity, factors).expect("the core");
    assert_eq!(observed.len(), expected.len(), "every factor");
    for ((factor, observed), expected) in factors.iter().zip(&observed).zip(&expected) {
        assert_eq!(observed, expected, "{factor:?} {split:?} {level}");
    }
    let observed = locations(level, &expected).expect("an available level");
    let expected_locations = CoreBackend.locations(&expected).expect("the core");
    let different = observed.iter().zip(&expected_locations).position(|(a, b)| a != b);
    assert_eq!(different, None, "a location, {split:?} {parity:?} {level}");
    assert_eq!(observed.len(), expected_locations.len(), "every location");
}

#[test]
fn contexts_and_locations_of_some_factors() {
    compare_contexts(211);
}

#[test]
#[ignore = "every fixed-point factor, 561 million locations at each level: minutes of one core"]
fn contexts_and_locations_of_every_factor() {
    compare_contexts(1);
}

/// The comparison sees one wrong number.
#[test]
fn planted_fault_is_seen() {
    let right =
        FactorContext::new(FixedFactor::from_bits(0x4_8000), Parity::Odd, SplitOrder::Ruler);
    let wrong = FactorContext { fraction: right.fraction ^ 1, ..right };
    let observed = locations(Level::Baseline, &[wrong]).expect("the baseline");
    assert_ne!(observed, CoreBackend.locations(&[right]).expect("the core"), "a wrong fraction");
}

//! Every class of value in every role: fractions in each binade on both sides of each rounding, and
//! values that are not usable levels.

use super::thresholds::{EVEN_MOVES, ODD_MOVES};
use super::{from_fixed, special_factors};
use crate::case::Case;
use tess_core::{Config, Domain, Partitioning, PatchFactors};

/// The levels of the other roles, small enough to keep patches short.
const PLAIN: [f32; 6] = [3.0, 2.5, 4.0, 1.5, 3.5, 5.0];

/// In each binade from 1, an integer whose successor has the other parity.
const WHOLE: [u32; 6] = [1, 2, 5, 10, 21, 42];

/// Each class of value in each role. The other levels are plain; an inner level that is not above 1
/// also comes with outer levels of 1, where it decides whether there is an inside.
pub(super) fn classes(domain: Domain, config: Config, cases: &mut Vec<Case>) {
    let values = [fractions(config.partitioning), unusual()].concat();
    for position in 0..domain.factors() {
        for &value in &values {
            let with = |others: [f32; 6]| {
                let level = |p| if p == position { value } else { others[p] };
                Case { config, factors: PatchFactors::from_fn(domain, level) }
            };
            cases.push(with(PLAIN));
            if position >= domain.outer_factors() && (value.is_nan() || value <= 1.0) {
                cases.push(with([1.0; 6]));
            }
        }
    }
}

/// In each binade: integers and levels beside them, fractions, and fractions of a unit of the
/// conversion to 16 fraction bits.
fn fractions(partitioning: Partitioning) -> Vec<f32> {
    let mut levels = Vec::new();
    for (binade, whole) in WHOLE.into_iter().enumerate() {
        for integer in [whole, whole + 1] {
            levels.extend(beside(integer));
        }
        let moving = match partitioning {
            Partitioning::FractionalEven if binade > 0 => EVEN_MOVES[binade - 1],
            _ => ODD_MOVES[binade],
        };
        levels.extend(units(moving));
    }
    levels.sort_by(f32::total_cmp);
    levels.dedup_by_key(|level| level.to_bits());
    levels
}

/// An integer; the binary32 numbers next to it; it plus and minus 2^-17, which is halfway to the
/// next unit, 2^-16 and 2^-15; and fractions up to the next integer.
fn beside(integer: u32) -> Vec<f32> {
    let exact = from_fixed(integer << 16);
    let next = |bits: u32| f32::from_bits(bits);
    let above = [0x1, 0x2, 0x8, 0x9, 0x3333, 0x8000, 0xB333, 0xFD70, 0xFFFE, 0xFFFF];
    let half_unit =
        |fixed: u32| f32::from_bits(u32::midpoint(exact.to_bits(), from_fixed(fixed).to_bits()));
    let mut levels = vec![exact, next(exact.to_bits() + 1), half_unit((integer << 16) + 1)];
    levels.extend(above.map(|fraction| from_fixed((integer << 16) + fraction)));
    levels.push(next(from_fixed((integer + 1) << 16).to_bits() - 1));
    levels
}

/// Numbers between a multiple of 2^-16 and the next one: on both sides of 0.4, 0.5 and 0.6 of the
/// way, where the conversion has one or two legal results, and 0.2, 0.75 and nearly all of it.
fn units(fixed: u32) -> Vec<f32> {
    let [low, high] = [fixed, fixed + 1].map(|fixed| from_fixed(fixed).to_bits());
    let steps = high - low;
    let part = |tenths: u32| low + steps * tenths / 10;
    let (half, last) = (u32::midpoint(low, high), high - 1);
    let mut levels = vec![low, part(2), part(4), part(4) + 1, half - 1, half, half + 1];
    levels.extend([part(6), part(6) + 1, low + steps * 3 / 4, last, high]);
    levels.into_iter().map(f32::from_bits).collect()
}

/// Zeros, numbers below 0 and up to 1, above 64, infinities and NaN.
fn unusual() -> Vec<f32> {
    let beyond = [0x4280_0000, 0x4280_0001, 0x42C8_0000, 0x4300_0000, 0x4380_0000, 0x7149_F2CA];
    let mut values = special_factors();
    values.extend(beyond.map(f32::from_bits));
    values.extend([0.75, 1e-6]);
    values
}

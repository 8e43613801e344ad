//! The patches of the chained rows of `sweep.csv` and `uniform.csv`, and the values of the
//! exhaustive rows of `factor.csv` and `place.csv`, as `golden/README.md` describes them.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    reason = "factors are given as decimal fractions, computed in binary64 and rounded once"
)]

use tess_core::{Domain, FixedFactor, Parity, Partitioning, PatchFactors};

/// The 64 patches of row `row` (1..=64) of a systematic sweep.
///
/// - Isoline: density `row`, detail 1..=64.
/// - Triangle: inside factor 1..=64, and outer factors that vary with `row`.
/// - Quad: inside factors (`row`, 1..=64), and outer factors that vary with both.
///
/// The factors of fractional triangles and quads are 0.25 and 0.625 below these integers.
#[must_use]
pub(crate) fn sweep(domain: Domain, partitioning: Partitioning, row: u8) -> Vec<PatchFactors> {
    let below = match domain {
        _ if partitioning.has_integer_factors() => 0.0,
        Domain::Isoline => 0.0,
        Domain::Triangle => 0.25,
        Domain::Quad => 0.625,
    };
    let a = u32::from(row);
    let patch = |b: u32| {
        let factors = match domain {
            Domain::Isoline => vec![a, b],
            Domain::Triangle => vec![a, a % 64 + 1, (7 * a) % 64 + 1, b],
            Domain::Quad => vec![b, a % 64 + 1, (5 * b) % 64 + 1, (11 * a) % 64 + 1, a, b],
        };
        let factors: Vec<_> = factors.iter().map(|&x| (f64::from(x) - below) as f32).collect();
        PatchFactors::from_slice(domain, &factors)
    };
    (1..=64).filter_map(patch).collect()
}

/// The patches of row `row` (0..=65), each with all factors equal: i / 100 for i from 100 `row` to
/// 100 `row` + 99. Row 65 has only 65.00.
#[must_use]
pub(crate) fn uniform(domain: Domain, row: u8) -> Vec<PatchFactors> {
    let first = 100 * u32::from(row);
    let count = if row == 65 { 1 } else { 100 };
    let patch = |i: u32| PatchFactors::uniform(domain, (f64::from(i) / 100.0) as f32);
    (first..first + count).map(patch).collect()
}

/// The number of binary32 numbers in a binade.
pub(crate) const BINADE_SIZE: u32 = 1 << 23;

/// Numbers `range` of the binade [2^`exponent`, 2^(`exponent` + 1)), ascending; `exponent` is in
/// -126..=127 and `range` within 0..[`BINADE_SIZE`].
pub(crate) fn binade(exponent: i32, range: std::ops::Range<u32>) -> impl Iterator<Item = f32> {
    let biased = exponent.saturating_add(127).clamp(1, 254).unsigned_abs();
    range.map(move |mantissa| f32::from_bits((biased << 23) | mantissa))
}

/// The fixed-point factors with integer part `bucket`, ascending: all 65536 fractions. The highest
/// factor of a parity, 63 (odd) or 64 (even), has only the fraction 0.
pub(crate) fn bucket(parity: Parity, bucket: u32) -> impl Iterator<Item = FixedFactor> {
    let highest = 64 - parity.odd();
    let fractions = if bucket == highest { 1 } else { 1 << 16 };
    (0..fractions).map(move |fraction| FixedFactor::from_bits((bucket << 16) | fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first patch of row 3: only fractional triangles and quads are below the integers.
    #[test]
    fn sweeps_are_as_described() {
        let first = |domain, partitioning| -> Vec<f32> {
            sweep(domain, partitioning, 3)[0].iter().collect()
        };
        for (domain, integers, below) in [
            (Domain::Isoline, &[3.0, 1.0][..], 0.0),
            (Domain::Triangle, &[3.0, 4.0, 22.0, 1.0], 0.25),
            (Domain::Quad, &[1.0, 4.0, 6.0, 34.0, 3.0, 1.0], 0.625),
        ] {
            let fractional: Vec<f32> = integers.iter().map(|x| x - below).collect();
            assert_eq!(first(domain, Partitioning::Pow2), integers, "{domain:?}");
            assert_eq!(first(domain, Partitioning::Integer), integers, "{domain:?}");
            assert_eq!(first(domain, Partitioning::FractionalOdd), fractional, "{domain:?}");
            assert_eq!(first(domain, Partitioning::FractionalEven), fractional, "{domain:?}");
        }
    }
}

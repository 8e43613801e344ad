//! Factor processing (spec section 3), with the step numbers of that section.
//!
//! A packet has sixteen patches and a row for each factor of its domain. A single patch has eight
//! rows of one element, which fill a short vector.

use crate::data::lanes::{LANES, MAX_FACTORS, at, at_mut, each};
use crate::stages::reciprocal::{MANTISSA, TWO_POW_23};
use tess_core::fixed_point::ONE;
use tess_core::{Domain, Partitioning};

/// The factors of `L` patches as fixed-point numbers, a row for each of `F` factors. Rows without a
/// factor of the domain have unspecified values in range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Processed<const L: usize = LANES, const F: usize = MAX_FACTORS> {
    /// 15.16 factors, in 1..=64.
    pub(crate) fixed: [[u32; L]; F],
    /// 1 if the parity is odd, else 0.
    pub(crate) odd: [[u32; L]; F],
    /// 1 if the patch is not culled, else 0.
    pub(crate) alive: [u32; L],
    /// 1 if the patch is a minimum patch, else 0. Means nothing for a culled patch.
    pub(crate) minimum: [u32; L],
}

/// Processes raw factors. Rows after the domain's factors are zeros. Total: every bit pattern is
/// valid.
#[inline(always)]
pub(crate) fn process<const L: usize, const F: usize>(
    partitioning: Partitioning,
    domain: Domain,
    raw: &[[f32; L]; F],
) -> Processed<L, F> {
    let outer = domain.outer_factors();
    let clamped = clamped(partitioning, outer, raw);
    let (mut fixed, mut odd) = match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => integers(&clamped, outer),
        Partitioning::FractionalOdd => (each(&clamped, to_fixed), [[1; L]; F]),
        Partitioning::FractionalEven => (each(&clamped, to_fixed), [[0; L]; F]),
    };
    let mut minimum = all(&fixed[..domain.factors()], |factor| factor == ONE);
    if domain == Domain::Isoline {
        // The density is an integer under every partitioning.
        for lane in 0..L {
            let density = ceil(clamp(raw[0][lane], 1.0, 64.0));
            (fixed[0][lane], odd[0][lane]) = (density << 16, density & 1);
        }
        minimum = [0; L];
    }
    Processed { fixed, odd, alive: all(&raw[..outer], |factor| is_greater(factor, 0.0)), minimum }
}

/// Steps 2, 4 and 5.
#[inline(always)]
fn clamped<const L: usize, const F: usize>(
    partitioning: Partitioning,
    outer: usize,
    raw: &[[f32; L]; F],
) -> [[f32; L]; F] {
    let (low, high) = partitioning.range();
    let mut inside_low = [low; L];
    if partitioning == Partitioning::FractionalOdd {
        let plain = all(raw, |factor| !is_greater(factor, ONE_PLUS_2_POW_MINUS_17));
        for lane in 0..L {
            inside_low[lane] = if plain[lane] == 1 { low } else { ONE_PLUS_2_POW_MINUS_16 };
        }
    }
    let mut clamped = *raw;
    for i in 0..L * outer {
        *at_mut(&mut clamped, i) = clamp(at(raw, i), low, high);
    }
    for row in &mut clamped[outer..] {
        for lane in 0..L {
            row[lane] = clamp(row[lane], inside_low[lane], high);
        }
    }
    clamped
}

/// Steps 3, 6 and 7 for integer partitionings.
#[inline(always)]
fn integers<const L: usize, const F: usize>(
    clamped: &[[f32; L]; F],
    outer: usize,
) -> ([[u32; L]; F], [[u32; L]; F]) {
    let (mut fixed, mut odd) = ([[0; L]; F], [[0; L]; F]);
    for i in 0..L * F {
        let integer = ceil(at(clamped, i));
        (*at_mut(&mut fixed, i), *at_mut(&mut odd, i)) = (integer << 16, integer & 1);
    }
    for (odd, fixed) in odd[outer..].iter_mut().zip(&fixed[outer..]) {
        for lane in 0..L {
            odd[lane] &= u32::from(fixed[lane] != ONE);
        }
    }
    (fixed, odd)
}

/// For each lane, 1 if `has` is true in every row, else 0.
#[inline(always)]
pub(crate) fn all<T: Copy, const L: usize>(rows: &[[T; L]], has: impl Fn(T) -> bool) -> [u32; L] {
    let mut all = [1; L];
    for row in rows {
        for lane in 0..L {
            all[lane] &= u32::from(has(row[lane]));
        }
    }
    all
}

/// The bit pattern of infinity. As signed integers, patterns of positive NaNs are greater and
/// patterns with a sign bit are negative.
///
/// Factors are compared as integers for the reason given in `tess-core` (`d3d_float`). The integers
/// are signed because every level has instructions for those.
const INFINITY: i32 = f32::INFINITY.to_bits().cast_signed();

/// Whether `x > low`. `low` is not negative.
#[inline(always)]
fn is_greater(x: f32, low: f32) -> bool {
    let bits = x.to_bits().cast_signed();
    (bits > low.to_bits().cast_signed()) & (bits <= INFINITY)
}

/// Steps 2 and 5, for `0.0 <= low <= high`; NaN gives `low`.
#[inline(always)]
pub(crate) fn clamp(x: f32, low: f32, high: f32) -> f32 {
    let [bits, low, high] = [x, low, high].map(|number| number.to_bits().cast_signed());
    let bits = if bits > INFINITY { 0 } else { bits };
    f32::from_bits(bits.max(low).min(high).cast_unsigned())
}

const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
const ONE_PLUS_2_POW_MINUS_16: f32 = f32::from_bits(0x3F80_0080);

/// The ceiling of a number in 0..2^22: the nearest integer, plus one if that is below the number.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "sums below 2^24 round to the nearest integer")]
pub(crate) fn ceil(x: f32) -> u32 {
    let sum = x + TWO_POW_23;
    (sum.to_bits() & MANTISSA) + u32::from(sum - TWO_POW_23 < x)
}

/// A number in 0..=64 in multiples of 2^-16, ties to even.
///
/// The product is exact and at most 2^22, so the sum is in the range where the binary32 numbers are
/// exactly the integers: the addition rounds to the nearest integer, ties to even, and leaves it in
/// the mantissa.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "the rounding of the sum is the conversion's own")]
pub(crate) fn to_fixed(x: f32) -> u32 {
    (x * 65536.0 + TWO_POW_23).to_bits() & MANTISSA
}

#[cfg(test)]
#[expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the same operations in other arithmetic, on numbers in 0..=64"
)]
mod tests {
    use super::*;

    /// Numbers of every sign and exponent, NaNs and infinities included.
    fn any_numbers() -> impl Iterator<Item = f32> {
        let few = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1.0, 64.0];
        (0..=u32::MAX).step_by(65_521).map(f32::from_bits).chain(few)
    }

    /// Every multiple of 2^-18 in 0..=64, and its neighbours.
    fn factors() -> impl Iterator<Item = f32> {
        let multiples = (0..=1u32 << 24).map(|i| f64::from(i) / f64::from(1 << 18));
        multiples.flat_map(|x| [(x as f32).next_down().max(0.0), x as f32, (x as f32).next_up()])
    }

    #[test]
    fn clamping() {
        for x in any_numbers() {
            let expected = if x.is_nan() { 2.0 } else { x.clamp(2.0, 64.0) };
            assert_eq!(clamp(x, 2.0, 64.0).to_bits(), expected.to_bits(), "{x:e}");
        }
    }

    #[test]
    fn ceilings() {
        for x in factors() {
            assert_eq!(ceil(x), x.ceil() as u32, "{x:e}");
        }
    }

    #[test]
    fn conversions() {
        for x in factors().filter(|&x| x <= 64.0) {
            let expected = (f64::from(x) * 65536.0).round_ties_even() as u32;
            assert_eq!(to_fixed(x), expected, "{x:e}");
        }
    }
}

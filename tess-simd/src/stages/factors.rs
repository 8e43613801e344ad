//! Factor processing (spec section 3), with the step numbers of that section.
//!
//! The formulas are over [`Numbers`]: one number of a loop at the levels that are chosen at run
//! time, eight at once at the baseline.
//!
//! A packet has sixteen patches and a row for each factor of its domain. A single patch has eight
//! rows of one element, which fill a short vector.

use crate::data::lanes::{LANES, MAX_FACTORS};
use crate::data::numbers::Numbers;
use crate::stages::reciprocal::{MANTISSA, TWO_POW_23};
use bytemuck::Pod;
use core::array::{from_mut, from_ref};
use core::ops::Range;
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

/// Processes raw factors, `V` at a time. Rows after the domain's factors are zeros. Total: every
/// bit pattern is valid.
#[inline(always)]
pub(crate) fn process<V: Numbers, const L: usize, const F: usize>(
    partitioning: Partitioning,
    domain: Domain,
    raw: &[[f32; L]; F],
) -> Processed<L, F> {
    let outer = domain.outer_factors();
    let clamped = clamped::<V, L, F>(partitioning, outer, raw);
    let (mut fixed, mut odd) = match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => integers::<V, L, F>(&clamped, outer),
        Partitioning::FractionalOdd => (each(&clamped, to_fixed::<V>), [[1; L]; F]),
        Partitioning::FractionalEven => (each(&clamped, to_fixed::<V>), [[0; L]; F]),
    };
    let is_one = |factor: V| !factor.exceeds(integer(ONE));
    let mut minimum = all(&fixed[..domain.factors()], is_one);
    if domain == Domain::Isoline {
        // The density is an integer under every partitioning.
        steps::<V>(0..L, |lane| {
            let density = ceil(clamp(V::load(raw, lane), number(1.0), number(64.0)));
            (density << 16).store(&mut fixed, lane);
            (density & V::splat(1)).store(&mut odd, lane);
        });
        minimum = [0; L];
    }
    let alive = all(&raw[..outer], |factor: V| is_greater(factor, 0.0));
    Processed { fixed, odd, alive, minimum }
}

/// Steps 2, 4 and 5. The results are the bits of floats.
#[inline(always)]
fn clamped<V: Numbers, const L: usize, const F: usize>(
    partitioning: Partitioning,
    outer: usize,
    raw: &[[f32; L]; F],
) -> [[u32; L]; F] {
    let (low, high) = partitioning.range();
    let (low, high) = (number::<V>(low), number(high));
    let mut inside_low = [[0; L]];
    steps::<V>(0..L, |lane| low.store(&mut inside_low, lane));
    if partitioning == Partitioning::FractionalOdd {
        let plain = [all(raw, |factor: V| !is_greater(factor, ONE_PLUS_2_POW_MINUS_17))];
        let more = number::<V>(ONE_PLUS_2_POW_MINUS_16).minus(low);
        steps::<V>(0..L, |lane| {
            // 0 minus 1, or 0 minus 0: a mask.
            let plain = V::splat(0).minus(V::load(&plain, lane));
            number::<V>(ONE_PLUS_2_POW_MINUS_16).minus(plain & more).store(&mut inside_low, lane);
        });
    }
    let mut clamped = [[0; L]; F];
    steps::<V>(0..L * outer, |i| clamp(V::load(raw, i), low, high).store(&mut clamped, i));
    for (clamped, raw) in clamped[outer..].iter_mut().zip(&raw[outer..]) {
        steps::<V>(0..L, |lane| {
            let low = V::load(&inside_low, lane);
            clamp(V::load(from_ref(raw), lane), low, high).store(from_mut(clamped), lane);
        });
    }
    clamped
}

/// Steps 3, 6 and 7 for integer partitionings.
#[inline(always)]
fn integers<V: Numbers, const L: usize, const F: usize>(
    clamped: &[[u32; L]; F],
    outer: usize,
) -> ([[u32; L]; F], [[u32; L]; F]) {
    let (mut fixed, mut odd) = ([[0; L]; F], [[0; L]; F]);
    steps::<V>(0..L * F, |i| {
        let integer = ceil(V::load(clamped, i));
        (integer << 16).store(&mut fixed, i);
        (integer & V::splat(1)).store(&mut odd, i);
    });
    for (odd, fixed) in odd[outer..].iter_mut().zip(&fixed[outer..]) {
        steps::<V>(0..L, |lane| {
            let more_than_one = V::load(from_ref(fixed), lane).exceeds(integer(ONE));
            (V::load(from_ref(odd), lane) & more_than_one).store(from_mut(odd), lane);
        });
    }
    (fixed, odd)
}

/// Calls `step` with every place of the range at which numbers begin.
#[inline(always)]
fn steps<V: Numbers>(range: Range<usize>, mut step: impl FnMut(usize)) {
    let mut i = range.start;
    while i < range.end {
        step(i);
        i += V::COUNT;
    }
}

/// The results of `f` for all numbers.
#[inline(always)]
fn each<V: Numbers, const L: usize, const F: usize>(
    rows: &[[u32; L]; F],
    f: impl Fn(V) -> V,
) -> [[u32; L]; F] {
    let mut made = [[0; L]; F];
    steps::<V>(0..L * F, |i| f(V::load(rows, i)).store(&mut made, i));
    made
}

/// For each lane, 1 if `has` gives all bits for every row, or 0 if it gives none for some.
#[inline(always)]
pub(crate) fn all<V: Numbers, T: Pod, const L: usize>(
    rows: &[[T; L]],
    has: impl Fn(V) -> V,
) -> [u32; L] {
    let mut all = [[1; L]];
    for row in rows {
        steps::<V>(0..L, |lane| {
            (V::load(&all, lane) & has(V::load(from_ref(row), lane))).store(&mut all, lane);
        });
    }
    let [all] = all;
    all
}

/// The bit pattern of infinity. As signed integers, patterns of positive NaNs are greater and
/// patterns with a sign bit are negative.
///
/// Factors are compared as integers for the reason given in `tess-core` (`d3d_float`). The integers
/// are signed because every level has instructions for those.
const INFINITY: f32 = f32::INFINITY;

/// The bits of a float, in each place.
#[inline(always)]
fn number<V: Numbers>(float: f32) -> V {
    integer(float.to_bits())
}

/// An integer, in each place.
#[inline(always)]
fn integer<V: Numbers>(integer: u32) -> V {
    V::splat(integer.cast_signed())
}

/// Whether `x > low`, as all bits or none. `low` is not negative.
#[inline(always)]
pub(crate) fn is_greater<V: Numbers>(x: V, low: f32) -> V {
    x.exceeds(number(low)) & !x.exceeds(number(INFINITY))
}

/// Steps 2 and 5, for `0.0 <= low <= high`; NaN gives `low`.
#[inline(always)]
pub(crate) fn clamp<V: Numbers>(x: V, low: V, high: V) -> V {
    let x = x & !x.exceeds(number(INFINITY));
    x.or_more(low).or_less(high)
}

const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
const MINUS_2_POW_23: f32 = f32::from_bits(0xCB00_0000);
const ONE_PLUS_2_POW_MINUS_16: f32 = f32::from_bits(0x3F80_0080);

/// The ceiling of a number in 0..2^22, as an integer: the nearest integer, plus one if that is
/// below the number. Both are positive floats, whose order is that of their bits.
#[inline(always)]
pub(crate) fn ceil<V: Numbers>(x: V) -> V {
    let sum = x.float_sum(TWO_POW_23);
    let is_below = x.exceeds(sum.float_sum(MINUS_2_POW_23));
    (sum & integer(MANTISSA)).minus(is_below)
}

/// A number in 0..=64 in multiples of 2^-16, ties to even.
///
/// The product is exact and at most 2^22, so the sum is in the range where the binary32 numbers are
/// exactly the integers: the addition rounds to the nearest integer, ties to even, and leaves it in
/// the mantissa.
#[inline(always)]
pub(crate) fn to_fixed<V: Numbers>(x: V) -> V {
    x.float_product(65536.0).float_sum(TWO_POW_23) & integer(MANTISSA)
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
    use wide::i32x8;

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

    /// The results of a formula for one number, and for eight of which it is the last.
    fn of_both(x: f32, one: impl Fn(i32) -> i32, eight: impl Fn(i32x8) -> i32x8) -> [u32; 2] {
        let x = x.to_bits().cast_signed();
        let mut others = [f32::NAN.to_bits().cast_signed(); 8];
        others[7] = x;
        [one(x), eight(others.into()).to_array()[7]].map(i32::cast_unsigned)
    }

    #[test]
    fn clamping() {
        for x in any_numbers() {
            let expected = if x.is_nan() { 2.0 } else { x.clamp(2.0, 64.0) }.to_bits();
            let clamp = of_both(
                x,
                |x| clamp(x, number(2.0), number(64.0)),
                |x| clamp(x, number(2.0), number(64.0)),
            );
            assert_eq!(clamp, [expected; 2], "{x:e}");
        }
    }

    #[test]
    fn ceilings() {
        for x in factors() {
            assert_eq!(of_both(x, ceil, ceil), [x.ceil() as u32; 2], "{x:e}");
        }
    }

    #[test]
    fn conversions() {
        for x in factors().filter(|&x| x <= 64.0) {
            let expected = (f64::from(x) * 65536.0).round_ties_even() as u32;
            assert_eq!(of_both(x, to_fixed, to_fixed), [expected; 2], "{x:e}");
        }
    }
}

//! Factor processing of a packet (spec section 3), steps named as there.

use crate::data::lanes::{Column, LANES, Lanes, MAX_FACTORS};
use crate::stages::reciprocal::{MANTISSA, TWO_POW_23};
use tess_core::fixed_point::ONE;
use tess_core::{Config, Domain, Partitioning};

/// The factors of a packet as fixed-point numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Processed {
    /// 15.16 factors, in 1..=64.
    pub(crate) fixed: Column,
    /// 1 where the parity is odd.
    pub(crate) odd: Column,
    /// 1 where the patch is not culled.
    pub(crate) alive: Lanes,
    /// 1 where the patch is a minimum patch.
    pub(crate) minimum: Lanes,
}

/// Processes the raw factors of a packet. Total: every bit pattern is valid.
#[inline(always)]
pub(crate) fn process(config: Config, domain: Domain, raw: &Column<f32>) -> Processed {
    const fn outer(domain: Domain) -> usize {
        domain.outer_factors() * LANES
    }
    const fn all(domain: Domain) -> usize {
        domain.factors() * LANES
    }
    use Domain::{Isoline, Quad, Triangle};
    let partitioning = config.partitioning;
    let mut processed = match domain {
        Isoline => process_as::<{ outer(Isoline) }, { all(Isoline) }>(partitioning, raw),
        Triangle => process_as::<{ outer(Triangle) }, { all(Triangle) }>(partitioning, raw),
        Quad => process_as::<{ outer(Quad) }, { all(Quad) }>(partitioning, raw),
    };
    if domain == Isoline {
        processed.minimum = [0; LANES];
        for (lane, &density) in raw[..LANES].iter().enumerate() {
            let density = ceil(clamp(density, 1.0, 64.0));
            processed.fixed[lane] = density << 16;
            processed.odd[lane] = density & 1;
        }
    }
    processed
}

/// Processes factors of which the elements below `OUTER` are outer ones and those below `ALL`
/// exist.
#[inline(always)]
fn process_as<const OUTER: usize, const ALL: usize>(
    partitioning: Partitioning,
    raw: &Column<f32>,
) -> Processed {
    let (outer_low, high) = partitioning.range();
    let inside_low = inside_low::<ALL>(partitioning, raw);
    let mut clamped = [1.0; LANES * MAX_FACTORS];
    for i in 0..OUTER {
        clamped[i] = clamp(raw[i], outer_low, high);
    }
    let inside = clamped[OUTER..ALL].as_chunks_mut::<LANES>().0;
    for (clamped, raw) in inside.iter_mut().zip(raw[OUTER..ALL].as_chunks::<LANES>().0) {
        for lane in 0..LANES {
            clamped[lane] = clamp(raw[lane], inside_low[lane], high);
        }
    }
    let (fixed, odd) = match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => integers::<OUTER, ALL>(&clamped),
        Partitioning::FractionalOdd => (fractions::<ALL>(&clamped), [1; LANES * MAX_FACTORS]),
        Partitioning::FractionalEven => (fractions::<ALL>(&clamped), [0; LANES * MAX_FACTORS]),
    };
    let minimum = minimum::<ALL>(&fixed);
    Processed { fixed, odd, alive: alive::<OUTER>(raw), minimum }
}

/// Factors of one patch that are processed at once: those that there are, filled up to a short vector.
pub(crate) const FACTORS_AT_ONCE: usize = 8;

/// The factors of one patch as fixed-point numbers. Those that its domain does not have are unspecified,
/// and in range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OneProcessed {
    /// As in [`Processed`].
    pub(crate) fixed: [u32; FACTORS_AT_ONCE],
    /// 1 where the parity is odd.
    pub(crate) odd: [u32; FACTORS_AT_ONCE],
    /// Whether it is not culled.
    pub(crate) alive: bool,
    /// Whether it is a minimum patch.
    pub(crate) minimum: bool,
}

/// Processes the raw factors of one patch, of which those below `OUTER` are outer ones and those below
/// `ALL` exist; zeros follow these.
#[inline(always)]
pub(crate) fn process_one<const OUTER: usize, const ALL: usize>(
    partitioning: Partitioning,
    raw: &[f32; FACTORS_AT_ONCE],
) -> OneProcessed {
    let (low, high) = partitioning.range();
    let any_greater = |bound| raw.iter().fold(false, |any, &x| any | is_greater(x, bound));
    let is_odd = partitioning == Partitioning::FractionalOdd;
    let inside_low =
        if is_odd && any_greater(ONE_PLUS_2_POW_MINUS_17) { ONE_PLUS_2_POW_MINUS_16 } else { low };
    let (mut fixed, mut odd) = ([ONE; FACTORS_AT_ONCE], [u32::from(is_odd); FACTORS_AT_ONCE]);
    let mut clamped = [1.0; FACTORS_AT_ONCE];
    for i in 0..FACTORS_AT_ONCE {
        clamped[i] = clamp(raw[i], if i < OUTER { low } else { inside_low }, high);
    }
    for i in 0..FACTORS_AT_ONCE {
        if partitioning.has_integer_factors() {
            let integer = ceil(clamped[i]);
            fixed[i] = integer << 16;
            odd[i] = integer & 1 & u32::from(i < OUTER || integer != 1);
        } else {
            fixed[i] = to_fixed(clamped[i]);
        }
    }
    OneProcessed {
        fixed,
        odd,
        alive: raw[..OUTER].iter().fold(true, |alive, &x| alive & is_greater(x, 0.0)),
        minimum: fixed[..ALL].iter().fold(true, |minimum, &x| minimum & (x == ONE)),
    }
}

/// [`process_one`] of an isoline patch, whose density is an integer under every partitioning.
#[inline(always)]
pub(crate) fn process_one_isoline(
    partitioning: Partitioning,
    raw: &[f32; FACTORS_AT_ONCE],
) -> OneProcessed {
    let mut processed = process_one::<2, 2>(partitioning, raw);
    let density = ceil(clamp(raw[0], 1.0, 64.0));
    (processed.fixed[0], processed.odd[0]) = (density << 16, density & 1);
    OneProcessed { minimum: false, ..processed }
}

/// Step 1: 1 where every outer factor is greater than zero.
#[inline(always)]
fn alive<const OUTER: usize>(raw: &Column<f32>) -> Lanes {
    let mut alive = [1; LANES];
    for factors in raw[..OUTER].as_chunks::<LANES>().0 {
        for (alive, &factor) in alive.iter_mut().zip(factors) {
            *alive &= u32::from(is_greater(factor, 0.0));
        }
    }
    alive
}

/// The bit pattern of infinity. As signed integers, NaN patterns are greater and patterns with a sign
/// are negative.
///
/// Factors are compared as integers for the reason that `tess-core` gives (`d3d_float`); signed
/// ones, as every level has instructions for them.
const INFINITY: i32 = f32::INFINITY.to_bits().cast_signed();

/// Whether `x > low`, which is not negative.
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

/// Step 4: the lower bound of the inside factors.
#[inline(always)]
fn inside_low<const ALL: usize>(partitioning: Partitioning, raw: &Column<f32>) -> Lanes<f32> {
    let mut low = [partitioning.range().0; LANES];
    if partitioning == Partitioning::FractionalOdd {
        for factors in raw[..ALL].as_chunks::<LANES>().0 {
            for (low, &factor) in low.iter_mut().zip(factors) {
                let above = is_greater(factor, ONE_PLUS_2_POW_MINUS_17);
                *low = if above { ONE_PLUS_2_POW_MINUS_16 } else { *low };
            }
        }
    }
    low
}

/// Steps 3, 6 and 7 for integer partitionings.
#[inline(always)]
fn integers<const OUTER: usize, const ALL: usize>(clamped: &Column<f32>) -> (Column, Column) {
    let mut fixed = [ONE; LANES * MAX_FACTORS];
    let mut odd = [0; LANES * MAX_FACTORS];
    for i in 0..ALL {
        let integer = ceil(clamped[i]);
        fixed[i] = integer << 16;
        odd[i] = integer & 1;
    }
    for i in OUTER..ALL {
        odd[i] &= u32::from(fixed[i] != ONE);
    }
    (fixed, odd)
}

/// Step 7 for fractional partitionings.
#[inline(always)]
fn fractions<const ALL: usize>(clamped: &Column<f32>) -> Column {
    let mut fixed = [ONE; LANES * MAX_FACTORS];
    for i in 0..ALL {
        fixed[i] = to_fixed(clamped[i]);
    }
    fixed
}

/// The ceiling of a number in 0..2^22: the nearest integer, one more if that lies below.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "sums below 2^24 round to the nearest integer")]
pub(crate) fn ceil(x: f32) -> u32 {
    let sum = x + TWO_POW_23;
    (sum.to_bits() & MANTISSA) + u32::from(sum - TWO_POW_23 < x)
}

/// A number in 0..=64 in multiples of 2^-16, ties to even.
///
/// The product is exact and at most 2^22, so the sum lies where binary32 numbers are the integers:
/// adding rounds to the nearest one, ties to even, and leaves it in the mantissa.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "the rounding of the sum is the conversion's own")]
pub(crate) fn to_fixed(x: f32) -> u32 {
    (x * 65536.0 + TWO_POW_23).to_bits() & MANTISSA
}

/// Step 8, for triangles and quads.
#[inline(always)]
fn minimum<const ALL: usize>(fixed: &Column) -> Lanes {
    let mut minimum = [1; LANES];
    for factors in fixed[..ALL].as_chunks::<LANES>().0 {
        for (minimum, &factor) in minimum.iter_mut().zip(factors) {
            *minimum &= u32::from(factor == ONE);
        }
    }
    minimum
}

#[cfg(all(test, feature = "std"))]
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

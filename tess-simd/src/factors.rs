//! Factor processing of eight patches (spec section 3), steps named as there.

use crate::lanes::{Column, LANES, Lanes, MAX_FACTORS, factors, outer_factors};
use crate::reciprocal::{MANTISSA, TWO_POW_23};
use tess_core::fixed_point::ONE;
use tess_core::{Config, Domain, Partitioning};

/// The factors of eight patches as fixed-point numbers.
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

/// Processes the raw factors of eight patches. Total: every bit pattern is valid.
#[inline(always)]
pub(crate) fn process(config: Config, domain: Domain, raw: &Column<f32>) -> Processed {
    let (_, high) = config.partitioning.range();
    let outer = LANES * outer_factors(domain);
    let all = LANES * factors(domain);
    let low = inside_low(config.partitioning, &raw[..all]);
    let mut fixed = [ONE; LANES * MAX_FACTORS];
    let mut odd = [0; LANES * MAX_FACTORS];
    let parts = [(0..outer, false), (outer..all, true)];
    for (part, inside) in parts {
        let columns = fixed[part.clone()].iter_mut().zip(&mut odd[part.clone()]);
        for ((fixed, odd), (i, &raw)) in columns.zip(raw[part].iter().enumerate()) {
            let outer_low = config.partitioning.range().0;
            let clamped = clamp(raw, if inside { low[i % LANES] } else { outer_low }, high);
            (*fixed, *odd) = convert(config.partitioning, inside, clamped);
        }
    }
    if domain == Domain::Isoline {
        for (lane, &density) in raw[..LANES].iter().enumerate() {
            let clamped = clamp(density, 1.0, 64.0);
            (fixed[lane], odd[lane]) = convert(Partitioning::Integer, false, clamped);
        }
    }
    let minimum = minimum(domain, &fixed[..all]);
    Processed { fixed, odd, alive: alive(&raw[..outer]), minimum }
}

/// Step 1: 1 where every outer factor is greater than zero.
#[inline(always)]
fn alive(outer: &[f32]) -> Lanes {
    let mut alive = [1; LANES];
    for (i, &factor) in outer.iter().enumerate() {
        alive[i % LANES] &= u32::from(factor > 0.0);
    }
    alive
}

/// Steps 2 and 5; NaN gives `low`.
#[inline(always)]
fn clamp(x: f32, low: f32, high: f32) -> f32 {
    let from_below = if x > low { x } else { low };
    if from_below < high { from_below } else { high }
}

/// Step 4: the lower bound of the inside factors.
#[inline(always)]
fn inside_low(partitioning: Partitioning, raw: &[f32]) -> Lanes<f32> {
    const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
    const ONE_PLUS_2_POW_MINUS_16: f32 = f32::from_bits(0x3F80_0080);
    let mut low = [partitioning.range().0; LANES];
    if partitioning == Partitioning::FractionalOdd {
        for (i, &factor) in raw.iter().enumerate() {
            if factor > ONE_PLUS_2_POW_MINUS_17 {
                low[i % LANES] = ONE_PLUS_2_POW_MINUS_16;
            }
        }
    }
    low
}

/// Steps 3, 6 and 7: a clamped factor as 15.16 number, and 1 if its parity is odd.
#[inline(always)]
pub(crate) fn convert(partitioning: Partitioning, inside: bool, clamped: f32) -> (u32, u32) {
    match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => {
            let integer = ceil(clamped);
            (integer << 16, integer & 1 & !u32::from(inside && integer == 1))
        }
        Partitioning::FractionalOdd => (to_fixed(clamped), 1),
        Partitioning::FractionalEven => (to_fixed(clamped), 0),
    }
}

/// The ceiling of a number in 0..2^22: the nearest integer, one more if that lies below.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "sums below 2^24 round to the nearest integer")]
fn ceil(x: f32) -> u32 {
    let sum = x + TWO_POW_23;
    (sum.to_bits() & MANTISSA) + u32::from(sum - TWO_POW_23 < x)
}

/// A number in 0..=64 in multiples of 2^-16, ties to even.
///
/// The product is exact and at most 2^22, so the sum lies where binary32 numbers are the integers:
/// adding rounds to the nearest one, ties to even, and leaves it in the mantissa.
#[inline(always)]
#[expect(clippy::float_arithmetic, reason = "the rounding of the sum is the conversion's own")]
fn to_fixed(x: f32) -> u32 {
    (x * 65536.0 + TWO_POW_23).to_bits() & MANTISSA
}

/// Step 8.
#[inline(always)]
fn minimum(domain: Domain, fixed: &[u32]) -> Lanes {
    let mut minimum = [u32::from(domain != Domain::Isoline); LANES];
    for (i, &fixed) in fixed.iter().enumerate() {
        minimum[i % LANES] &= u32::from(fixed == ONE);
    }
    minimum
}

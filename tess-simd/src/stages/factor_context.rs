//! Factor contexts (spec section 4).

use crate::data::lanes::{at, at_mut};
use crate::stages::reciprocal::reciprocal;
use tess_core::fixed_point::{HALF, ONE};
use tess_core::{FactorContext, Parity, SplitOrder};

/// The context of one factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PlainContext {
    pub(crate) odd: u32,
    pub(crate) inv_floor: u32,
    pub(crate) inv_ceil: u32,
    pub(crate) fraction: u32,
    pub(crate) half_points: u32,
    pub(crate) split_position: u32,
    pub(crate) points: u32,
}

/// Only the point counts of factors.
#[inline(always)]
pub(crate) fn point_counts<const L: usize, const F: usize>(
    fixed: &[[u32; L]; F],
    odd: &[[u32; L]; F],
) -> [[u32; L]; F] {
    let mut points = [[0; L]; F];
    for i in 0..L * F {
        *at_mut(&mut points, i) = point_count(at(fixed, i), at(odd, i));
    }
    points
}

/// The point count of a factor in range.
#[inline(always)]
pub(crate) fn point_count(fixed: u32, odd: u32) -> u32 {
    2 * ((half(fixed, odd) + 0xFFFF) >> 16) + 1 - odd
}

impl PlainContext {
    /// The context of a factor in range: 1..=63 if odd, 1 or 2..=64 if even. Free of branches.
    #[inline(always)]
    pub(crate) fn new(fixed: u32, odd: u32, order: SplitOrder) -> Self {
        let half = half(fixed, odd);
        let floor = half >> 16;
        let ceil = (half + 0xFFFF) >> 16;
        let split_position = match order {
            // An odd factor below 3 has no points to rank; then the position is 0, not 1.
            SplitOrder::Ruler => {
                let points = floor - odd;
                2 * drop_most_significant_bit(points) + u32::from(points != 0)
            }
            SplitOrder::Centre => ceil.wrapping_sub(1 + odd),
        };
        Self {
            odd,
            inv_floor: reciprocal(2 * floor - odd),
            inv_ceil: reciprocal(2 * ceil - odd),
            fraction: half & 0xFFFF,
            half_points: ceil,
            split_position: if floor == ceil { ceil + 1 } else { split_position },
            points: 2 * ceil + 1 - odd,
        }
    }
}

/// Half of a factor, from which the points of a half edge follow, in 16.16: at most 32.
///
/// An odd factor has one half more. The even factor 1 acts as 2; no even factor is between 1 and 2.
#[inline(always)]
fn half(fixed: u32, odd: u32) -> u32 {
    let half = ((fixed + 1) >> 1) + HALF * odd;
    half.cast_signed().max(ONE.cast_signed()).cast_unsigned()
}

/// Clears the highest set bit of `x <= 32`; 0 stays 0.
#[inline(always)]
const fn drop_most_significant_bit(x: u32) -> u32 {
    let x1 = x | (x >> 1);
    let x2 = x1 | (x1 >> 2);
    let below = (x2 | (x2 >> 4)) >> 1;
    x & below
}

impl From<&FactorContext> for PlainContext {
    fn from(context: &FactorContext) -> Self {
        let FactorContext {
            parity,
            inv_floor,
            inv_ceil,
            fraction,
            half_points,
            split_position,
            points,
        } = *context;
        Self {
            odd: parity.odd(),
            inv_floor,
            inv_ceil,
            fraction,
            half_points,
            split_position,
            points,
        }
    }
}

impl From<&PlainContext> for FactorContext {
    fn from(context: &PlainContext) -> Self {
        let PlainContext {
            odd,
            inv_floor,
            inv_ceil,
            fraction,
            half_points,
            split_position,
            points,
        } = *context;
        let parity = if odd == 1 { Parity::Odd } else { Parity::Even };
        Self { parity, inv_floor, inv_ceil, fraction, half_points, split_position, points }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_significant_bits() {
        assert_eq!(drop_most_significant_bit(0), 0, "no bit");
        for x in 1..=32u32 {
            assert_eq!(drop_most_significant_bit(x), x - (1 << x.ilog2()), "{x}");
        }
    }

    /// Half a factor, rounded up, and one half more if the parity is odd; an even 1 acts as 2.
    #[test]
    fn halves() {
        for fixed in ONE..=64 * ONE {
            let rounded = fixed / 2 + fixed % 2;
            assert_eq!(half(fixed, 1), rounded + HALF, "{fixed:#x}, odd");
            let even = if fixed < 2 * ONE { ONE } else { rounded };
            assert_eq!(half(fixed, 0), even, "{fixed:#x}, even");
        }
    }
}

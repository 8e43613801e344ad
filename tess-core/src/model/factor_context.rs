//! The six numbers that point placement needs of each factor (spec section 4).

use crate::model::fixed_point::{FixedFactor, HALF, ONE, ceil, floor};
use crate::model::reciprocal::reciprocal;
use crate::model::state::{Parity, SplitOrder};

/// Numbers derived once from a factor and its parity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FactorContext {
    /// Parity of the number of segments.
    pub parity: Parity,
    /// Reciprocal of the number of segments of the coarser subdivision, 16 fraction bits.
    pub inv_floor: u32,
    /// Reciprocal of the number of segments of the finer subdivision, 16 fraction bits.
    pub inv_ceil: u32,
    /// Weight of the finer subdivision, 16 fraction bits, below one.
    pub fraction: u32,
    /// Points on a half edge, without the midpoint of an even edge, in 1..=32.
    pub half_points: u32,
    /// The position on the half edge that is splitting: later positions are one lower in the
    /// coarser subdivision. `half_points + 1` if no position splits. The specification's `split`.
    pub split_position: u32,
    /// Points on the whole edge, both ends included, in 2..=65.
    pub points: u32,
}

impl FactorContext {
    /// The context of a factor: 1..=63 if odd, 1..=64 if even (where 1 acts as 2).
    ///
    /// Total: a factor outside its range is clamped to it. Spec sections 4 and 10.
    #[must_use]
    #[inline(always)] // as `process_factor`, which it is a part of
    pub const fn new(factor: FixedFactor, parity: Parity, split_order: SplitOrder) -> Self {
        let odd = parity.odd();
        let rounded_half = clamp_to_range(factor, parity).to_bits().div_ceil(2);
        let shifted = odd == 1 || rounded_half == HALF; // HALF: an even factor of 1
        let half = if shifted { rounded_half + HALF } else { rounded_half };
        let floor_points = floor(half) >> 16;
        let ceil_points = ceil(half) >> 16;
        Self {
            parity,
            inv_floor: segment_length(2 * floor_points - odd),
            inv_ceil: segment_length(2 * ceil_points - odd),
            fraction: half - floor(half),
            half_points: ceil_points,
            split_position: split_position(floor_points, ceil_points, parity, split_order),
            points: point_count(rounded_half, parity),
        }
    }

    /// Positions of the half edge that a transition visits: [`Self::half_points`], less one if odd.
    #[must_use]
    pub const fn visited_positions(&self) -> u32 {
        self.half_points - self.parity.odd()
    }
}

/// The length of each of `segments` equal segments, 16 fraction bits. `segments` is in 1..=64.
const fn segment_length(segments: u32) -> u32 {
    match reciprocal(segments) {
        Some(length) => length,
        None => 0, // not reached: a factor in range has 1 to 64 segments
    }
}

/// Clamps to the range that factor processing already guarantees, so that every reciprocal exists.
/// Legal even factors are 1 (treated as 2) and 2..=64.
const fn clamp_to_range(factor: FixedFactor, parity: Parity) -> FixedFactor {
    let lowest = if factor.to_bits() <= ONE { ONE } else { (2 - parity.odd()) << 16 };
    let highest = (64 - parity.odd()) << 16;
    let bits = factor.to_bits();
    FixedFactor::from_bits(if bits < lowest {
        lowest
    } else if bits > highest {
        highest
    } else {
        bits
    })
}

/// The position that splits between `floor_points` and `ceil_points`, in 0..=33.
const fn split_position(
    floor_points: u32,
    ceil_points: u32,
    parity: Parity,
    split_order: SplitOrder,
) -> u32 {
    if floor_points == ceil_points {
        return ceil_points + 1; // past every position: no point splits
    }
    match (split_order, parity) {
        (SplitOrder::Ruler, Parity::Odd) if floor_points == 1 => 0,
        (SplitOrder::Ruler, Parity::Odd) => 2 * drop_most_significant_bit(floor_points - 1) + 1,
        (SplitOrder::Ruler, Parity::Even) => 2 * drop_most_significant_bit(floor_points) + 1,
        (SplitOrder::Centre, Parity::Odd) => ceil_points - 2,
        (SplitOrder::Centre, Parity::Even) => ceil_points - 1,
    }
}

/// Clears the highest set bit of `x >= 1`.
const fn drop_most_significant_bit(x: u32) -> u32 {
    x & !(1 << (31 - x.leading_zeros()))
}

/// Points along the edge, both ends included, from half the factor, rounded up. The even factor 1
/// has the three points of factor 2, because its half is rounded up to one.
const fn point_count(rounded_half: u32, parity: Parity) -> u32 {
    match parity {
        Parity::Odd => 2 * (ceil(HALF + rounded_half) >> 16),
        Parity::Even => 2 * (ceil(rounded_half) >> 16) + 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A factor that factor processing never makes has the context of the nearest one that it
    /// makes.
    #[test]
    fn factors_out_of_range_count_as_the_nearest_end() {
        let context = |bits, parity| {
            FactorContext::new(FixedFactor::from_bits(bits), parity, SplitOrder::Ruler)
        };
        for bits in (0..2 * ONE).step_by(13) {
            assert_eq!(context(bits, Parity::Even), context(2 * ONE, Parity::Even), "{bits:#x}");
        }
        for bits in (0..ONE).step_by(13) {
            assert_eq!(context(bits, Parity::Odd), context(ONE, Parity::Odd), "{bits:#x}");
        }
        for (parity, highest) in [(Parity::Even, 64 * ONE), (Parity::Odd, 63 * ONE)] {
            for bits in [highest + 1, highest + ONE, FixedFactor::MAX.to_bits()] {
                assert_eq!(context(bits, parity), context(highest, parity), "{bits:#x}");
            }
        }
    }
}

//! Where a point lies along one dimension (spec section 5).

use crate::factor_context::FactorContext;
use crate::fixed_point::{HALF, ONE};
use fixed::types::U16F16;

/// The location of point `p` of an edge, as the split order places it.
///
/// In: `p < context.points`. Out: 16.16 in `0..=ONE`, symmetric:
/// `place(c, p) + place(c, c.points - 1 - p) == ONE`. Spec section 5 (D3D11.3 11.7.13, 11.7.14).
#[must_use]
pub const fn place(context: &FactorContext, p: u32) -> U16F16 {
    debug_assert!(p < context.points, "a point of this edge");
    let flip = p >= context.half_points;
    // p < points = 2 * half_points + 1 - odd, so the mirrored position is not negative.
    let p = if flip { 2 * context.half_points - p - context.parity.odd() } else { p };
    if p == context.half_points {
        return U16F16::from_bits(HALF); // the exact middle of an even edge
    }
    let x = place_on_half_edge(context, p);
    U16F16::from_bits(if flip { ONE - x } else { x })
}

/// The location of position `p < half_points`, at most `HALF + 10`.
///
/// Between the point's place in the coarser subdivision and that in the finer one. No overflow:
/// `p < 32` and reciprocals are at most `ONE`, so each product with one is below 2^21; the two
/// places are at most `HALF + 10`, as reciprocals round up, so the weighted sum stays below
/// 2^31 + 2^20 + `HALF`.
const fn place_on_half_edge(context: &FactorContext, p: u32) -> u32 {
    let coarse_position = if p > context.split { p - 1 } else { p };
    let coarse = coarse_position * context.inv_floor;
    let fine = p * context.inv_ceil;
    debug_assert!(coarse <= HALF + 10 && fine <= HALF + 10, "both places lie on the half edge");
    (coarse * (ONE - context.fraction) + fine * context.fraction + HALF) >> 16
}

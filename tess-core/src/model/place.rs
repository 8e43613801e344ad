//! The location of a point along one dimension (spec section 5).

use crate::model::factor_context::FactorContext;
use crate::model::fixed_point::{HALF, ONE};
use fixed::types::U16F16;

/// A location and the values that lead to it, in the order in which hardware computes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Placement {
    /// Whether the point is on the second half of the edge, which mirrors the first, or in the
    /// middle.
    pub flip: bool,
    /// The position on the half edge, `0..=half_points`.
    pub position: u32,
    /// The two locations that are blended on the half edge; `None` in the exact middle of an even
    /// edge.
    pub blend: Option<Blend>,
    /// The location on the half edge, before mirroring, 16 fraction bits.
    pub half_location: u32,
    /// The location: `half_location`, or `ONE - half_location` if `flip`.
    pub location: U16F16,
}

/// The two places of a point on a half edge, between which its location is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Blend {
    /// Its place in the coarser subdivision, 16 fraction bits, at most `HALF + 10`.
    pub coarse: u32,
    /// Its place in the finer subdivision, 16 fraction bits, at most `HALF + 10`.
    pub fine: u32,
    /// The weight of `fine`, 16 fraction bits, below `ONE`.
    pub fraction: u32,
}

impl Blend {
    /// Position `p < half_points` of a half edge, in both subdivisions.
    ///
    /// No overflow: `p < 32` and reciprocals are at most `ONE`, so both products stay below 2^21.
    const fn new(context: &FactorContext, p: u32) -> Self {
        let coarse_position = if p > context.split_position { p - 1 } else { p };
        Self {
            coarse: coarse_position * context.inv_floor,
            fine: p * context.inv_ceil,
            fraction: context.fraction,
        }
    }

    /// The location on the half edge, 16 fraction bits, rounded to nearest.
    ///
    /// No overflow: both places are at most `HALF + 10`, because reciprocals may be rounded up, so
    /// the weighted sum stays below 2^31 + 2^20 + `HALF`.
    ///
    /// # Panics
    /// With overflow checks, may panic if a place or the weight exceeds its field's range.
    #[must_use]
    pub const fn half_location(self) -> u32 {
        let Self { coarse, fine, fraction } = self;
        (coarse * (ONE - fraction) + fine * fraction + HALF) >> 16
    }
}

/// The location of point `p` of an edge, as the split order places it.
///
/// In: a context that [`FactorContext::new`] made, and `p < context.points`; a larger `p` counts as
/// the last point. Out: 16.16 in `0..=ONE`, symmetric: `place(c, p) + place(c, c.points - 1 - p) ==
/// ONE`. Spec section 5 (D3D11.3 11.7.13, 11.7.14).
///
/// # Panics
/// With overflow checks, may panic if no factor has this context.
#[must_use]
pub const fn place(context: &FactorContext, p: u32) -> U16F16 {
    placement(context, p).location
}

/// [`place`] with every intermediate value.
///
/// # Panics
/// Like [`place`].
#[must_use]
pub const fn placement(context: &FactorContext, p: u32) -> Placement {
    let p = if p < context.points { p } else { context.points - 1 };
    let flip = p >= context.half_points;
    // p < points = 2 * half_points + 1 - odd, so the mirrored position is not negative.
    let position = if flip { 2 * context.half_points - p - context.parity.odd() } else { p };
    let (blend, half_location) = if position == context.half_points {
        (None, HALF) // the exact middle of an even edge
    } else {
        let blend = Blend::new(context, position);
        (Some(blend), blend.half_location())
    };
    let location = if flip { ONE - half_location } else { half_location };
    Placement { flip, position, blend, half_location, location: U16F16::from_bits(location) }
}

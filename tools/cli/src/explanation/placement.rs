//! One placement in one dimension with its intermediate values (spec section 5).

use serde::Serialize;
use std::fmt;
use tess_core::fixed_point::{HALF, ONE};
use tess_core::{FactorContext, place};

/// `place(context of factor, position)` and how it came about.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Placement {
    factor: &'static str,
    position: u32,
    location: u32,
    /// Absent for the exact middle of an even edge.
    half_edge: Option<HalfEdge>,
}

/// The lerp on the half edge.
#[derive(Clone, Copy, Debug, Serialize)]
struct HalfEdge {
    /// Whether the location is ONE minus that of the mirrored position.
    flipped: bool,
    /// The position after mirroring.
    position: u32,
    /// Position in the coarser subdivision, times `inv_floor`.
    coarse: u32,
    /// Position in the finer subdivision, times `inv_ceil`.
    fine: u32,
    /// Weight of `fine`, of 65536.
    fraction: u32,
}

impl Placement {
    pub(super) fn new(factor: &'static str, context: &FactorContext, position: u32) -> Self {
        let location = place(context, position).to_bits();
        Self { factor, position, location, half_edge: HalfEdge::new(context, position) }
    }

    /// The location that came out.
    pub(super) const fn location(&self) -> u32 {
        self.location
    }
}

impl HalfEdge {
    fn new(context: &FactorContext, position: u32) -> Option<Self> {
        let flipped = position >= context.half_points;
        let mirrored = 2 * context.half_points - context.parity.odd();
        let position = if flipped { mirrored - position } else { position };
        (position != context.half_points).then(|| Self {
            flipped,
            position,
            coarse: (position - u32::from(position > context.split)) * context.inv_floor,
            fine: position * context.inv_ceil,
            fraction: context.fraction,
        })
    }

    #[cfg(test)]
    const fn location(&self) -> u32 {
        let x = (self.coarse * (ONE - self.fraction) + self.fine * self.fraction + HALF) >> 16;
        if self.flipped { ONE - x } else { x }
    }
}

impl fmt::Display for Placement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { factor, position, location, half_edge } = self;
        write!(f, "place({factor}, {position}) = {location:05x}: ")?;
        let Some(half) = half_edge else {
            return write!(f, "the exact middle, {HALF:05x}");
        };
        if half.flipped {
            write!(f, "{ONE:05x} minus the mirrored position {}, ", half.position)?;
        }
        let coarse_weight = ONE - half.fraction;
        write!(
            f,
            "(coarse {:05x} * {coarse_weight:05x} + fine {:05x} * {:05x} + {HALF:05x}) >> 16",
            half.coarse, half.fine, half.fraction
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{FixedFactor, Parity, SplitOrder};

    /// The intermediate values shown are the ones that the model's location follows from.
    #[test]
    fn intermediate_values_give_the_location() {
        for parity in [Parity::Even, Parity::Odd] {
            for bits in (0x1_0000..=0x40_0000).step_by(3011) {
                for split in SplitOrder::ALL {
                    let context = FactorContext::new(FixedFactor::from_bits(bits), parity, split);
                    for p in 0..context.points {
                        let half = HalfEdge::new(&context, p);
                        let location = half.map_or(HALF, |half| half.location());
                        let expected = place(&context, p).to_bits();
                        assert_eq!(location, expected, "{context:?}, position {p}");
                    }
                }
            }
        }
    }
}

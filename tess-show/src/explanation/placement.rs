//! One placement in one dimension, with its intermediate values (spec section 5).

use std::fmt;
use tess_core::FactorContext;
use tess_core::fixed_point::{HALF, ONE};
use tess_core::place::{Blend, placement};

/// `place(context of factor, position)`, and how it is computed.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Placement {
    factor: &'static str,
    position: u32,
    location: u32,
    /// `None` for the exact middle of an even edge.
    half_edge: Option<HalfEdge>,
}

/// The two places that are blended on the half edge.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
struct HalfEdge {
    /// Whether the location is ONE minus the location of the mirrored position.
    flipped: bool,
    /// The position after mirroring.
    position: u32,
    /// The position in the coarser subdivision, times `inv_floor`.
    coarse: u32,
    /// The position in the finer subdivision, times `inv_ceil`.
    fine: u32,
    /// The weight of `fine`, in 1/65536.
    fraction: u32,
}

impl Placement {
    pub(super) fn new(factor: &'static str, context: &FactorContext, position: u32) -> Self {
        let placed = placement(context, position);
        let half_edge = |Blend { coarse, fine, fraction }| HalfEdge {
            flipped: placed.flip,
            position: placed.position,
            coarse,
            fine,
            fraction,
        };
        Self {
            factor,
            position,
            location: placed.location.to_bits(),
            half_edge: placed.blend.map(half_edge),
        }
    }

    /// The resulting location.
    pub(super) const fn location(&self) -> u32 {
        self.location
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

//! Locations along one dimension, a whole edge at a time (spec section 5).

use crate::factor_context::Context;
use tess_core::fixed_point::{HALF, ONE};

/// Locations computed at a time.
const STEP: usize = 16;
/// Room for an edge's 65 locations and for reading whole blocks from any start.
const ROOM: usize = 112;

/// The 16.16 locations of all points of an edge, ascending in position; what follows them is
/// unspecified.
///
/// The locations seen from the other end are `ONE` minus these.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Locations([u32; ROOM]);

impl Locations {
    pub(crate) const EMPTY: Self = Self([0; ROOM]);

    /// Computes the locations of points `0..context.points`.
    #[inline(always)]
    pub(crate) fn fill(&mut self, context: &Context) {
        let mut p = 0;
        for chunk in self.0.as_chunks_mut::<STEP>().0 {
            for location in chunk {
                *location = place(context, p);
                p += 1;
            }
            if p >= context.points {
                break;
            }
        }
    }

    /// The locations of points from `first` on, and then the unspecified rest.
    #[inline(always)]
    pub(crate) fn from(&self, first: u32) -> &[u32] {
        self.0.get(first as usize..).unwrap_or_default()
    }

    /// The location of point `p`.
    #[inline(always)]
    pub(crate) fn at(&self, p: u32) -> u32 {
        self.0.get(p as usize).copied().unwrap_or_default()
    }

    /// The location of point `p` seen from the other end.
    #[inline(always)]
    pub(crate) fn mirrored(&self, p: u32) -> u32 {
        ONE.wrapping_sub(self.at(p))
    }
}

/// The location of point `p < context.points`; unspecified beyond. Free of branches.
///
/// With `a` and `b` the places in the coarser and in the finer subdivision, the sum
/// `a * (ONE - fraction) + b * fraction` is taken as `a * ONE + (b - a) * fraction` modulo 2^32,
/// where the whole sum fits.
#[inline(always)]
pub(crate) fn place(context: &Context, p: u32) -> u32 {
    let mirrored = context.points.wrapping_sub(1 + p);
    let flip = p >= context.half_points;
    let on_half = if flip { mirrored } else { p };
    let coarse = on_half.wrapping_sub(u32::from(on_half > context.split));
    let a = coarse.wrapping_mul(context.inv_floor);
    let b = on_half.wrapping_mul(context.inv_ceil);
    let sum = (a << 16).wrapping_add(b.wrapping_sub(a).wrapping_mul(context.fraction));
    let x = sum.wrapping_add(HALF) >> 16;
    let x = if flip { ONE.wrapping_sub(x) } else { x };
    if on_half == context.half_points { HALF } else { x }
}

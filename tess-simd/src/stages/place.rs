//! Locations along one dimension, a whole edge at a time (spec section 5).

use crate::data::lanes::{Column, LANES, MAX_FACTORS};
use crate::stages::factor_context::Context;
use tess_core::SplitOrder;
use tess_core::fixed_point::{HALF, ONE};

/// Locations computed at a time.
const LOCATIONS_AT_ONCE: u32 = 16;
/// Room for an edge's 65 locations and for reading whole blocks from any start.
const ROOM: usize = 112;

/// What the locations of an edge's points follow from, all modulo 2^32.
///
/// With `a` and `b` the places of a position in the coarser and in the finer subdivision, the
/// specification takes `a * (ONE - fraction) + b * fraction`, which fits 32 bits. `b` is the
/// position times `inv_ceil`; `a` is the position, less one behind the split, times `inv_floor`.
/// Hence the sum is the position times `step`, less `lag` behind the split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spacing {
    /// Points of the edge.
    pub(crate) points: u32,
    /// The last position before the split.
    pub(crate) split: u32,
    pub(crate) step: u32,
    pub(crate) lag: u32,
}

impl Spacing {
    /// The spacing of a context's points.
    #[inline(always)]
    pub(crate) const fn new(context: &Context) -> Self {
        let Context { inv_floor, inv_ceil, fraction, split, points, .. } = *context;
        let lag = inv_floor.wrapping_mul(ONE - fraction);
        let step = lag.wrapping_add(inv_ceil.wrapping_mul(fraction));
        Self { points, split, step, lag }
    }
}

/// The spacings of a packet of fractional factors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spacings {
    split: Column,
    step: Column,
    lag: Column,
}

impl Spacings {
    pub(crate) const NONE: Self = {
        const NONE: Column = [0; LANES * MAX_FACTORS];
        Self { split: NONE, step: NONE, lag: NONE }
    };

    /// Computes the spacings of the first `ALL` elements of two columns, and their point counts; other
    /// elements stay as they are.
    #[inline(always)]
    pub(crate) fn fill<const ALL: usize>(
        &mut self,
        points: &mut Column,
        (fixed, odd): (&Column, &Column),
        order: SplitOrder,
    ) {
        for i in 0..ALL {
            let spacing = Spacing::new(&Context::new(fixed[i], odd[i], order));
            points[i] = spacing.points;
            self.split[i] = spacing.split;
            self.step[i] = spacing.step;
            self.lag[i] = spacing.lag;
        }
    }

    /// Sets the spacing of an element, but for its points.
    #[inline(always)]
    pub(crate) const fn set(&mut self, i: usize, spacing: &Spacing) {
        let Spacing { split, step, lag, .. } = *spacing;
        (self.split[i], self.step[i], self.lag[i]) = (split, step, lag);
    }

    /// The spacing of an element with this many points.
    #[inline(always)]
    pub(crate) const fn get(&self, i: usize, points: u32) -> Spacing {
        Spacing { points, split: self.split[i], step: self.step[i], lag: self.lag[i] }
    }
}

/// The 16.16 locations of all points of an edge, ascending in position; what follows them is
/// unspecified.
///
/// The locations seen from the other end are `ONE` minus these.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Locations([u32; ROOM]);

impl Locations {
    pub(crate) const EMPTY: Self = Self([0; ROOM]);

    /// Computes the locations of points `0..spacing.points`.
    #[inline(always)]
    pub(crate) fn fill(&mut self, spacing: &Spacing) {
        const FIRST: [u32; LOCATIONS_AT_ONCE as usize] =
            [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let mut start = 0;
        for chunk in self.0.as_chunks_mut::<{ LOCATIONS_AT_ONCE as usize }>().0 {
            for (location, p) in chunk.iter_mut().zip(FIRST) {
                *location = place(spacing, start + p);
            }
            start += LOCATIONS_AT_ONCE;
            if start >= spacing.points {
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
}

/// The location of point `p < spacing.points`; unspecified beyond. Free of branches.
///
/// Numbers of points are compared as signed integers, as every level has instructions for them.
#[inline(always)]
pub(crate) fn place(spacing: &Spacing, p: u32) -> u32 {
    let mirrored = spacing.points.wrapping_sub(1 + p);
    let is_mirrored = p.cast_signed() > mirrored.cast_signed();
    let position = p.cast_signed().min(mirrored.cast_signed()).cast_unsigned();
    let x = place_in_half(spacing, position);
    if is_mirrored { ONE.wrapping_sub(x) } else { x }
}

/// The location of a point of an edge's first half, its middle included; unspecified beyond. Free of branches.
#[inline(always)]
pub(crate) const fn place_in_half(spacing: &Spacing, position: u32) -> u32 {
    let Spacing { points, split, step, lag } = *spacing;
    let is_behind = position.cast_signed() > split.cast_signed();
    let sum = position.wrapping_mul(step).wrapping_sub(if is_behind { lag } else { 0 });
    let x = sum.wrapping_add(HALF) >> 16;
    let is_middle = position.wrapping_mul(2).wrapping_add(1) == points;
    if is_middle { HALF } else { x }
}

//! Locations along one dimension, a whole edge at a time (spec section 5).

use crate::data::lanes::{Column, LANES, MAX_FACTORS, at, at_mut, set_rows};
use crate::stages::factor_context::PlainContext;
use crate::stages::factors::Processed;
use tess_core::SplitOrder;
use tess_core::fixed_point::{HALF, ONE};

/// Locations computed at a time.
const LOCATIONS_AT_ONCE: u32 = 16;
/// Room for an edge's 65 locations and for reading whole blocks from any start.
const ROOM: usize = 112;

/// The numbers from which the locations of an edge's points are computed, all modulo 2^32.
///
/// Let `a` and `b` be the places of a position in the coarser and in the finer subdivision. The
/// specification takes `a * (ONE - fraction) + b * fraction`, which fits 32 bits. `b` is the
/// position times `inv_ceil`; `a` is the position, less one after the split, times `inv_floor`.
/// Hence the sum is the position times `step`, less `lag` after the split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spacing {
    /// Points of the edge.
    pub(crate) points: u32,
    /// The last position before the split.
    pub(crate) split_position: u32,
    pub(crate) step: u32,
    pub(crate) lag: u32,
}

impl Spacing {
    /// The spacing of a context's points.
    #[inline(always)]
    pub(crate) const fn new(context: &PlainContext) -> Self {
        let PlainContext { inv_floor, inv_ceil, fraction, split_position, points, .. } = *context;
        let lag = inv_floor.wrapping_mul(ONE - fraction);
        let step = lag.wrapping_add(inv_ceil.wrapping_mul(fraction));
        Self { points, split_position, step, lag }
    }
}

/// The spacings of a packet of fractional factors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spacings {
    split_position: Column,
    step: Column,
    lag: Column,
}

impl Spacings {
    pub(crate) const NONE: Self = {
        const NONE: Column = [[0; LANES]; MAX_FACTORS];
        Self { split_position: NONE, step: NONE, lag: NONE }
    };

    /// Keeps the spacings of all lanes or of one; returns the point counts.
    #[inline(always)]
    pub(crate) fn keep<const L: usize, const F: usize>(
        &mut self,
        lane: usize,
        Processed { fixed, odd, .. }: &Processed<L, F>,
        order: SplitOrder,
    ) -> [[u32; L]; F] {
        let spacing = |i| Spacing::new(&PlainContext::new(at(fixed, i), at(odd, i), order));
        let [mut points, mut split_position, mut step, mut lag] = [[[0; L]; F]; 4];
        if L == LANES {
            // Written in place: copies would take a tenth of the front end's time.
            for i in 0..L * F {
                let spacing = spacing(i);
                *at_mut(&mut points, i) = spacing.points;
                self.split_position.as_flattened_mut()[i] = spacing.split_position;
                self.step.as_flattened_mut()[i] = spacing.step;
                self.lag.as_flattened_mut()[i] = spacing.lag;
            }
            return points;
        }
        for i in 0..F {
            let spacing = spacing(i);
            (points[i][0], split_position[i][0]) = (spacing.points, spacing.split_position);
            (step[i][0], lag[i][0]) = (spacing.step, spacing.lag);
        }
        set_rows(&mut self.split_position, lane, &split_position);
        set_rows(&mut self.step, lane, &step);
        set_rows(&mut self.lag, lane, &lag);
        points
    }

    /// The spacing of a factor with this many points.
    #[inline(always)]
    pub(crate) const fn get(&self, factor: usize, lane: usize, points: u32) -> Spacing {
        let Self { split_position, step, lag } = self;
        let (split_position, step, lag) =
            (split_position[factor][lane], step[factor][lane], lag[factor][lane]);
        Spacing { points, split_position, step, lag }
    }
}

/// The 16.16 locations of all points of an edge, in the order of the points, followed by
/// unspecified elements.
///
/// Seen from the other end of the edge, a location is `ONE` minus this one.
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

    /// The locations from point `first`, followed by unspecified elements.
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
/// Numbers of points are compared as signed integers, because every level has instructions for
/// those.
#[inline(always)]
pub(crate) fn place(spacing: &Spacing, p: u32) -> u32 {
    let mirrored = spacing.points.wrapping_sub(1 + p);
    let is_mirrored = p.cast_signed() > mirrored.cast_signed();
    let position = p.cast_signed().min(mirrored.cast_signed()).cast_unsigned();
    let x = place_in_half(spacing, position);
    if is_mirrored { ONE.wrapping_sub(x) } else { x }
}

/// The location of a point of an edge's first half, including the middle; unspecified beyond. Free
/// of branches.
#[inline(always)]
pub(crate) const fn place_in_half(spacing: &Spacing, position: u32) -> u32 {
    let Spacing { points, split_position, step, lag } = *spacing;
    let is_behind = position.cast_signed() > split_position.cast_signed();
    let sum = position.wrapping_mul(step).wrapping_sub(if is_behind { lag } else { 0 });
    let x = sum.wrapping_add(HALF) >> 16;
    let is_middle = position.wrapping_mul(2).wrapping_add(1) == points;
    if is_middle { HALF } else { x }
}

//! Ring by ring, edge by edge: the stitches that triangle and quad patches share
//! (spec section 7.1).
//!
//! Each inside factor makes rings up to an end of its own (`end_of_rings`); the patch has rings
//! only up to the nearer one ([`Rings::end`]). With u = 9 points along one inside axis and v = 5
//! along the other, and with one point more along v:
//!
//! ```text
//! u = 9, v = 5                               u = 9, v = 6
//!
//! . . . . . . .   ring 1: 7 x 3 points       . . . . . . .   ring 1: 7 x 4 points
//! . o o o o o .   ring 2: 5 x 1              . o o o o o .   ring 2: 5 x 2
//! . . . . . . .                              . o o o o o .
//!                                            . . . . . . .
//!
//!                        u = 9    v = 5      u = 9    v = 6
//! end_of_rings             5        3          5        3
//! row_ring                 4        2          4      none
//! Rings::end                    3                   3         rings 1 and 2 have stitches
//! ```
//!
//! Ring 2 on the left is a row: `row_ring` of v, which is reached, while ring 4 of u is not. Ring 2
//! on the right goes round, and a centre strip fills it. The test `the_ends_of_rings` has these
//! numbers.

use crate::model::factor_context::FactorContext;
use crate::model::row::Row;
use crate::model::state::Parity;
use crate::model::stitch::{Stitch, StitchKind};

/// The numbers that the rings of a patch with `EDGES` edges depend on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rings<'a, const EDGES: usize> {
    /// Contexts of the outer edges.
    pub(crate) outer: [&'a FactorContext; EDGES],
    /// For each edge, the inside context of the axis that it runs along.
    pub(crate) along: [&'a FactorContext; EDGES],
    /// For each edge, the ring that is a single row of points along this edge, if the rings get
    /// that far: the last ring of the other axis, whose inside context is even.
    pub(crate) row_at: [Option<u32>; EDGES],
}

impl<const EDGES: usize> Rings<'_, EDGES> {
    /// One more than the number of the innermost ring that is stitched to the ring outside of it.
    pub(crate) fn end(&self) -> u32 {
        self.along.iter().copied().map(end_of_rings).min().unwrap_or(0)
    }

    /// Points on the outer ring.
    pub(crate) fn outer_points(&self) -> u32 {
        self.outer.iter().map(|edge| edge.points - 1).sum()
    }

    /// Points on the outer row of an edge's stitch, both ends included.
    pub(crate) const fn outer_row_points(&self, ring: u32, edge: usize) -> u32 {
        if ring == 1 { self.outer[edge].points } else { self.inner_row_points(ring - 1, edge) }
    }

    /// Points on the inner row of an edge's stitch, both ends included.
    pub(crate) const fn inner_row_points(&self, ring: u32, edge: usize) -> u32 {
        self.along[edge].points - 2 * ring
    }

    /// Whether the inner row of this edge is the single row of points, walked backwards.
    pub(crate) fn walks_back(&self, ring: u32, edge: usize) -> bool {
        edge >= 2 && self.row_at[edge] == Some(ring)
    }

    /// Sends the stitches of all rings to `emit`, in order; returns the first index of the
    /// innermost ring.
    pub(crate) fn emit(&self, mut emit: impl FnMut(Stitch)) -> u32 {
        // The next index of each of the two rings of a stitch. Ring 0 begins at 0, and ring 1
        // follows it.
        let mut outer_base = 0;
        let mut inner_base = self.outer_points();
        for ring in 1..self.end() {
            // The inner ring of the previous walk is the outer one now: `outer_base` went once
            // round its ring, and so arrived at the index where that one begins.
            let (outer_start, inner_start) = (outer_base, inner_base);
            for (number, edge) in (0..).zip(0..EDGES) {
                let outer_points = self.outer_row_points(ring, edge);
                let inner_points = self.inner_row_points(ring, edge);
                let mut outer = Row::ascending(outer_base);
                let mut inner = Row::ascending(inner_base);
                // Both long edges meet the same row of points, from opposite ends. The first of
                // them has moved `inner_base` to its last point, where the second begins.
                if self.walks_back(ring, edge) {
                    inner = Row::descending(inner_base);
                }
                // A ring closes: the last entry of its last edge is its first point. A row has two
                // ends, and nothing to close.
                if edge == EDGES - 1 {
                    outer = outer.with(outer_points - 1, outer_start);
                    if !self.walks_back(ring, edge) {
                        inner = inner.with(inner_points - 1, inner_start);
                    }
                }
                let kind = match ring {
                    1 => StitchKind::Transition { edge: number },
                    _ => StitchKind::Ring { ring, edge: number },
                };
                emit(Stitch { kind, outer, outer_points, inner, inner_points });
                // The last point of an edge is the first of the next one, and has one index.
                outer_base += outer_points - 1;
                inner_base += inner_points - 1;
            }
        }
        outer_base
    }
}

/// One more than the number of the innermost ring that an inside factor makes; a single point or a
/// row of points counts as a ring.
const fn end_of_rings(inside: &FactorContext) -> u32 {
    inside.points.div_ceil(2)
}

/// The ring that is a single row because of this inside factor's even parity.
pub(crate) fn row_ring(inside: &FactorContext) -> Option<u32> {
    (inside.parity == Parity::Even).then_some(end_of_rings(inside) - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::fixed_point::FixedFactor;
    use crate::model::state::SplitOrder;

    /// The numbers of the head of this file.
    #[test]
    fn the_ends_of_rings() {
        let context = |factor, parity| {
            FactorContext::new(FixedFactor::from_f32(factor), parity, SplitOrder::Ruler)
        };
        let u = &context(8.0, Parity::Even);
        for (v, points, end, row) in
            [(&context(4.0, Parity::Even), 5, 3, Some(2)), (&context(5.0, Parity::Odd), 6, 3, None)]
        {
            assert_eq!([u.points, v.points], [9, points], "points along the axes");
            assert_eq!([u, v].map(end_of_rings), [5, end], "of each axis");
            assert_eq!([u, v].map(row_ring), [Some(4), row], "of each axis");
            let row_at = [row_ring(u), row_ring(v), row_ring(u), row_ring(v)];
            let rings = Rings { outer: [u; 4], along: [v, u, v, u], row_at };
            assert_eq!(rings.end(), 3, "of the patch");
            let of = |ring| [1, 0].map(|edge| rings.inner_row_points(ring, edge));
            assert_eq!([of(1), of(2)], [[7, points - 2], [5, points - 4]], "ring 1, ring 2");
        }
    }
}

//! Ring by ring, edge by edge: the stitches that triangle and quad patches share
//! (spec section 7.1).

use crate::data::format::IndexFormat;
use crate::data::writer::Writer;
use crate::stages::stitch::{Replaced, Rows, Stitches};

/// The numbers that the rings of a patch with `EDGES` edges depend on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rings<const EDGES: usize> {
    /// Point counts of the outer edges.
    pub(super) outer: [u32; EDGES],
    /// For each edge, the inside point count of the axis that it runs along.
    pub(super) along: [u32; EDGES],
    /// For each edge, the ring that is a row of points along it; 0 if there is no such ring.
    pub(super) row_at: [u32; EDGES],
}

impl<const EDGES: usize> Rings<EDGES> {
    /// Emits the stitches of all rings of a patch whose first point is number `base`; returns the
    /// first index of the innermost ring, modulo 2^32.
    #[inline(always)]
    pub(super) fn emit<I: IndexFormat>(
        &self,
        stitches: &Stitches,
        base: u32,
        out: &mut Writer<'_, I>,
    ) -> u32 {
        let mut outer = base;
        let mut inner = base.wrapping_add(self.outer.iter().map(|points| points - 1).sum::<u32>());
        let end = self.along.iter().map(|points| points.div_ceil(2)).min().unwrap_or(0);
        for ring in 1..end {
            let (outer_start, inner_start) = (outer, inner);
            for edge in 0..EDGES {
                let inner_points = self.along[edge] - 2 * ring;
                let (outer_points, stitch) = if ring == 1 {
                    let points = self.outer[edge];
                    (points, stitches.transition(points, self.along[edge]))
                } else {
                    (inner_points + 2, stitches.ring(inner_points))
                };
                let walks_back = edge >= 2 && self.row_at[edge] == ring;
                let closes = edge == EDGES - 1;
                if closes || walks_back {
                    let replaced = |points, index| Some(Replaced { at: points - 1, index });
                    let outer_end = replaced(outer_points, outer_start);
                    let inner_end = replaced(inner_points, inner_start);
                    let rows = Rows {
                        outer,
                        inner,
                        descending: walks_back,
                        outer_replaced: if closes { outer_end } else { None },
                        inner_replaced: if closes && !walks_back { inner_end } else { None },
                    };
                    stitch.emit(&rows, out);
                } else {
                    stitch.emit_ascending(outer, inner, out);
                }
                outer = outer.wrapping_add(outer_points - 1);
                inner = inner.wrapping_add(inner_points - 1);
            }
        }
        outer
    }
}

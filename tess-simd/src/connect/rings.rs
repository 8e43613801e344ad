//! Ring by ring, edge by edge: the stitches that triangle and quad patches share
//! (spec section 7.1).

use crate::emit::Writer;
use crate::format::IndexFormat;
use crate::stitch::{self, Rows, Stitches};

/// What the rings of a patch with `EDGES` edges depend on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rings<const EDGES: usize> {
    /// Point counts of the outer edges.
    pub(super) outer: [u32; EDGES],
    /// For each edge, the inside point count of the axis that it runs along.
    pub(super) along: [u32; EDGES],
    /// For each edge, the ring that is a row of points along it; 0 if none is.
    pub(super) row_at: [u32; EDGES],
}

impl<const EDGES: usize> Rings<EDGES> {
    /// Emits all rings of a patch whose first point is `base`; returns the first index of the
    /// innermost ring.
    #[inline(always)]
    pub(super) fn emit<I: IndexFormat>(
        &self,
        stitches: &Stitches,
        base: u32,
        out: &mut Writer<'_, I>,
    ) -> u32 {
        let mut outer = base;
        let mut inner = base + self.outer.iter().map(|points| points - 1).sum::<u32>();
        let end = self.along.iter().map(|points| points.div_ceil(2)).min().unwrap_or(0);
        for ring in 1..end {
            let starts = (outer, inner);
            for edge in 0..EDGES {
                let inner_points = self.along[edge] - 2 * ring;
                let (outer_points, (length, codes)) = if ring == 1 {
                    let points = self.outer[edge];
                    (points, stitches.transition(points, self.along[edge]))
                } else {
                    (inner_points + 2, stitches.ring(inner_points))
                };
                let walks_back = edge >= 2 && self.row_at[edge] == ring;
                if edge == EDGES - 1 || walks_back {
                    let closes = edge == EDGES - 1;
                    let rows = Rows {
                        outer,
                        inner,
                        descending: walks_back,
                        outer_replaced: closes.then_some((outer_points - 1, starts.0)),
                        inner_replaced: (closes && !walks_back)
                            .then_some((inner_points - 1, starts.1)),
                    };
                    stitch::general(out, length, codes, &rows);
                } else {
                    stitch::ascending(out, length, codes, outer, inner);
                }
                outer += outer_points - 1;
                inner += inner_points - 1;
            }
        }
        outer
    }
}

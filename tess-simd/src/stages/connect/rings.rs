//! Ring by ring, edge by edge: the stitches that triangle and quad patches share
//! (spec section 7.1); and the same stitches in the vertex-cache order, column by column.
//!
//! # Data
//!
//! Row 0 has the points of the outer edges, row `ring` those of a ring. The rows follow each other
//! in the patch's points, and in a row its edges; neighbours share a corner. Two numbers of points
//! therefore place every side of a stitch.
//!
//! ```text
//! points   [ row 0: edge 0 | edge 1 | ... ][ row 1: edge 0 | edge 1 | ... ][ row 2 ...
//!            starts[0]                       starts[1]        ^ at[1], before edge 1
//!
//! stitch of ring 1 along edge 1: outer side from at[0], inner side from at[1]
//! ```
//!
//! # The vertex-cache order
//!
//! It goes along each edge in columns, and in a column from the outer row inwards, so that it takes
//! a few triangles of each stitch at a time ([`CacheOrder`]). A run of a stitch's triangles is a
//! part of the stitch's codes, and both sides keep their first indices: no triangle has to be made
//! before its turn.
//!
//! # The simpler form
//!
//! All indices in the specification's order first, then a copy of each run from there: `worst` took
//! 2.4 times as long as in the specification's order, of which making the first copy was a third
//! (`docs/experiments.md`).

use crate::data::format::IndexFormat;
use crate::data::writer::Writer;
use crate::stages::stitch::{CODES_AT_ONCE, Codes, Replaced, Rows, Stitches};
use tess_core::Order;
use tess_core::cache_order::CacheOrder;

/// The most rows: the outer edges, and 32 rings.
const ROWS: usize = 33;

/// Indices of a column that are written at a time: it has as many of a ring's stitch.
const COLUMN_AT_ONCE: usize = 24;

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

/// The first indices of both sides of a stitch, and of the rows that they belong to.
#[derive(Clone, Copy, Debug)]
struct Sides {
    outer: u32,
    inner: u32,
    outer_start: u32,
    inner_start: u32,
}

impl<const EDGES: usize> Rings<EDGES> {
    /// Emits the stitches of all rings of a patch whose first point is number `base`; returns the
    /// first index of the innermost ring, modulo 2^32.
    #[inline(always)]
    pub(super) fn emit<I: IndexFormat>(
        &self,
        (stitches, order): (&Stitches, Order),
        base: u32,
        out: &mut Writer<'_, I>,
    ) -> u32 {
        match order {
            Order::Specification => self.emit_by_rings(stitches, base, out),
            Order::VertexCache => self.emit_by_columns(stitches, base, out),
        }
    }

    #[inline(always)]
    fn emit_by_rings<I: IndexFormat>(
        &self,
        stitches: &Stitches,
        base: u32,
        out: &mut Writer<'_, I>,
    ) -> u32 {
        let mut outer = base;
        let mut inner = base.wrapping_add(self.length(0));
        for ring in 1..self.end() {
            let (outer_start, inner_start) = (outer, inner);
            for edge in 0..EDGES {
                let sides = Sides { outer, inner, outer_start, inner_start };
                let codes = self.codes(stitches, ring, edge);
                self.emit_stitch::<_, CODES_AT_ONCE>((ring, edge), codes, sides, out);
                outer = outer.wrapping_add(self.points(ring - 1, edge) - 1);
                inner = inner.wrapping_add(self.points(ring, edge) - 1);
            }
        }
        outer
    }

    #[inline(always)]
    fn emit_by_columns<I: IndexFormat>(
        &self,
        stitches: &Stitches,
        base: u32,
        out: &mut Writer<'_, I>,
    ) -> u32 {
        let end = self.end();
        // Edges 0 and 2 run along v, edge 1 along u.
        let order = CacheOrder::new(self.outer, [self.along[1], self.along[0]]);
        let mut starts = [base; ROWS];
        for row in 1..end {
            let before = starts[row as usize - 1];
            starts[row as usize] = before.wrapping_add(self.length(row - 1));
        }
        // The first index of each row's part along the edge.
        let mut at = starts;
        for edge in 0..EDGES {
            // Looked up once: each stitch has a run in many columns.
            let mut codes = [Codes::NONE; ROWS];
            for ring in 1..end {
                codes[ring as usize] = self.codes(stitches, ring, edge);
            }
            for column in order.columns(edge) {
                for (ring, steps) in order.column(edge, column) {
                    let row = ring as usize % ROWS;
                    let sides = Sides {
                        outer: at[row - 1],
                        inner: at[row],
                        outer_start: starts[row - 1],
                        inner_start: starts[row],
                    };
                    let codes = codes[row].of_steps(steps);
                    self.emit_stitch::<_, COLUMN_AT_ONCE>((ring, edge), codes, sides, out);
                }
            }
            for row in 0..end {
                let at = &mut at[row as usize];
                *at = at.wrapping_add(self.points(row, edge) - 1);
            }
        }
        starts[end as usize - 1]
    }

    /// One more than the number of the innermost ring that has stitches.
    #[inline(always)]
    fn end(&self) -> u32 {
        self.along.iter().map(|points| points.div_ceil(2)).min().unwrap_or(1)
    }

    /// Points of a row along an edge, its two corners included.
    #[inline(always)]
    const fn points(&self, row: u32, edge: usize) -> u32 {
        if row == 0 { self.outer[edge] } else { self.along[edge] - 2 * row }
    }

    /// Points of a whole row.
    #[inline(always)]
    fn length(&self, row: u32) -> u32 {
        (0..EDGES).map(|edge| self.points(row, edge) - 1).sum()
    }

    /// The stitch between a ring and the row outside of it, along an edge.
    #[inline(always)]
    fn codes<'a>(&self, stitches: &'a Stitches, ring: u32, edge: usize) -> Codes<'a> {
        if ring == 1 {
            stitches.transition(self.outer[edge], self.along[edge])
        } else {
            stitches.ring(self.points(ring, edge))
        }
    }

    /// Emits a stitch, or a part of it, in blocks of `N`.
    #[inline(always)]
    fn emit_stitch<I: IndexFormat, const N: usize>(
        &self,
        (ring, edge): (u32, usize),
        codes: Codes<'_>,
        Sides { outer, inner, outer_start, inner_start }: Sides,
        out: &mut Writer<'_, I>,
    ) {
        // A ring that is a row of points is walked back along its second half of edges.
        let walks_back = edge >= 2 && self.row_at[edge] == ring;
        // The last edge ends where the row began.
        let closes = edge == EDGES - 1;
        if !closes && !walks_back {
            return codes.emit_ascending::<_, N>(outer, inner, out);
        }
        let end = |row, index| Some(Replaced { at: self.points(row, edge) - 1, index });
        let rows = Rows {
            outer,
            inner,
            descending: walks_back,
            outer_replaced: if closes { end(ring - 1, outer_start) } else { None },
            inner_replaced: if closes && !walks_back { end(ring, inner_start) } else { None },
        };
        codes.emit::<_, N>(&rows, out);
    }
}

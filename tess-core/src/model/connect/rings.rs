//! Ring by ring, edge by edge: the stitches that triangle and quad patches share
//! (spec section 7.1).

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
        let mut outer_base = 0;
        let mut inner_base = self.outer_points();
        for ring in 1..self.end() {
            let (outer_start, inner_start) = (outer_base, inner_base);
            for (number, edge) in (0..).zip(0..EDGES) {
                let outer_points = self.outer_row_points(ring, edge);
                let inner_points = self.inner_row_points(ring, edge);
                let mut outer = Row::ascending(outer_base);
                let mut inner = Row::ascending(inner_base);
                if self.walks_back(ring, edge) {
                    inner = Row::descending(inner_base);
                }
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

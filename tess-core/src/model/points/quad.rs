//! Quad points: the outer ring, the interior rings, then a row of points if the shorter axis is
//! even (spec section 6).

use crate::model::factor_context::FactorContext;
use crate::model::factors::ProcessedFactor;
use crate::model::fixed_point::{HALF, ONE};
use crate::model::output::DomainPoint;
use crate::model::patch_factors::QuadFactors;
use crate::model::place::place;
use crate::model::sink::Sink;
use crate::model::state::Parity;
use fixed::types::U16F16;

/// The contexts of the two inside factors.
#[derive(Clone, Copy)]
pub(crate) struct Inside<'a> {
    pub(crate) u: &'a FactorContext,
    pub(crate) v: &'a FactorContext,
}

/// The direction of an innermost ring that is a single row of points.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum CentreRow {
    /// Along u at v = 1/2, ascending.
    AlongU,
    /// Along v at u = 1/2, descending.
    AlongV,
}

impl<'a> Inside<'a> {
    pub(crate) const fn new(factors: &'a QuadFactors<ProcessedFactor>) -> Self {
        Self { u: &factors.inside_u.context, v: &factors.inside_v.context }
    }

    /// One more than the number of the last ring that goes round. The ring with this number is a
    /// row of points ([`Self::centre_row`]), or does not exist.
    pub(crate) const fn first_open_ring(&self) -> u32 {
        (if self.u.points < self.v.points { self.u.points } else { self.v.points }) / 2
    }

    /// Points on an edge of interior ring `ring >= 1`, without the last point.
    pub(crate) const fn ring_edge_points(&self, ring: u32, edge: u32) -> u32 {
        let running = if edge.is_multiple_of(2) { self.v } else { self.u };
        running.points - 1 - 2 * ring
    }

    /// The row of points that the interior ends with, if there is one.
    pub(crate) fn centre_row(&self) -> Option<CentreRow> {
        if self.u.points > self.v.points {
            (self.v.parity == Parity::Even).then_some(CentreRow::AlongU)
        } else {
            (self.u.parity == Parity::Even).then_some(CentreRow::AlongV)
        }
    }

    /// Points on the centre row.
    pub(crate) const fn centre_row_points(&self, row: CentreRow) -> u32 {
        let running = match row {
            CentreRow::AlongU => self.u,
            CentreRow::AlongV => self.v,
        };
        running.points - 2 * self.first_open_ring()
    }

    /// Point `p` of an edge of interior ring `ring >= 1`.
    pub(crate) const fn ring_point(&self, ring: u32, edge: u32, p: u32) -> DomainPoint {
        let end_u = self.u.points - 1 - ring;
        let end_v = self.v.points - 1 - ring;
        match edge {
            0 => DomainPoint { u: place(self.u, ring), v: place(self.v, end_v - p) },
            1 => DomainPoint { u: place(self.u, ring + p), v: place(self.v, ring) },
            2 => DomainPoint { u: place(self.u, end_u), v: place(self.v, ring + p) },
            _ => DomainPoint { u: place(self.u, end_u - p), v: place(self.v, end_v) },
        }
    }

    /// Point `p` of the centre row.
    pub(crate) const fn centre_row_point(&self, row: CentreRow, p: u32) -> DomainPoint {
        const MIDDLE: U16F16 = U16F16::from_bits(HALF);
        let ring = self.first_open_ring();
        match row {
            CentreRow::AlongU => DomainPoint { u: place(self.u, ring + p), v: MIDDLE },
            CentreRow::AlongV => {
                DomainPoint { u: MIDDLE, v: place(self.v, self.v.points - 1 - ring - p) }
            }
        }
    }
}

pub(crate) fn emit(factors: &QuadFactors<ProcessedFactor>, sink: &mut impl Sink) {
    for (edge, context) in (0..).zip(factors.outer_contexts()) {
        for p in 0..context.points - 1 {
            sink.point(outer_point(context, edge, p));
        }
    }
    let inside = Inside::new(factors);
    for ring in 1..inside.first_open_ring() {
        for edge in 0..4 {
            for p in 0..inside.ring_edge_points(ring, edge) {
                sink.point(inside.ring_point(ring, edge, p));
            }
        }
    }
    if let Some(row) = inside.centre_row() {
        for p in 0..inside.centre_row_points(row) {
            sink.point(inside.centre_row_point(row, p));
        }
    }
}

/// Point `p` of an outer edge with this context.
pub(crate) const fn outer_point(context: &FactorContext, edge: u32, p: u32) -> DomainPoint {
    let mirrored = context.points - 1 - p;
    match edge {
        0 => DomainPoint::from_bits(0, place(context, mirrored).to_bits()),
        1 => DomainPoint::from_bits(place(context, p).to_bits(), 0),
        2 => DomainPoint::from_bits(ONE, place(context, p).to_bits()),
        _ => DomainPoint::from_bits(place(context, mirrored).to_bits(), ONE),
    }
}

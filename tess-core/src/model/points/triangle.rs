//! Triangle points: the outer ring, then the interior rings, then the centre (spec section 6).

use crate::model::factor_context::FactorContext;
use crate::model::factors::ProcessedFactor;
use crate::model::fixed_point::{HALF, ONE, ONE_THIRD, TWO_THIRDS};
use crate::model::output::DomainPoint;
use crate::model::patch_factors::TriangleFactors;
use crate::model::place::place;
use crate::model::sink::Sink;
use crate::model::state::Parity;

/// The point that ends an interior of even parity.
pub(crate) const CENTRE: DomainPoint = DomainPoint::from_bits(ONE_THIRD, ONE_THIRD);

pub(crate) fn emit(factors: &TriangleFactors<ProcessedFactor>, sink: &mut impl Sink) {
    for (edge, context) in (0..).zip(factors.outer_contexts()) {
        for p in 0..context.points - 1 {
            sink.point(outer_point(context, edge, p));
        }
    }
    let inside = &factors.inside.context;
    for ring in 1..inside.points / 2 {
        for edge in 0..3 {
            for p in 0..ring_edge_points(inside, ring) {
                sink.point(ring_point(inside, ring, edge, p));
            }
        }
    }
    if inside.parity == Parity::Even {
        sink.point(CENTRE);
    }
}

/// Points on each edge of interior ring `ring >= 1`, without the last point, which is the next
/// edge's first.
pub(crate) const fn ring_edge_points(inside: &FactorContext, ring: u32) -> u32 {
    inside.points - 1 - 2 * ring
}

/// Point `p` of an outer edge with this context.
pub(crate) const fn outer_point(context: &FactorContext, edge: u32, p: u32) -> DomainPoint {
    let mirrored = context.points - 1 - p;
    match edge {
        0 => DomainPoint::from_bits(0, place(context, mirrored).to_bits()),
        1 => DomainPoint::from_bits(place(context, p).to_bits(), 0),
        _ => {
            let q = place(context, mirrored).to_bits();
            DomainPoint::from_bits(q, ONE - q)
        }
    }
}

/// Point `p` of an edge of interior ring `ring >= 1`.
///
/// The ring's distance from the patch's edges is two thirds of its place in one dimension, so
/// locations along an edge move back by half of that distance: `shift`. No overflow: places are at
/// most `ONE`, and their product with `TWO_THIRDS` is below 2^32. No underflow: the place of any
/// point of the ring is at least the ring's own place, and `shift` is about a third of that.
pub(crate) const fn ring_point(
    inside: &FactorContext,
    ring: u32,
    edge: u32,
    p: u32,
) -> DomainPoint {
    let end = inside.points - 1 - ring;
    let perpendicular = (place(inside, ring).to_bits() * TWO_THIRDS + HALF) >> 16;
    let shift = perpendicular.div_ceil(2);
    let along = if edge == 1 { ring + p } else { end - p };
    let q = place(inside, along).to_bits() - shift;
    match edge {
        0 => DomainPoint::from_bits(perpendicular, q),
        1 => DomainPoint::from_bits(q, perpendicular),
        _ => DomainPoint::from_bits(q, ONE - q - perpendicular),
    }
}

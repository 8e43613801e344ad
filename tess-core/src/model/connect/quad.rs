//! The triangles of a quad patch (spec section 7).

use crate::model::connect::rings::{Rings, row_ring};
use crate::model::factors::ProcessedFactor;
use crate::model::patch_factors::QuadFactors;
use crate::model::points::quad::Inside;
use crate::model::row::Row;
use crate::model::state::Parity;
use crate::model::stitch::{Diagonals, Stitch, StitchKind};

/// The rings of a quad patch: edges u = 0 and u = 1 run along v, the others along u.
pub(crate) fn rings(factors: &QuadFactors<ProcessedFactor>) -> Rings<'_, 4> {
    let Inside { u, v } = Inside::new(factors);
    let (row_along_v, row_along_u) = (row_ring(u), row_ring(v));
    Rings {
        outer: factors.outer_contexts(),
        along: [v, u, v, u],
        row_at: [row_along_v, row_along_u, row_along_v, row_along_u],
    }
}

/// Sends the stitches of a quad patch to `emit`, in order.
pub(crate) fn emit(factors: &QuadFactors<ProcessedFactor>, mut emit: impl FnMut(Stitch)) {
    let innermost = rings(factors).emit(&mut emit);
    if let Some(strip) = centre_strip(&Inside::new(factors), innermost) {
        emit(strip);
    }
}

/// The strip of quads between the two long sides of an innermost ring, if the shorter axis is odd;
/// `innermost` is the ring's first index. Spec section 7.4.
fn centre_strip(inside: &Inside<'_>, innermost: u32) -> Option<Stitch> {
    let (u, v) = (inside.u, inside.v);
    let along_u = u.points > v.points;
    let (long, short) = if along_u { (u, v) } else { (v, u) };
    if short.parity == Parity::Even {
        return None;
    }
    let quads = 2 * (long.points / 2 - short.points / 2) + 2 - long.parity.odd();
    let (outer, inner, diagonals) = if along_u {
        let b = Row::descending(innermost + 2 * quads + 2).with(0, innermost);
        (Row::ascending(innermost + 1), b, Diagonals::Forward)
    } else {
        let diagonals = match long.parity {
            Parity::Even => Diagonals::Forward,
            Parity::Odd => Diagonals::ForwardExceptMiddle,
        };
        (Row::ascending(innermost), Row::descending(innermost + 2 * quads + 1), diagonals)
    };
    let (kind, points) = (StitchKind::Centre(diagonals), quads + 1);
    Some(Stitch { kind, outer, outer_points: points, inner, inner_points: points })
}

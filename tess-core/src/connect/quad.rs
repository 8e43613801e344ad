//! The triangles of a quad patch (spec section 7).

use crate::connect::rings::{OnRows, Rings, row_ring};
use crate::factors::ProcessedFactor;
use crate::patch_factors::QuadFactors;
use crate::points::quad::Inside;
use crate::row::Row;
use crate::state::{Config, Parity};
use crate::stitch::{self, Diagonals, Triangle};

/// The rings of a quad patch: edges u = 0 and u = 1 run along v, the others along u.
pub(crate) fn rings(factors: &QuadFactors<ProcessedFactor>) -> Rings<4> {
    let Inside { u, v } = Inside::new(factors);
    let (row_along_v, row_along_u) = (row_ring(&u), row_ring(&v));
    Rings {
        outer: factors.outer().map(|factor| factor.context),
        along: [v, u, v, u],
        row_at: [row_along_v, row_along_u, row_along_v, row_along_u],
    }
}

pub(crate) fn emit(
    config: Config,
    factors: &QuadFactors<ProcessedFactor>,
    mut emit: impl FnMut(Triangle),
) {
    let innermost = rings(factors).emit(config.split, &mut emit);
    let strip = CentreStrip::new(&Inside::new(factors), innermost);
    if let Some(CentreStrip { a, b, quads, diagonals }) = strip {
        stitch::strip(quads, diagonals, OnRows { outer: a, inner: b, emit });
    }
}

/// The strip of quads between the two long sides of an innermost ring. Spec section 7.4.
struct CentreStrip {
    a: Row,
    b: Row,
    quads: u32,
    diagonals: Diagonals,
}

impl CentreStrip {
    /// The strip, if the shorter axis is odd; `innermost` is the first index of the ring around it.
    fn new(inside: &Inside, innermost: u32) -> Option<Self> {
        let (u, v) = (inside.u, inside.v);
        let along_u = u.points > v.points;
        let (long, short) = if along_u { (u, v) } else { (v, u) };
        if short.parity == Parity::Even {
            return None;
        }
        let quads = 2 * (long.points / 2 - short.points / 2) + 2 - long.parity.odd();
        Some(if along_u {
            Self {
                a: Row::ascending(innermost + 1),
                b: Row::descending(innermost + 2 * quads + 2).with(0, innermost),
                quads,
                diagonals: Diagonals::Forward,
            }
        } else {
            Self {
                a: Row::ascending(innermost),
                b: Row::descending(innermost + 2 * quads + 1),
                quads,
                diagonals: match long.parity {
                    Parity::Even => Diagonals::Forward,
                    Parity::Odd => Diagonals::ForwardExceptMiddle,
                },
            }
        })
    }
}

//! The triangles of a triangle patch (spec section 7).

use crate::connect::rings::Rings;
use crate::factors::ProcessedFactor;
use crate::patch_factors::TriangleFactors;
use crate::state::{Config, Parity};
use crate::stitch::Triangle;

/// The rings of a triangle patch. None of them is a row of points: the innermost ring of an even
/// inside factor is a single point.
pub(crate) fn rings(factors: &TriangleFactors<ProcessedFactor>) -> Rings<3> {
    Rings {
        outer: factors.outer().map(|factor| factor.context),
        along: [factors.inside.context; 3],
        row_at: [None; 3],
    }
}

pub(crate) fn emit(
    config: Config,
    factors: &TriangleFactors<ProcessedFactor>,
    mut emit: impl FnMut(Triangle),
) {
    let innermost = rings(factors).emit(config.split, &mut emit);
    if factors.inside.context.parity == Parity::Odd {
        emit([innermost, innermost + 1, innermost + 2]);
    }
}

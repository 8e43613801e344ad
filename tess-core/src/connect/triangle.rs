//! The triangles of a triangle patch (spec section 7).

use crate::connect::rings::Rings;
use crate::factors::ProcessedFactor;
use crate::patch_factors::TriangleFactors;
use crate::state::Parity;
use crate::stitch::{Stitch, Triangle};

/// The rings of a triangle patch. None of them is a row of points: the innermost ring of an even
/// inside factor is a single point.
pub(crate) fn rings(factors: &TriangleFactors<ProcessedFactor>) -> Rings<'_, 3> {
    Rings {
        outer: factors.outer_contexts(),
        along: [&factors.inside.context; 3],
        row_at: [None; 3],
    }
}

/// Sends the stitches of a triangle patch to `emit`, in order; returns the triangle inside the
/// innermost ring, which an odd inside factor has.
pub(crate) fn emit(
    factors: &TriangleFactors<ProcessedFactor>,
    emit: impl FnMut(Stitch),
) -> Option<Triangle> {
    let innermost = rings(factors).emit(emit);
    let is_odd = factors.inside.context.parity == Parity::Odd;
    is_odd.then_some([innermost, innermost + 1, innermost + 2])
}

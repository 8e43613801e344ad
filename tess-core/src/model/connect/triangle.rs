//! The triangles of a triangle patch (spec section 7).

use crate::model::connect::rings::Rings;
use crate::model::factors::ProcessedFactor;
use crate::model::patch_factors::TriangleFactors;
use crate::model::state::Parity;
use crate::model::stitch::Stitch;

/// The rings of a triangle patch. None of them is a row of points: the innermost ring of an even
/// inside factor is a single point.
pub(crate) fn rings(factors: &TriangleFactors<ProcessedFactor>) -> Rings<'_, 3> {
    Rings {
        outer: factors.outer_contexts(),
        along: [&factors.inside.context; 3],
        row_at: [None; 3],
    }
}

/// Sends the stitches of a triangle patch to `emit`, in order.
pub(crate) fn emit(factors: &TriangleFactors<ProcessedFactor>, mut emit: impl FnMut(Stitch)) {
    let innermost = rings(factors).emit(&mut emit);
    if factors.inside.context.parity == Parity::Odd {
        emit(Stitch::centre_triangle(innermost));
    }
}

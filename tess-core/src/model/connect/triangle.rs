//! The triangles of a triangle patch (spec section 7).

use crate::model::connect::rings::Rings;
use crate::model::factors::ProcessedFactor;
use crate::model::patch_factors::TriangleFactors;
use crate::model::row::Row;
use crate::model::state::Parity;
use crate::model::stitch::{Stitch, StitchKind};

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
        emit(centre_triangle(innermost));
    }
}

/// The innermost ring of an odd inside factor, a single triangle; `innermost` is its first index.
/// Spec section 7.4.
const fn centre_triangle(innermost: u32) -> Stitch {
    Stitch {
        kind: StitchKind::CentreTriangle,
        outer: Row::ascending(innermost),
        outer_points: 2,
        inner: Row::ascending(innermost + 2),
        inner_points: 1,
    }
}

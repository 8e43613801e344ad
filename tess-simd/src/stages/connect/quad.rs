//! The triangles of a quad patch (spec section 7).

use super::rings::Rings;
use crate::data::format::IndexFormat;
use crate::data::lanes::{EdgePoints, is_odd};
use crate::data::writer::Writer;
use crate::stages::stitch::{CODES_AT_ONCE, Replaced, Rows, Stitches};
use tess_core::Order;
use tess_core::stitch::Diagonals;

/// Emits the triangles. Edges u = 0 and u = 1 run along v, the others along u.
#[inline(always)]
pub(super) fn emit<I: IndexFormat>(
    &[u0, v0, u1, v1, n_u, n_v]: &EdgePoints,
    (stitches, order): (&Stitches, Order),
    base: u32,
    out: &mut Writer<'_, I>,
) {
    let (row_along_v, row_along_u) = (row_ring(n_u), row_ring(n_v));
    let rings = Rings {
        outer: [u0, v0, u1, v1],
        along: [n_v, n_u, n_v, n_u],
        row_at: [row_along_v, row_along_u, row_along_v, row_along_u],
    };
    let innermost = rings.emit((stitches, order), base, out);
    let along_u = n_u > n_v;
    let (long, short) = if along_u { (n_u, n_v) } else { (n_v, n_u) };
    if !is_odd(short) {
        return;
    }
    let quads = 2 * (long / 2 - short / 2) + 2 - u32::from(is_odd(long));
    if along_u {
        let rows = strip_rows(innermost.wrapping_add(1), quads, Some(innermost));
        stitches.strip(quads, Diagonals::Forward).emit::<_, CODES_AT_ONCE>(&rows, out);
    } else {
        let rows = strip_rows(innermost, quads, None);
        let diagonals =
            if is_odd(long) { Diagonals::ForwardExceptMiddle } else { Diagonals::Forward };
        stitches.strip(quads, diagonals).emit::<_, CODES_AT_ONCE>(&rows, out);
    }
}

/// The ring that is a single row of points because of this inside factor's even parity; 0 if odd.
#[inline(always)]
fn row_ring(points: u32) -> u32 {
    if is_odd(points) { 0 } else { points.div_ceil(2) - 1 }
}

/// The two sides of a centre strip (spec section 7.4). Row A runs up from its first index. Row B
/// runs down and ends next to row A's first entry; its first entry may be replaced.
#[inline(always)]
fn strip_rows(first: u32, quads: u32, first_of_b: Option<u32>) -> Rows {
    Rows {
        outer: first,
        inner: first.wrapping_add(2 * quads + 1),
        descending: true,
        outer_replaced: None,
        inner_replaced: first_of_b.map(|index| Replaced { at: 0, index }),
    }
}

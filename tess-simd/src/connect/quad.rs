//! The triangles of a quad patch (spec section 7).

use super::rings::Rings;
use crate::format::IndexFormat;
use crate::lanes::{EdgePoints, is_odd};
use crate::stitch::{Codes, Replaced, Rows, Stitches, Strip};
use crate::writer::Writer;

/// Edges u = 0 and u = 1 run along v, the others along u.
#[inline(always)]
pub(super) fn emit<I: IndexFormat>(
    &[u0, v0, u1, v1, n_u, n_v]: &EdgePoints,
    stitches: &Stitches,
    base: u32,
    out: &mut Writer<'_, I>,
) {
    let (row_along_v, row_along_u) = (row_ring(n_u), row_ring(n_v));
    let rings = Rings {
        outer: [u0, v0, u1, v1],
        along: [n_v, n_u, n_v, n_u],
        row_at: [row_along_v, row_along_u, row_along_v, row_along_u],
    };
    let innermost = rings.emit(stitches, base, out);
    if n_u > n_v {
        if is_odd(n_v) {
            let quads = 2 * (n_u / 2 - n_v / 2) + 2 - u32::from(is_odd(n_u));
            strip_along_u(stitches, quads, innermost, out);
        }
    } else if is_odd(n_u) {
        let quads = 2 * (n_v / 2 - n_u / 2) + 2 - u32::from(is_odd(n_v));
        strip_along_v(stitches, quads, is_odd(n_v), innermost, out);
    }
}

/// The ring that is a single row of points because of this inside factor's even parity; 0 if odd.
#[inline(always)]
fn row_ring(points: u32) -> u32 {
    if is_odd(points) { 0 } else { points.div_ceil(2) - 1 }
}

/// The strip inside a ring that is longer along u (spec section 7.4).
#[inline(always)]
fn strip_along_u<I: IndexFormat>(
    stitches: &Stitches,
    quads: u32,
    innermost: u32,
    out: &mut Writer<'_, I>,
) {
    let rows = Rows {
        outer: innermost.wrapping_add(1),
        inner: innermost.wrapping_add(2 * quads + 2),
        descending: true,
        outer_replaced: None,
        inner_replaced: Some(Replaced { at: 0, index: innermost }),
    };
    stitches.strip(Strip::Forward, 0..quads).emit(&rows, out);
}

/// The strip inside a ring that is not: where both factors are odd, the diagonals are mirrored but
/// for the middle one.
#[inline(always)]
fn strip_along_v<I: IndexFormat>(
    stitches: &Stitches,
    quads: u32,
    mirrored: bool,
    innermost: u32,
    out: &mut Writer<'_, I>,
) {
    let rows = Rows {
        outer: innermost,
        inner: innermost.wrapping_add(2 * quads + 1),
        descending: true,
        outer_replaced: None,
        inner_replaced: None,
    };
    let mut emit = |quads: Codes<'_>| quads.emit(&rows, out);
    if mirrored {
        let middle = quads / 2;
        emit(stitches.strip(Strip::Mirrored, 0..middle));
        emit(stitches.strip(Strip::Middle, middle..middle + 1));
        emit(stitches.strip(Strip::Mirrored, middle + 1..quads));
    } else {
        emit(stitches.strip(Strip::Forward, 0..quads));
    }
}

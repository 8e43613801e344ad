//! The triangles of a triangle patch (spec section 7).

use super::rings::Rings;
use crate::data::format::IndexFormat;
use crate::data::lanes::{EdgePoints, is_odd};
use crate::data::writer::Writer;
use crate::stages::stitch::Stitches;
use tess_core::stitch::centre_triangle;
use tess_core::{Order, OutputPrimitive};

/// Emits the triangles. The innermost ring of an even inside factor is a single point, not a row of
/// points.
#[inline(always)]
pub(super) fn emit<I: IndexFormat>(
    &[u0, v0, w0, inside, ..]: &EdgePoints,
    (stitches, order): (&Stitches, Order),
    base: u32,
    output: OutputPrimitive,
    out: &mut Writer<'_, I>,
) {
    let rings = Rings { outer: [u0, v0, w0], along: [inside; 3], row_at: [0; 3] };
    let innermost = rings.emit((stitches, order), base, out);
    if is_odd(inside) {
        let [a, b, c] = centre_triangle(innermost).map(I::wrapping_from);
        let clockwise = output == OutputPrimitive::TriangleCw;
        out.put(if clockwise { [a, b, c] } else { [a, c, b] });
    }
}

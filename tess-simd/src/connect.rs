//! The primitives of a patch, in order (spec sections 7 and 8).

mod quad;
mod rings;
mod triangle;

use crate::emit::Writer;
use crate::format::IndexFormat;
use crate::lanes::EdgePoints;
use crate::stitch::Stitches;
use tess_core::{Domain, OutputPrimitive};

/// Indices written at a time.
const STEP: usize = 16;

/// Emits the indices of a regular patch with `points` points, the first of them `base`.
#[inline(always)]
pub(crate) fn emit<I: IndexFormat>(
    (domain, output): (Domain, OutputPrimitive),
    edges: &EdgePoints,
    stitches: &Stitches,
    (base, points): (u32, u32),
    out: &mut Writer<'_, I>,
) {
    match (domain, output) {
        (_, OutputPrimitive::Point) => sequence(base, points, out),
        (Domain::Isoline, _) => {
            let &[density, detail, ..] = edges;
            for line in 0..density - 1 {
                chain(base + line * detail, detail, out);
            }
        }
        (_, OutputPrimitive::Line) => chain(base, points, out),
        (Domain::Triangle, _) => triangle::emit(edges, stitches, base, output, out),
        (Domain::Quad, _) => quad::emit(edges, stitches, base, out),
    }
}

/// Emits all indices in order.
#[inline(always)]
fn sequence<I: IndexFormat>(base: u32, points: u32, out: &mut Writer<'_, I>) {
    out.count::<STEP>(points as usize, |number| I::wrapping_from(base.wrapping_add(number)));
}

/// Emits the lines that join points in order.
#[inline(always)]
fn chain<I: IndexFormat>(base: u32, points: u32, out: &mut Writer<'_, I>) {
    let indices = 2 * (points as usize).saturating_sub(1);
    out.count::<STEP>(indices, |number| {
        I::wrapping_from(base.wrapping_add(number / 2 + number % 2))
    });
}

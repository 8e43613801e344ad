//! The primitives of a patch, in order (spec sections 7 and 8).
//!
//! Vertex indices are modulo 2^32: the one after the largest is 0 instead of an overflow.

mod quad;
mod rings;
mod triangle;

use crate::data::format::IndexFormat;
use crate::data::writer::Writer;
use crate::stages::packet::PacketPatch;
use crate::stages::settings::Settings;
use tess_core::{Domain, OutputPrimitive};

/// Indices written at a time.
const INDICES_AT_ONCE: usize = 16;

/// Emits the indices of a regular patch whose first point is number `base`, triangles in the order
/// of the settings.
#[inline(always)]
pub(crate) fn emit<I: IndexFormat>(
    settings: &Settings,
    patch: PacketPatch<'_>,
    base: u32,
    out: &mut Writer<'_, I>,
) {
    let Settings { config, order, stitches } = settings;
    let how = (&**stitches, *order);
    let edges = &patch.edges();
    match (patch.domain(), config.output) {
        (_, OutputPrimitive::Point) => sequence(base, patch.points(), out),
        (Domain::Isoline, _) => {
            let &[density, detail, ..] = edges;
            for line in 0..density - 1 {
                chain(base.wrapping_add(line * detail), detail, out);
            }
        }
        (_, OutputPrimitive::Line) => chain(base, patch.points(), out),
        (Domain::Triangle, output) => triangle::emit(edges, how, base, output, out),
        (Domain::Quad, _) => quad::emit(edges, how, base, out),
    }
}

/// Emits all indices in order.
#[inline(always)]
fn sequence<I: IndexFormat>(base: u32, points: u32, out: &mut Writer<'_, I>) {
    out.count::<INDICES_AT_ONCE>(points as usize, |number| {
        I::wrapping_from(base.wrapping_add(number))
    });
}

/// Emits the lines that join points in order.
#[inline(always)]
fn chain<I: IndexFormat>(base: u32, points: u32, out: &mut Writer<'_, I>) {
    let indices = 2 * (points as usize).saturating_sub(1);
    out.count::<INDICES_AT_ONCE>(indices, |number| {
        I::wrapping_from(base.wrapping_add(number / 2 + number % 2))
    });
}

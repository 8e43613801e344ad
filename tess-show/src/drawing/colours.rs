//! The colours of drawings.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "mixing colours"
)]

use crate::picture::Colour;
use tess_core::PrimitiveOrigin;

/// The colour of edges and numbers.
pub(super) const INK: Colour = Colour(0x26, 0x32, 0x38);
/// The colour of the ground, and of the plates behind numbers.
pub(super) const PAPER: Colour = Colour(0xff, 0xff, 0xff);
/// The colour of the domain's outline.
pub(super) const GRID: Colour = Colour(0xb0, 0xbe, 0xc5);
/// The colour of triangles when colours have no meaning.
pub(super) const PLAIN: Colour = Colour(0xdc, 0xe9, 0xf5);
/// The colour of points.
pub(super) const POINT: Colour = Colour(0x15, 0x5f, 0xa0);
/// The colour of elements that differ.
pub(super) const DIFFERENT: Colour = Colour(0xd5, 0x1f, 0x1f);
/// The colour of the inside of primitives that differ.
pub(super) const DIFFERENT_FILL: Colour = Colour(0xf8, 0xc8, 0xc8);

/// The colours from the first primitive to the last: blue, green and yellow, light enough for ink.
const SCALE: [Colour; 5] = [
    Colour(0x7d, 0x9b, 0xe0),
    Colour(0x6f, 0xc1, 0xd8),
    Colour(0x86, 0xd7, 0xa4),
    Colour(0xcf, 0xe3, 0x7c),
    Colour(0xfb, 0xd7, 0x5c),
];

/// The colour of element `t` of `count` on the scale.
pub(super) fn along_scale(t: usize, count: usize) -> Colour {
    let position = t as f64 / count.saturating_sub(1).max(1) as f64 * (SCALE.len() - 1) as f64;
    let low = (position as usize).min(SCALE.len() - 2);
    mix(SCALE[low], SCALE[low + 1], position - low as f64)
}

fn mix(from: Colour, to: Colour, part: f64) -> Colour {
    let channel = |from: u8, to: u8| {
        (f64::from(from) + (f64::from(to) - f64::from(from)) * part).round() as u8
    };
    Colour(channel(from.0, to.0), channel(from.1, to.1), channel(from.2, to.2))
}

/// The colour of a triangle by its origin: transitions stand out, rings alternate, and the centre
/// has its own. Minimum patches, and outputs other than triangles, have no rings.
pub(super) const fn of_ring(origin: Option<PrimitiveOrigin>) -> Colour {
    match origin {
        Some(PrimitiveOrigin::Transition { edge, .. }) if edge % 2 == 0 => Colour(0xf6, 0xc2, 0x8b),
        Some(PrimitiveOrigin::Transition { .. }) => Colour(0xfb, 0xdc, 0xb4),
        Some(PrimitiveOrigin::Ring { ring, .. }) if ring % 2 == 0 => Colour(0xa9, 0xcc, 0xe8),
        Some(PrimitiveOrigin::Ring { .. }) => Colour(0xd3, 0xe6, 0xf5),
        Some(PrimitiveOrigin::Centre { .. }) => Colour(0xb9, 0xe2, 0xb5),
        _ => PLAIN,
    }
}

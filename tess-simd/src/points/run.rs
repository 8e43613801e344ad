//! A run of points.

use crate::format::PointFormat;
use crate::writer::Writer;

/// Points written at a time.
const STEP: usize = 8;

/// Emits `length` points made from consecutive locations.
#[inline(always)]
pub(super) fn run<P: PointFormat>(
    out: &mut Writer<'_, P>,
    length: u32,
    locations: &[u32],
    point: impl Fn(u32) -> P,
) {
    out.map::<_, STEP>(length as usize, locations, point);
}

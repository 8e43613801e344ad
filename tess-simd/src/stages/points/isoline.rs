//! Isoline points: line by line, from v = 0 (spec section 6).

use super::POINTS_AT_ONCE;
use super::tables::FactorLocations;
use crate::data::format::OutputPoint;
use crate::data::lanes::EdgePoints;
use crate::data::point_writer::PointWriter;

#[inline(always)]
pub(super) fn emit<W: PointWriter>(
    &[density, detail, ..]: &EdgePoints,
    [density_locations, detail_locations, ..]: FactorLocations<'_>,
    out: &mut W,
) {
    for line in 0..density - 1 {
        let v = density_locations.at(line);
        out.map::<_, POINTS_AT_ONCE>(detail as usize, detail_locations.from(0), |u| {
            W::Point::from_bits(u, v)
        });
    }
}

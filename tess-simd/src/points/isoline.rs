//! Isoline points: line by line, from v = 0 (spec section 6).

use super::run::run;
use super::tables::FactorLocations;
use crate::format::PointFormat;
use crate::lanes::EdgePoints;
use crate::writer::Writer;

#[inline(always)]
pub(super) fn emit<P: PointFormat>(
    &[density, detail, ..]: &EdgePoints,
    [density_locations, detail_locations, ..]: FactorLocations<'_>,
    out: &mut Writer<'_, P>,
) {
    for line in 0..density - 1 {
        let v = density_locations.at(line);
        run(out, detail, detail_locations.from(0), |u| P::from_bits(u, v));
    }
}

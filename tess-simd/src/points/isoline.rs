//! Isoline points: line by line, from v = 0 (spec section 6).

use super::{Tables, run};
use crate::emit::Writer;
use crate::format::PointFormat;
use crate::lanes::EdgePoints;

#[inline(always)]
pub(super) fn emit<P: PointFormat>(
    &[density, detail, ..]: &EdgePoints,
    [density_table, detail_table, ..]: Tables<'_>,
    out: &mut Writer<'_, P>,
) {
    for line in 0..density - 1 {
        let v = density_table.at(line);
        run(out, detail, detail_table.from(0), |u| P::from_bits(u, v));
    }
}

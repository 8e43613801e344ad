//! Triangle points: the outer ring, then the interior rings, then the centre (spec section 6).

use super::run::run;
use super::tables::FactorLocations;
use crate::format::PointFormat;
use crate::lanes::{EdgePoints, is_odd};
use crate::writer::Writer;
use tess_core::fixed_point::{HALF, ONE, ONE_THIRD, TWO_THIRDS};

#[inline(always)]
pub(super) fn emit<P: PointFormat>(
    &[u0, v0, w0, inside, ..]: &EdgePoints,
    [u0_locations, v0_locations, w0_locations, inside_locations, ..]: FactorLocations<'_>,
    out: &mut Writer<'_, P>,
) {
    let mirror = |x| ONE.wrapping_sub(x);
    run(out, u0 - 1, u0_locations.from(0), |x| P::from_bits(0, mirror(x)));
    run(out, v0 - 1, v0_locations.from(0), |x| P::from_bits(x, 0));
    run(out, w0 - 1, w0_locations.from(0), |x| P::from_bits(mirror(x), x));
    for ring in 1..inside / 2 {
        let count = inside - 1 - 2 * ring;
        let locations = inside_locations.from(ring);
        let perpendicular = (inside_locations.at(ring).wrapping_mul(TWO_THIRDS) + HALF) >> 16;
        let shift = perpendicular.div_ceil(2);
        // Edges 0 and 2 run from the other end; on edge 2, w = perpendicular.
        let last = ONE - shift;
        let rest = ONE - perpendicular;
        run(out, count, locations, |x| P::from_bits(perpendicular, last.wrapping_sub(x)));
        run(out, count, locations, |x| P::from_bits(x.wrapping_sub(shift), perpendicular));
        run(out, count, locations, |x| {
            let q = last.wrapping_sub(x);
            P::from_bits(q, rest.wrapping_sub(q))
        });
    }
    if !is_odd(inside) {
        out.put([P::from_bits(ONE_THIRD, ONE_THIRD)]);
    }
}

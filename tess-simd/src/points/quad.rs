//! Quad points: the outer ring, the interior rings, then a row of points if one inside factor is
//! even (spec section 6).

use super::run::run;
use super::tables::FactorLocations;
use crate::format::PointFormat;
use crate::lanes::{EdgePoints, is_odd};
use crate::writer::Writer;
use tess_core::fixed_point::{HALF, ONE};

#[inline(always)]
pub(super) fn emit<P: PointFormat>(
    &[u0, v0, u1, v1, n_u, n_v]: &EdgePoints,
    [u0_locations, v0_locations, u1_locations, v1_locations, u_locations, v_locations]: FactorLocations<'_>,
    out: &mut Writer<'_, P>,
) {
    let mirror = |x| ONE.wrapping_sub(x);
    run(out, u0 - 1, u0_locations.from(0), |x| P::from_bits(0, mirror(x)));
    run(out, v0 - 1, v0_locations.from(0), |x| P::from_bits(x, 0));
    run(out, u1 - 1, u1_locations.from(0), |x| P::from_bits(ONE, x));
    run(out, v1 - 1, v1_locations.from(0), |x| P::from_bits(mirror(x), ONE));
    let ring_end = n_u.min(n_v) / 2;
    for ring in 1..ring_end {
        let (count_u, count_v) = (n_u - 1 - 2 * ring, n_v - 1 - 2 * ring);
        let (along_u, along_v) = (u_locations.from(ring), v_locations.from(ring));
        let (first_u, last_u) = (u_locations.at(ring), u_locations.mirrored(ring));
        let (first_v, last_v) = (v_locations.at(ring), v_locations.mirrored(ring));
        run(out, count_v, along_v, |x| P::from_bits(first_u, mirror(x)));
        run(out, count_u, along_u, |x| P::from_bits(x, first_v));
        run(out, count_v, along_v, |x| P::from_bits(last_u, x));
        run(out, count_u, along_u, |x| P::from_bits(mirror(x), last_v));
    }
    if n_u > n_v {
        if !is_odd(n_v) {
            run(out, n_u - 2 * ring_end, u_locations.from(ring_end), |x| P::from_bits(x, HALF));
        }
    } else if !is_odd(n_u) {
        run(out, n_v - 2 * ring_end, v_locations.from(ring_end), |x| P::from_bits(HALF, mirror(x)));
    }
}

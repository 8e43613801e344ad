//! The t-th triangle of the strip inside a quad's innermost ring, from closed forms.

use crate::locate::point::quad_points_before;
use crate::points::quad::Inside;
use crate::state::Parity;
use crate::stitch::Triangle;

/// Triangle `t` of the strip (spec section 7.4); `None` if there is no strip. `innermost` is the
/// first index of the ring around it.
///
/// The ring's points are numbered from 0 around it, so the two long sides are runs of those
/// numbers, one up and one down, that close up modulo the ring's size.
pub(crate) fn triangle(inside: &Inside, innermost: u32, t: u32) -> Option<Triangle> {
    let (u, v) = (inside.u, inside.v);
    let along_u = u.points > v.points;
    let short_parity = if along_u { v.parity } else { u.parity };
    if short_parity == Parity::Even {
        return None;
    }
    let interior = (u.points - 2) * (v.points - 2);
    let size = interior - quad_points_before(inside, u.points.min(v.points) / 2 - 1);
    // Where the strip runs along u, the ring's first point is the end of row B, else that of row A.
    let start = u32::from(along_u);
    let a = |k| innermost + start + k;
    let b = |k| innermost + (size + start - 1 - k) % size;

    let (k, second) = (t / 2, t % 2 == 1);
    let mirrored = !along_u && v.parity == Parity::Odd;
    let is_middle = mirrored && k == (size - 2) / 4;
    Some(match (second, is_middle) {
        (false, true) => [a(k), b(k + 1), b(k)],
        (true, true) => [a(k), a(k + 1), b(k + 1)],
        (false, false) if mirrored => [a(k), a(k + 1), b(k)],
        (false, false) => [b(k), a(k), a(k + 1)],
        (true, false) => [b(k), a(k + 1), b(k + 1)],
    })
}

//! The t-th triangle of the strip inside a quad's innermost ring, from closed forms.
//!
//! Where the shorter inside factor is odd, the innermost ring is two rows of points with nothing
//! between them, and a strip of quads fills it. `locate::rings` asks for one triangle of it.
//!
//! # The data
//!
//! The inside factors 5 and 3 make a ring of 4 by 2 points, the factors 3 and 5 one of 2 by 4. With
//! integer outer factors of 3, both have the indices 12 to 19. Each triangle shows its number `t`:
//!
//! ```text
//!   u longer                            v longer
//!   b(0)                   b(3)         a(0)     b(0)
//!    12 --- 19 --- 18 --- 17             12 --- 19
//!     | \ 1  | \ 3  | \ 5  |              | 0 / 1|
//!     | 0 \  | 2 \  | 4 \  |             13 --- 18
//!    13 --- 14 --- 15 --- 16              | 3 \ 2|      the middle
//!   a(0)                   a(3)          14 --- 17
//!                                         | 4 / 5|
//!                                        15 --- 16
//!                                       a(3)     b(3)
//! ```
//!
//! `a` counts up from the ring's first index, or from its second where the strip runs along u; `b`
//! counts down from the index before `a(0)`, modulo the ring's size.
//!
//! # What holds
//!
//! - `size` is at least 4, the size of the smallest ring that goes round, so `(size - 2) / 4` is
//!   the strip's middle quad.
//! - All diagonals of a strip along u run the same way. A strip along v whose longer factor is odd
//!   has its middle quad's diagonal turned (spec section 7.4).
//! - `t` is below `size - 2`, the number of triangles.
//!
//! The test `the_worked_strips` checks the pictures' numbers.
//!
//! # Why not simpler
//!
//! The sequential form (`model/connect/quad.rs`) walks both rows, one of them backwards. Here a
//! vertex takes one addition and at most one remainder.

use crate::closed_form::locate::point::quad_points_before;
use crate::model::points::quad::Inside;
use crate::model::state::Parity;
use crate::model::stitch::Triangle;

/// Triangle `t` of the strip (spec section 7.4); `None` if there is no strip. `innermost` is the
/// first index of the ring around it.
///
/// The ring's points are numbered from 0 around it, so the two long sides are runs of those
/// numbers, one up and one down, modulo the ring's size.
pub(crate) fn triangle(inside: &Inside<'_>, innermost: u32, t: u32) -> Option<Triangle> {
    let (u, v) = (inside.u, inside.v);
    let along_u = u.points > v.points;
    let short_parity = if along_u { v.parity } else { u.parity };
    if short_parity == Parity::Even {
        return None;
    }
    let interior = (u.points - 2) * (v.points - 2);
    // What the rings outside of the innermost one leave of the interior.
    let size = interior - quad_points_before(inside, u.points.min(v.points) / 2 - 1);
    // The ring's first point begins row B if the strip runs along u, otherwise row A.
    let start = u32::from(along_u);
    let a = |k| innermost + start + k;
    let b = |k| innermost + (size + start - 1 - k) % size;

    // Two triangles for each quad k of the strip.
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

//! The t-th triangle of a stitch, from closed forms.
//!
//! The specification walks a transition position by position; here step `t` is found without the
//! steps before it. `locate::rings` calls this for one triangle.
//!
//! A half edge is a mask with a bit for each of the positions 1..=32, set where the half edge has a
//! point. The number of steps up to a position is then a count of bits. With 3 half steps on the
//! outer edge and 2 on the inner one, ruler order puts points at position 17 (rank 1) of both and
//! at position 9 (rank 2) of the outer edge:
//!
//! ```text
//! bit        31 ........ 16 ....... 8 ........ 0
//! outer       0          1          1          0      positions 9 and 17
//! inner       0          1          0          0      position 17
//!
//! step        0      1      2      3    |  4      5      6      7
//! position    -      9      17     17   |  17     17     9      -
//! advances    outer  outer  inner  outer|  outer  inner  outer  outer
//! ```
//!
//! At each position, the first half takes the inner row's step before the outer row's. The second
//! half mirrors the first: step `t` is the mirror image of step `total - 1 - t`. Between them are
//! the steps of the middle, one for each of the two factors whose parity is odd; this example has
//! none. The test `the_worked_transition` checks the first half's steps.
//!
//! Invariants: `t` is below the stitch's size, which the caller computes from the same counts. The
//! position of a step is the largest one before which at most `t` steps are done; a search of five
//! halvings finds it among 32. A walk would take up to 126 steps.

use crate::model::factor_context::FactorContext;
use crate::model::row::Row;
use crate::model::ruler::has_point;
use crate::model::state::{Parity, SplitOrder};
use crate::model::stitch::{Side, Step, Triangle};

/// The positions of a half edge: bit `k - 1` is set if position `k` in 1..=32 has a point.
#[derive(Clone, Copy)]
struct HalfEdge(u32);

impl HalfEdge {
    fn new(split: SplitOrder, half: u32) -> Self {
        let bits = (1..=32).filter(|&k| has_point(split, k, half)).map(|k| 1 << (k - 1));
        Self(bits.sum())
    }

    /// Points at positions 1..=k, for `k` in 0..=32.
    const fn points_up_to(self, k: u32) -> u32 {
        (self.0 as u64 & ((1 << k) - 1)).count_ones()
    }

    const fn has(self, k: u32) -> bool {
        self.points_up_to(k) > self.points_up_to(k - 1)
    }
}

/// A step of a half: its triangle begins on the row that it advances.
const fn step(advances: Side, outer: u32, inner: u32) -> Step {
    Step { outer, inner, advances, begins: advances }
}

/// Triangle `t` of a transition stitch (spec section 7.2).
///
/// The first half merges two masks in ascending position, and the second half mirrors the first, so
/// a step's number is a count of mask bits.
pub(crate) fn transition_triangle(
    (outer, inner): (&Row, &Row),
    outer_edge: &FactorContext,
    inside: &FactorContext,
    split: SplitOrder,
    t: u32,
) -> Triangle {
    transition_step(outer_edge, inside, split, t).triangle(outer, inner)
}

fn transition_step(
    outer_edge: &FactorContext,
    inside: &FactorContext,
    split: SplitOrder,
    t: u32,
) -> Step {
    let outer = HalfEdge::new(split, outer_edge.visited_positions());
    let inner = HalfEdge::new(split, inside.visited_positions());
    // 1 if there is an outer step from the corner.
    let first = outer_edge.visited_positions().min(1);
    let outer_half = first + outer.points_up_to(32);
    let inner_half = inner.points_up_to(32);
    let half = outer_half + inner_half;
    let total = outer_edge.points + inside.points - 2 - 2; // K + M - 2 with M = n - 2
    if t < half {
        return half_step(outer, inner, first, t);
    }
    if t >= total - half {
        // What a step of the first half has behind it, its mirror image has before it.
        let Step { outer: o, inner: i, advances, .. } =
            half_step(outer, inner, first, total - 1 - t);
        let outer_steps = outer_edge.points - 1;
        let inner_steps = inside.points - 3;
        return match advances {
            Side::Outer => step(advances, outer_steps - 1 - o, inner_steps - i),
            Side::Inner => step(advances, outer_steps - o, inner_steps - 1 - i),
        };
    }
    middle_step(outer_half, inner_half, inside.parity, t - half)
}

/// Step `t` of the first half of a transition.
fn half_step(outer: HalfEdge, inner: HalfEdge, first: u32, t: u32) -> Step {
    if t < first {
        return step(Side::Outer, 0, 0);
    }
    let steps_up_to = |k| first + outer.points_up_to(k) + inner.points_up_to(k);
    // The largest k in 0..32 with steps_up_to(k) <= t, bit by bit; step t happens at k + 1.
    let mut k = 0;
    for more in [16, 8, 4, 2, 1] {
        if steps_up_to(k + more) <= t {
            k += more;
        }
    }
    let (o, i) = (first + outer.points_up_to(k), inner.points_up_to(k));
    let second = t > steps_up_to(k);
    match (inner.has(k + 1), second) {
        (true, false) => step(Side::Inner, o, i),
        (true, true) => step(Side::Outer, o, i + 1),
        (false, _) => step(Side::Outer, o, i),
    }
}

/// Step `t` of the middle, which starts at entries `outer` and `inner` of the rows: the inner row's
/// if the inside factor is odd, then the outer row's. Both begin on the inner row.
const fn middle_step(outer: u32, inner: u32, inside: Parity, t: u32) -> Step {
    let (advances, inner) = match (inside, t) {
        (Parity::Odd, 0) => (Side::Inner, inner),
        (Parity::Odd, _) => (Side::Outer, inner + 1),
        (Parity::Even, _) => (Side::Outer, inner),
    };
    Step { outer, inner, advances, begins: Side::Inner }
}

/// Triangle `t` of a ring stitch whose inner row has `inner_points` points (spec section 7.3).
///
/// The outer row has two points more, one at each end. The first and the last triangle are single;
/// between them each inner segment has a pair of triangles. With 4 inner points:
///
/// ```text
/// outer   o0 --- o1 --- o2 --- o3 --- o4 --- o5       segment p = (t - 1) / 2 of the inner row;
///          \     | \    | \    |    / |     /        if p < 4 / 2, its diagonal runs from o(p+1)
///            \   |   \  |   \  |  /   |   /          to i(p+1), otherwise from i(p) to o(p+2)
/// inner           i0 --- i1 --- i2 --- i3
///
/// t   0         1         2         3         4         5         6         7
///     o0 o1 i0  o1 i1 i0  o1 o2 i1  o2 i2 i1  o2 o3 i2  i2 o3 o4  i2 o4 i3  o4 o5 i3
/// ```
///
/// Invariants: `t` is below `2 * inner_points`, and `inner_points` is at least 1. With 1 inner
/// point, the only triangles are the two ends.
pub(crate) fn ring_triangle((outer, inner): (&Row, &Row), inner_points: u32, t: u32) -> Triangle {
    let last = 2 * inner_points - 1;
    if t == 0 {
        return [outer.index(0), outer.index(1), inner.index(0)];
    }
    if t == last {
        let o = inner_points;
        return [outer.index(o), outer.index(o + 1), inner.index(inner_points - 1)];
    }
    let p = (t - 1) / 2;
    let first_of_pair = t % 2 == 1;
    let [o0, o1] = [outer.index(p + 1), outer.index(p + 2)];
    let [i0, i1] = [inner.index(p), inner.index(p + 1)];
    match (p < inner_points / 2, first_of_pair) {
        (true, true) => [o0, i1, i0],
        (true, false) => [o0, o1, i1],
        (false, true) => [i0, o0, o1],
        (false, false) => [i0, o1, i1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of the head of this file.
    #[test]
    fn the_worked_transition() {
        let [outer, inner] = [3, 2].map(|half| HalfEdge::new(SplitOrder::Ruler, half));
        assert_eq!((outer.0, inner.0), ((1 << 8) | (1 << 16), 1 << 16), "positions 9 and 17");
        let steps = [0, 1, 2, 3].map(|t| half_step(outer, inner, 1, t));
        let expected =
            [(Side::Outer, 0, 0), (Side::Outer, 1, 0), (Side::Inner, 2, 0), (Side::Outer, 2, 1)];
        assert_eq!(steps, expected.map(|(advances, o, i)| step(advances, o, i)), "as in the table");
    }

    /// The triangles of the picture above [`ring_triangle`].
    #[test]
    fn the_worked_ring() {
        let rows = (&Row::ascending(0), &Row::ascending(10));
        let found = [0, 1, 2, 3, 4, 5, 6, 7].map(|t| ring_triangle(rows, 4, t));
        let ends = ([0, 1, 10], [4, 5, 13]);
        let before = [[1, 11, 10], [1, 2, 11], [2, 12, 11], [2, 3, 12]];
        let behind = [[12, 3, 4], [12, 4, 13]];
        let expected = [&[ends.0][..], &before, &behind, &[ends.1]].concat();
        assert_eq!(found[..], expected, "clockwise, outer row from 0, inner row from 10");
    }
}

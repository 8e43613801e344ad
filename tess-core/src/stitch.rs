//! Stitching two rows with triangles (spec sections 7.2 to 7.4).
//!
//! A stitch is a list of steps. Each step is one triangle, clockwise, and moves on by one entry of
//! one of the two rows; which triangle a step is depends on point counts alone, never on the rows.

use crate::row::Row;
use crate::ruler::has_point;
use crate::state::SplitOrder;

/// A triangle's indices, clockwise.
pub(crate) type Triangle = [u32; 3];

/// One of the two rows of a stitch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The row nearer to the patch's edge; row A of a centre strip.
    Outer,
    /// The row nearer to the patch's centre; row B of a centre strip.
    Inner,
}

/// One triangle of a stitch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step {
    /// The entry of the outer row that the stitch has come to.
    pub outer: u32,
    /// The entry of the inner row that the stitch has come to.
    pub inner: u32,
    /// The row that the triangle has two vertices on: this entry and the next.
    pub advances: Side,
    /// The row that the triangle's first vertex lies on.
    pub begins: Side,
}

impl Step {
    /// The three vertices, clockwise: the row that each lies on, and its entry there.
    #[must_use]
    pub const fn vertices(self) -> [(Side, u32); 3] {
        let outer = (Side::Outer, self.outer);
        let inner = (Side::Inner, self.inner);
        let next_outer = (Side::Outer, self.outer + 1);
        let next_inner = (Side::Inner, self.inner + 1);
        match (self.advances, self.begins) {
            (Side::Outer, Side::Outer) => [outer, next_outer, inner],
            (Side::Outer, Side::Inner) => [inner, outer, next_outer],
            (Side::Inner, Side::Outer) => [outer, next_inner, inner],
            (Side::Inner, Side::Inner) => [inner, outer, next_inner],
        }
    }

    /// The triangle on two rows.
    #[must_use]
    pub const fn triangle(self, outer: &Row, inner: &Row) -> [u32; 3] {
        let [a, b, c] = self.vertices();
        [index((outer, inner), a), index((outer, inner), b), index((outer, inner), c)]
    }
}

const fn index((outer, inner): (&Row, &Row), (side, entry): (Side, u32)) -> u32 {
    match side {
        Side::Outer => outer.index(entry),
        Side::Inner => inner.index(entry),
    }
}

/// What a step does, wherever the stitch has come to: the row that it advances along and the row
/// that its triangle begins on.
type Move = (Side, Side);

/// (O\[o\], O\[o + 1\], I\[i\]), then o += 1: "advance outer" of spec section 7.2.
const ADVANCE_OUTER: Move = (Side::Outer, Side::Outer);
/// (I\[i\], O\[o\], I\[i + 1\]), then i += 1: "advance inner" of spec section 7.2.
const ADVANCE_INNER: Move = (Side::Inner, Side::Inner);
/// (I\[i\], O\[o\], O\[o + 1\]), then o += 1.
const ADVANCE_OUTER_FROM_INNER: Move = (Side::Outer, Side::Inner);
/// (O\[o\], I\[i + 1\], I\[i\]), then i += 1.
const ADVANCE_INNER_FROM_OUTER: Move = (Side::Inner, Side::Outer);

/// The steps of these moves, from the first entries of both rows.
fn steps(moves: impl Iterator<Item = Move>) -> impl Iterator<Item = Step> {
    moves.scan((0, 0), |(outer, inner), (advances, begins)| {
        let step = Step { outer: *outer, inner: *inner, advances, begins };
        match advances {
            Side::Outer => *outer += 1,
            Side::Inner => *inner += 1,
        }
        Some(step)
    })
}

/// The transition between an outer edge and the first interior ring, whose factors are unrelated:
/// both half edges are walked in split order. Spec section 7.2.
///
/// `outer_points` and `inside_points` are the `points` of the outer factor's context (2..=65) and
/// of the inside factor's along the same axis (3..=65), whose ring has two points less. There are
/// `outer_points + inside_points - 4` steps.
pub fn transition(
    split: SplitOrder,
    outer_points: u32,
    inside_points: u32,
) -> impl Iterator<Item = Step> {
    let outer_half = outer_points.saturating_sub(1) / 2;
    let inner_half = inside_points.saturating_sub(1) / 2;
    // A factor of odd parity has an even number of points.
    let outer_is_odd = outer_points.is_multiple_of(2);
    let inside_is_odd = inside_points.is_multiple_of(2);
    let outer_at = move |k| has_point(split, k, outer_half).then_some(ADVANCE_OUTER);
    let inner_at = move |k| has_point(split, k, inner_half).then_some(ADVANCE_INNER);

    let corner = (outer_half > 0).then_some(ADVANCE_OUTER);
    let first_half = (1..=32).flat_map(move |k| [inner_at(k), outer_at(k)]);
    let middle =
        [inside_is_odd.then_some(ADVANCE_INNER), outer_is_odd.then_some(ADVANCE_OUTER_FROM_INNER)];
    let second_half = (1..=32).rev().flat_map(move |k| [outer_at(k), inner_at(k)]);
    let moves = [corner].into_iter().chain(first_half).chain(middle);
    steps(moves.chain(second_half).chain([corner]).flatten())
}

/// Two neighbouring interior rings: the outer row has two points more than the inner, which has
/// `inner_points` (1..=61), and the diagonals are mirrored about the middle. Spec section 7.3.
///
/// There are `2 * inner_points` steps.
pub fn ring(inner_points: u32) -> impl Iterator<Item = Step> {
    let pairs = (0..inner_points.saturating_sub(1)).flat_map(move |p| {
        if p < inner_points / 2 {
            [ADVANCE_INNER_FROM_OUTER, ADVANCE_OUTER]
        } else {
            [ADVANCE_OUTER_FROM_INNER, ADVANCE_INNER]
        }
    });
    steps([ADVANCE_OUTER].into_iter().chain(pairs).chain([ADVANCE_OUTER]))
}

/// The diagonals of a centre strip (spec section 7.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Diagonals {
    /// Every quad's runs from row B to row A.
    Forward,
    /// Every quad's runs from row B to row A but that of quad `quads / 2`.
    ForwardExceptMiddle,
}

/// The strip of quads inside an innermost ring: row A is the outer row, row B the inner one, both
/// of `quads + 1` points (`quads` in 1..=63). Spec section 7.4.
///
/// There are `2 * quads` steps.
pub fn strip(quads: u32, diagonals: Diagonals) -> impl Iterator<Item = Step> {
    steps((0..quads).flat_map(move |k| match diagonals {
        Diagonals::Forward => [ADVANCE_OUTER_FROM_INNER, ADVANCE_INNER],
        Diagonals::ForwardExceptMiddle if k == quads / 2 => {
            [ADVANCE_INNER_FROM_OUTER, ADVANCE_OUTER]
        }
        Diagonals::ForwardExceptMiddle => [ADVANCE_OUTER, ADVANCE_INNER],
    }))
}

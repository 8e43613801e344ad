//! Stitching two rows with triangles (spec sections 7.2 to 7.4).
//!
//! A stitch is a sequence of steps. Each step is one triangle, clockwise, and moves on by one entry
//! on one of the two rows. The steps depend only on point counts, never on the entries of the rows.

use crate::model::row::Row;
use crate::model::ruler::{has_point, positions};
use crate::model::state::SplitOrder;

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
    /// The entry of the outer row at which the step begins.
    pub outer: u32,
    /// The entry of the inner row at which the step begins.
    pub inner: u32,
    /// The row that has two of the triangle's vertices: this entry and the next.
    pub advances: Side,
    /// The row of the triangle's first vertex.
    pub begins: Side,
}

impl Step {
    /// The three vertices, clockwise: the row of each, and its entry there.
    #[inline(always)]
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
    #[inline(always)] // a step's kind is a constant where it is made
    #[must_use]
    pub const fn triangle(self, outer: &Row, inner: &Row) -> [u32; 3] {
        let [a, b, c] = self.vertices();
        [index((outer, inner), a), index((outer, inner), b), index((outer, inner), c)]
    }
}

#[inline(always)]
const fn index((outer, inner): (&Row, &Row), (side, entry): (Side, u32)) -> u32 {
    match side {
        Side::Outer => outer.index(entry),
        Side::Inner => inner.index(entry),
    }
}

/// A stitch of a patch: two rows, and the triangles between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stitch {
    /// The stitch's place in the patch, and the rule of its steps.
    pub kind: StitchKind,
    /// The row nearer to the patch's edge; row A of a centre strip.
    pub outer: Row,
    /// Points on the outer row, both ends included.
    pub outer_points: u32,
    /// The row nearer to the patch's centre; row B of a centre strip.
    pub inner: Row,
    /// Points on the inner row, both ends included.
    pub inner_points: u32,
}

/// A stitch's place in the patch, and the rule of its steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StitchKind {
    /// Between an outer edge and ring 1: [`transition`].
    Transition {
        /// Number of the edge: u = 0, v = 0, then w = 0 or u = 1, v = 1.
        edge: u32,
    },
    /// Between an edge of ring `ring - 1` and ring `ring`: [`ring`].
    Ring {
        /// Number of the inner ring, from 2.
        ring: u32,
        /// Number of the edge.
        edge: u32,
    },
    /// Between the two long sides of a quad's innermost ring: [`strip`].
    Centre(Diagonals),
    /// Between an edge and the opposite corner of a triangle patch's innermost ring: one step.
    CentreTriangle,
}

impl Stitch {
    /// The centre triangle of an innermost ring with this first index: the ring's first edge, and
    /// the opposite corner.
    pub(crate) const fn centre_triangle(first: u32) -> Self {
        Self {
            kind: StitchKind::CentreTriangle,
            outer: Row::ascending(first),
            outer_points: 2,
            inner: Row::ascending(first.wrapping_add(2)),
            inner_points: 1,
        }
    }

    /// Sends the steps to `to`, in order.
    pub fn steps(&self, split: SplitOrder, to: impl FnMut(Step)) {
        match self.kind {
            // An edge of ring 1 has two points fewer than the inside factor's context.
            StitchKind::Transition { .. } => {
                transition(split, self.outer_points, self.inner_points + 2, to);
            }
            StitchKind::Ring { .. } => ring(self.inner_points, to),
            StitchKind::Centre(diagonals) => strip(self.outer_points - 1, diagonals, to),
            StitchKind::CentreTriangle => Walk::new(to).advance_outer(Side::Outer),
        }
    }

    /// Sends the triangles, clockwise, to `emit`, in order.
    pub(crate) fn triangles(&self, split: SplitOrder, mut emit: impl FnMut(Triangle)) {
        let Self { outer, inner, .. } = *self;
        self.steps(split, |step| emit(step.triangle(&outer, &inner)));
    }
}

/// The single triangle that is the innermost ring of a triangle patch whose inside factor is odd:
/// its vertices, clockwise, from its first index. Spec section 7.4.
#[must_use]
pub const fn centre_triangle(first: u32) -> [u32; 3] {
    let step = Step { outer: 0, inner: 0, advances: Side::Outer, begins: Side::Outer };
    let Stitch { outer, inner, .. } = Stitch::centre_triangle(first);
    step.triangle(&outer, &inner)
}

/// The progress of a stitch along its two rows, and the receiver of its steps.
struct Walk<F> {
    outer: u32,
    inner: u32,
    to: F,
}

impl<F: FnMut(Step)> Walk<F> {
    const fn new(to: F) -> Self {
        Self { outer: 0, inner: 0, to }
    }

    #[inline(always)]
    fn advance_outer(&mut self, begins: Side) {
        let Self { outer, inner, .. } = *self;
        (self.to)(Step { outer, inner, advances: Side::Outer, begins });
        self.outer += 1;
    }

    #[inline(always)]
    fn advance_inner(&mut self, begins: Side) {
        let Self { outer, inner, .. } = *self;
        (self.to)(Step { outer, inner, advances: Side::Inner, begins });
        self.inner += 1;
    }
}

/// The steps of the transition between an outer edge and the first interior ring. Their factors are
/// unrelated, so the positions of both half edges are merged. Spec section 7.2.
///
/// `outer_points` and `inside_points` are the `points` of the contexts of the outer factor (2..=65)
/// and of the inside factor along the same axis (3..=65); the ring's edge has two points fewer than
/// that. There are `outer_points + inside_points - 4` steps.
pub fn transition(split: SplitOrder, outer_points: u32, inside_points: u32, to: impl FnMut(Step)) {
    let outer_half = outer_points.saturating_sub(1) / 2;
    let inner_half = inside_points.saturating_sub(1) / 2;
    let mut walk = Walk::new(to);
    if outer_half > 0 {
        walk.advance_outer(Side::Outer);
    }
    // The longer half edge has a point wherever the shorter one has.
    let walked = positions(split, inner_half.max(outer_half));
    for k in walked.iter().copied().map(u32::from) {
        if has_point(split, k, inner_half) {
            walk.advance_inner(Side::Inner);
        }
        if has_point(split, k, outer_half) {
            walk.advance_outer(Side::Outer);
        }
    }
    // The middle. A factor of odd parity has an even number of points.
    if inside_points.is_multiple_of(2) {
        walk.advance_inner(Side::Inner);
    }
    if outer_points.is_multiple_of(2) {
        walk.advance_outer(Side::Inner);
    }
    for k in walked.iter().rev().copied().map(u32::from) {
        if has_point(split, k, outer_half) {
            walk.advance_outer(Side::Outer);
        }
        if has_point(split, k, inner_half) {
            walk.advance_inner(Side::Inner);
        }
    }
    if outer_half > 0 {
        walk.advance_outer(Side::Outer);
    }
}

/// The steps between two neighbouring interior rings, along one edge. The inner row has
/// `inner_points` points (1..=61), the outer row two more, and the diagonals are mirrored about the
/// middle. Spec section 7.3.
///
/// There are `2 * inner_points` steps.
pub fn ring(inner_points: u32, to: impl FnMut(Step)) {
    let mut walk = Walk::new(to);
    walk.advance_outer(Side::Outer);
    for p in 0..inner_points.saturating_sub(1) {
        if p < inner_points / 2 {
            walk.advance_inner(Side::Outer);
            walk.advance_outer(Side::Outer);
        } else {
            walk.advance_outer(Side::Inner);
            walk.advance_inner(Side::Inner);
        }
    }
    walk.advance_outer(Side::Outer);
}

/// The diagonals of a centre strip (spec section 7.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Diagonals {
    /// All forward.
    Forward,
    /// All forward, except that of quad `quads / 2`, which runs the other way.
    ForwardExceptMiddle,
}

/// The steps of the strip of quads inside an innermost ring. Row A is the outer row, row B the
/// inner one; both have `quads + 1` points (`quads` in 1..=63). Spec section 7.4.
///
/// There are `2 * quads` steps.
pub fn strip(quads: u32, diagonals: Diagonals, to: impl FnMut(Step)) {
    let mut walk = Walk::new(to);
    for k in 0..quads {
        match diagonals {
            Diagonals::Forward => {
                walk.advance_outer(Side::Inner);
                walk.advance_inner(Side::Inner);
            }
            Diagonals::ForwardExceptMiddle if k == quads / 2 => {
                walk.advance_inner(Side::Outer);
                walk.advance_outer(Side::Outer);
            }
            Diagonals::ForwardExceptMiddle => {
                walk.advance_outer(Side::Outer);
                walk.advance_inner(Side::Inner);
            }
        }
    }
}

//! Stitching two rows with triangles (spec sections 7.2 and 7.3). Triangles are clockwise.

use crate::factor_context::FactorContext;
use crate::row::Row;
use crate::ruler::has_point;
use crate::state::{Parity, SplitOrder};

/// A triangle's indices, clockwise.
pub(crate) type Triangle = [u32; 3];

/// Two rows and how far along each a transition stitch has come.
struct Walk<'a, F> {
    outer: &'a Row,
    inner: &'a Row,
    o: u32,
    i: u32,
    emit: F,
}

impl<F: FnMut(Triangle)> Walk<'_, F> {
    fn advance_outer(&mut self) {
        let Self { outer, inner, o, i, .. } = *self;
        (self.emit)([outer.index(o), outer.index(o + 1), inner.index(i)]);
        self.o += 1;
    }

    fn advance_inner(&mut self) {
        let Self { outer, inner, o, i, .. } = *self;
        (self.emit)([inner.index(i), outer.index(o), inner.index(i + 1)]);
        self.i += 1;
    }

    fn middle(&mut self, inside: Parity, outer_edge: Parity) {
        let Self { outer, inner, o, i, .. } = *self;
        match (inside, outer_edge) {
            (Parity::Odd, Parity::Odd) => {
                (self.emit)([inner.index(i), outer.index(o), inner.index(i + 1)]);
                (self.emit)([inner.index(i + 1), outer.index(o), outer.index(o + 1)]);
                self.i += 1;
                self.o += 1;
            }
            (Parity::Even, Parity::Odd) => {
                (self.emit)([inner.index(i), outer.index(o), outer.index(o + 1)]);
                self.o += 1;
            }
            (Parity::Odd, Parity::Even) => {
                (self.emit)([inner.index(i), outer.index(o), inner.index(i + 1)]);
                self.i += 1;
            }
            (Parity::Even, Parity::Even) => {}
        }
    }
}

/// The transition between an outer edge and the first interior ring, whose factors are unrelated:
/// both half edges are walked in split order. Spec section 7.2.
///
/// `outer_edge` is the outer factor's context, `inside` that of the axis along which the edge runs.
pub(crate) fn transition(
    (outer, inner): (&Row, &Row),
    outer_edge: &FactorContext,
    inside: &FactorContext,
    split: SplitOrder,
    emit: impl FnMut(Triangle),
) {
    let outer_half = outer_edge.half_steps();
    let inner_half = inside.half_steps();
    let mut walk = Walk { outer, inner, o: 0, i: 0, emit };
    if outer_half > 0 {
        walk.advance_outer();
    }
    for k in 1..=32 {
        if has_point(split, k, inner_half) {
            walk.advance_inner();
        }
        if has_point(split, k, outer_half) {
            walk.advance_outer();
        }
    }
    walk.middle(inside.parity, outer_edge.parity);
    for k in (1..=32).rev() {
        if has_point(split, k, outer_half) {
            walk.advance_outer();
        }
        if has_point(split, k, inner_half) {
            walk.advance_inner();
        }
    }
    if outer_half > 0 {
        walk.advance_outer();
    }
}

/// Two neighbouring interior rings: the outer row has two points more than the inner, and the
/// diagonals are mirrored about the middle. Spec section 7.3.
pub(crate) fn ring(
    (outer, inner): (&Row, &Row),
    inner_points: u32,
    mut emit: impl FnMut(Triangle),
) {
    emit([outer.index(0), outer.index(1), inner.index(0)]);
    for p in 0..inner_points - 1 {
        let [o0, o1] = [outer.index(p + 1), outer.index(p + 2)];
        let [i0, i1] = [inner.index(p), inner.index(p + 1)];
        if p < inner_points / 2 {
            emit([o0, i1, i0]);
            emit([o0, o1, i1]);
        } else {
            emit([i0, o0, o1]);
            emit([i0, o1, i1]);
        }
    }
    let [last, end] = [outer.index(inner_points), outer.index(inner_points + 1)];
    emit([last, end, inner.index(inner_points - 1)]);
}

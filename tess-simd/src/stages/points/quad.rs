//! Quad points: the outer ring, the interior rings, then a row of points if one inside factor is
//! even (spec section 6).

use super::{POINTS_AT_ONCE, Runs};
use crate::data::format::OutputPoint;
use crate::data::lanes::{EdgePoints, is_odd};
use crate::data::point_writer::PointWriter;
use tess_core::fixed_point::ONE;

/// The inside factors, by number.
const U: usize = 4;
const V: usize = 5;

/// One coordinate of the points of a run.
#[derive(Clone, Copy, Debug)]
pub(super) enum Coordinate<H> {
    /// The same for all of them.
    Held(H),
    /// The locations that begin here, one for each point.
    Along(AxisPoint),
}

/// A point along a factor's edge or axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisPoint {
    pub(super) factor: usize,
    pub(super) point: u32,
    /// Whether the point is seen from the other end: its location is `ONE` minus the one in the
    /// table.
    pub(super) mirrored: bool,
}

/// The locations of a factor, beginning with point `point`.
pub(super) const fn along<H>(factor: usize, point: u32) -> Coordinate<H> {
    Coordinate::Along(AxisPoint { factor, point, mirrored: false })
}

/// The same, seen from the other end.
pub(super) const fn back<H>(factor: usize, point: u32) -> Coordinate<H> {
    Coordinate::Along(AxisPoint { factor, point, mirrored: true })
}

/// Receives the runs of a quad's points, in order.
pub(super) trait QuadWalker {
    /// A coordinate that all points of a run share.
    type Held: Copy;

    /// A 16.16 number that is the same in every patch: 0 or `ONE`.
    fn fixed(&self, number: u32) -> Coordinate<Self::Held>;

    /// The location of a point.
    fn at(&self, point: AxisPoint) -> Coordinate<Self::Held>;

    /// Receives a run of `length` points. One coordinate is held.
    fn run(&mut self, length: u32, u: Coordinate<Self::Held>, v: Coordinate<Self::Held>);
}

/// Sends the runs of a patch to `walker`, in order.
#[inline(always)]
pub(super) fn walk(&[u0, v0, u1, v1, n_u, n_v]: &EdgePoints, walker: &mut impl QuadWalker) {
    let [zero, one] = [0, ONE].map(|number| walker.fixed(number));
    walker.run(u0 - 1, zero, back(0, 0));
    walker.run(v0 - 1, along(1, 0), zero);
    walker.run(u1 - 1, one, along(2, 0));
    walker.run(v1 - 1, back(3, 0), one);
    // The outer ring is done: each edge without its last point, which begins the next edge. The
    // inner rings run around in the same direction: down v, up u, up v, down u.
    let ring_end = n_u.min(n_v) / 2;
    for ring in 1..ring_end {
        let (count_u, count_v) = (n_u - 1 - 2 * ring, n_v - 1 - 2 * ring);
        let at = |factor, mirrored| AxisPoint { factor, point: ring, mirrored };
        let (first_u, last_u) = (walker.at(at(U, false)), walker.at(at(U, true)));
        let (first_v, last_v) = (walker.at(at(V, false)), walker.at(at(V, true)));
        walker.run(count_v, first_u, back(V, ring));
        walker.run(count_u, along(U, ring), first_v);
        walker.run(count_v, last_u, along(V, ring));
        walker.run(count_u, back(U, ring), last_v);
    }
    // What is left in the middle, if anything, is one row along the longer axis: the shorter axis
    // has an odd number of points, the middle one at HALF. With equal counts it is one point.
    if n_u > n_v {
        if !is_odd(n_v) {
            let half = walker.at(middle(V, n_v));
            walker.run(n_u - 2 * ring_end, along(U, ring_end), half);
        }
    } else if !is_odd(n_u) {
        let half = walker.at(middle(U, n_u));
        walker.run(n_v - 2 * ring_end, half, back(V, ring_end));
    }
}

/// The point in the middle of an axis: at `HALF`.
const fn middle(factor: usize, points: u32) -> AxisPoint {
    AxisPoint { factor, point: points / 2, mirrored: false }
}

impl<W: PointWriter> QuadWalker for Runs<'_, W> {
    type Held = u32;

    #[inline(always)]
    fn fixed(&self, number: u32) -> Coordinate<u32> {
        Coordinate::Held(number)
    }

    #[inline(always)]
    fn at(&self, AxisPoint { factor, point, mirrored }: AxisPoint) -> Coordinate<u32> {
        Coordinate::Held(seen(self.locations[factor].at(point), mirrored))
    }

    #[inline(always)]
    fn run(&mut self, length: u32, u: Coordinate<u32>, v: Coordinate<u32>) {
        match (u, v) {
            (Coordinate::Held(u), Coordinate::Along(AxisPoint { factor, point, mirrored })) => {
                let locations = self.locations[factor].from(point);
                self.out.map::<_, POINTS_AT_ONCE>(length as usize, locations, |x| {
                    W::Point::from_bits(u, seen(x, mirrored))
                });
            }
            (Coordinate::Along(AxisPoint { factor, point, mirrored }), Coordinate::Held(v)) => {
                let locations = self.locations[factor].from(point);
                self.out.map::<_, POINTS_AT_ONCE>(length as usize, locations, |x| {
                    W::Point::from_bits(seen(x, mirrored), v)
                });
            }
            _ => debug_assert!(false, "one coordinate of a run is held"),
        }
    }
}

/// A location, or `ONE` minus it if it is seen from the other end.
#[inline(always)]
const fn seen(x: u32, mirrored: bool) -> u32 {
    if mirrored { ONE.wrapping_sub(x) } else { x }
}

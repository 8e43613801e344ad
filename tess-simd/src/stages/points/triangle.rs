//! Triangle points: the outer ring, then the interior rings, then the centre (spec section 6).

use super::{POINTS_AT_ONCE, Runs};
use crate::data::format::OutputPoint;
use crate::data::lanes::{EdgePoints, is_odd};
use crate::data::point_writer::PointWriter;
use tess_core::fixed_point::{HALF, ONE, ONE_THIRD, TWO_THIRDS};

/// The points of one edge of a ring, without the last one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) edge: usize,
    /// The ring's number, which is also the number of the factor's point that the run begins with.
    pub(super) ring: u32,
    /// The factor that the locations belong to.
    pub(super) factor: usize,
    pub(super) length: u32,
}

/// Receives the runs of a triangle's points, in order.
pub(super) trait TriangleWalker {
    fn run(&mut self, run: Run);
    /// Receives the point in the middle.
    fn centre(&mut self);
}

/// The distance of a ring from the patch's edges, in two coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inset {
    /// The coordinate that is the same along an edge of the ring.
    pub(super) perpendicular: u32,
    /// The amount that the coordinates along an edge lose.
    pub(super) shift: u32,
}

impl Inset {
    /// The inset of the ring whose location along the inside factor is `location`: 0 for the outer
    /// ring. Unspecified for a number that is not a location of half an edge.
    #[inline(always)]
    pub(super) const fn new(location: u32) -> Self {
        let perpendicular = location.wrapping_mul(TWO_THIRDS).wrapping_add(HALF) >> 16;
        Self { perpendicular, shift: perpendicular.div_ceil(2) }
    }
}

/// Sends the runs of a patch to `walker`, in order.
#[inline(always)]
pub(super) fn walk(&[u0, v0, w0, inside, ..]: &EdgePoints, walker: &mut impl TriangleWalker) {
    for (edge, points) in [u0, v0, w0].into_iter().enumerate() {
        walker.run(Run { edge, ring: 0, factor: edge, length: points - 1 });
    }
    for ring in 1..inside / 2 {
        for edge in 0..3 {
            walker.run(Run { edge, ring, factor: 3, length: inside - 1 - 2 * ring });
        }
    }
    if !is_odd(inside) {
        walker.centre();
    }
}

impl<W: PointWriter> TriangleWalker for Runs<'_, W> {
    #[inline(always)]
    fn run(&mut self, Run { edge, ring, factor, length }: Run) {
        let Self { locations, out } = self;
        let location = if ring == 0 { 0 } else { locations[factor].at(ring) };
        let Inset { perpendicular, shift } = Inset::new(location);
        let locations = locations[factor].from(ring);
        // Edges 0 and 2 run from the other end; on edge 2, w = perpendicular.
        let (last, rest) = (ONE - shift, ONE - perpendicular);
        match edge {
            0 => out.map::<_, POINTS_AT_ONCE>(length as usize, locations, |x| {
                W::Point::from_bits(perpendicular, last.wrapping_sub(x))
            }),
            1 => out.map::<_, POINTS_AT_ONCE>(length as usize, locations, |x| {
                W::Point::from_bits(x.wrapping_sub(shift), perpendicular)
            }),
            _ => out.map::<_, POINTS_AT_ONCE>(length as usize, locations, |x| {
                let q = last.wrapping_sub(x);
                W::Point::from_bits(q, rest.wrapping_sub(q))
            }),
        }
    }

    #[inline(always)]
    fn centre(&mut self) {
        self.out.put([W::Point::from_bits(ONE_THIRD, ONE_THIRD)]);
    }
}

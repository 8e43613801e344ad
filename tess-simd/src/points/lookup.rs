//! Points of small quads by look-up.
//!
//! All coordinates that a small quad's points have are computed at once into one table, and the topology
//! alone says where in it each point's two coordinates are. So there are no runs to begin and end.
//! Triangles are not done so: their rings need more tables than their few points are worth.

use super::coordinate::{Coordinate, Place, Walker};
use super::quad;
use crate::block::BlockPatch;
use crate::format::PointFormat;
use crate::lanes::{EdgePoints, MAX_FACTORS};
use crate::place::{Spacing, place};
use core::slice::IterMut;
use tess_core::fixed_point::{HALF, ONE};

/// The most points of a small patch's edge.
pub(crate) const EDGE: usize = 16;

/// Where in [`Coordinates`] a point's two coordinates are.
pub(crate) type Code = [u8; 2];

/// The coordinates that are the same for all patches.
const FIXED: [u32; 3] = [0, ONE, HALF];

/// The number of coordinates: all that a code reaches.
const ROOM: usize = 256;

/// The coordinates of one quad's points: for each factor its locations and the same seen from the other
/// end, [`EDGE`] each; then [`FIXED`].
#[derive(Clone, Debug)]
pub(crate) struct Coordinates([u32; ROOM]);

/// Where [`FIXED`] begins.
const FIRST_FIXED: usize = 2 * EDGE * MAX_FACTORS;

impl Coordinates {
    pub(crate) const EMPTY: Self = Self([0; ROOM]);

    /// Computes the coordinates of a small quad. `zero` is 0, which the compiler must not know: it
    /// would treat every position on its own.
    #[inline(always)]
    pub(crate) fn fill<P: PointFormat>(&mut self, patch: BlockPatch<'_>, zero: u32) {
        let tables = self.0.as_chunks_mut::<{ 2 * EDGE }>().0;
        for (factor, table) in tables.iter_mut().enumerate().take(MAX_FACTORS) {
            let x = locations(&patch.spacing(factor), zero);
            let (ahead, back) = table.split_at_mut(EDGE);
            for (to, &x) in ahead.iter_mut().zip(&x) {
                *to = P::coordinate(x);
            }
            for (to, &x) in back.iter_mut().zip(&x) {
                *to = P::coordinate(ONE.wrapping_sub(x));
            }
        }
        for (to, number) in self.0[FIRST_FIXED..].iter_mut().zip(FIXED) {
            *to = P::coordinate(number);
        }
    }

    /// The point with this code.
    #[inline(always)]
    pub(crate) fn point<P: PointFormat>(&self, [u, v]: Code) -> P {
        P::from_coordinates([self.0[usize::from(u)], self.0[usize::from(v)]])
    }
}

/// The locations of points `first..first + EDGE`; unspecified past the last point.
#[inline(always)]
fn locations(spacing: &Spacing, first: u32) -> [u32; EDGE] {
    let mut all = [0; EDGE];
    for (p, location) in (first..).zip(&mut all) {
        *location = place(spacing, p);
    }
    all
}

/// Writes the codes of a small regular quad's points to the beginning of `codes`, which has room.
pub(crate) fn codes(edges: &EdgePoints, codes: &mut [Code]) {
    quad::walk(edges, &mut Codes(codes.iter_mut()));
}

/// The code of a point whose coordinates both are in [`FIXED`].
pub(crate) fn fixed_code(point: [u32; 2]) -> Code {
    point.map(code_of_fixed)
}

/// Notes the codes of each run.
struct Codes<'a>(IterMut<'a, Code>);

impl Walker for Codes<'_> {
    type Held = u8;

    fn fixed(&self, number: u32) -> Coordinate<u8> {
        Coordinate::Held(code_of_fixed(number))
    }

    fn at(&self, place: Place) -> Coordinate<u8> {
        Coordinate::Held(code(place, 0))
    }

    fn run(&mut self, length: u32, u: Coordinate<u8>, v: Coordinate<u8>) {
        let number = |coordinate, k| match coordinate {
            Coordinate::Held(code) => code,
            Coordinate::Along(place) => code(place, k),
        };
        for (k, code) in (0..length).zip(&mut self.0) {
            *code = [number(u, k), number(v, k)];
        }
    }
}

/// The code of the location `k` points after a place.
#[expect(clippy::cast_possible_truncation, reason = "the tables end below 256")]
fn code(Place { factor, point, mirrored }: Place, k: u32) -> u8 {
    ((2 * factor + usize::from(mirrored)) * EDGE + (point + k) as usize) as u8
}

/// The code of one of [`FIXED`].
#[expect(clippy::cast_possible_truncation, reason = "the tables end below 256")]
fn code_of_fixed(number: u32) -> u8 {
    let at = FIXED.iter().position(|&fixed| fixed == number);
    debug_assert!(at.is_some(), "{number:#x} is no coordinate of every patch");
    (FIRST_FIXED + at.unwrap_or(0)) as u8
}

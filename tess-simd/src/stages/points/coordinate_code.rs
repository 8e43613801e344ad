//! Codes of the points of compact patches with fractional factors.
//!
//! Such patches share topologies, but not coordinates. Each topology therefore has one flat list of
//! codes that say how to compute each coordinate, so that writing a patch needs no branch per run
//! of points. [`codes`] makes the list once per topology, for `stages/template`; `permute` and
//! `lookup` make points from it.
//!
//! # Data
//!
//! A point has two codes, `[u, v]`. A coordinate is `term + location`, or `term - location` if the
//! bit `minus` is set. Locations are those on the first half of an edge; on the second half, a
//! location is `ONE` minus its mirror image.
//!
//! ```text
//! bit   15      14..11   10 .. 5                 4 .. 0
//!      +-------+--------+-----------------------+-------------------+
//!      | minus |   0    | location              | term (triangles)  |
//!      |       |        | factor * 8 + position | kind * 6 + ring   |
//!      +-------+--------+-----------------------+-------------------+
//!                         factor   0..=5          kind of term      value, with the ring's inset
//!                         position 0..=7          0 Perpendicular   perpendicular
//!                                                 1 Back            -shift
//!                                                 2 Last            ONE - shift
//!                                                 3 Third           shift - perpendicular
//!                                                 4 LastThird       ONE + shift - perpendicular
//!                                                 5 (ring 0) centre ONE_THIRD
//! ```
//!
//! Quads have no terms: for them `minus` means `ONE - location`.
//!
//! # One patch
//!
//! The quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md` has 5, 7, 7, 7 points on its edges and 5 and
//! 9 inside. Factor 0 has the locations 0, 0x6000, 0x8000 on its first half, factor 1 has 0,
//! 0x3AAB, 0x4556, 0x8000.
//!
//! ```text
//! point  codes             u                                v
//!   0    0x0000, 0x8000    location 0 (factor 0, position 0) ONE - location 0 = 0x10000
//!   1    0x0000, 0x8020    0                                 ONE - location 1 = 0xA000
//!   2    0x0000, 0x8040    0                                 ONE - location 2 = 0x8000
//!   3    0x0000, 0x0020    0                                 location 1       = 0x6000
//!   5    0x0120, 0x0000    location 9 (factor 1, position 1) = 0x3AAB         0
//!  22    0x0420, 0x8520    location 33 (factor 4)  = 0x4000  ONE - location 41 = 0xDAAA
//! ```
//!
//! # What must hold
//!
//! - Position 0 of any factor is at 0, so the code 0 is the coordinate 0, and the code that has
//!   only `minus` is `ONE` for a quad.
//! - An edge has at most [`COMPACT_EDGE`] points, because a position has three bits.
//! - A triangle's inside factor has at most [`COMPACT_TRIANGLE_INSIDE`] points and so at most 6
//!   rings, the outer one included. With more, the number of a term would run into the location's
//!   bits.
//! - Codes depend only on point counts. If they depended on a location, patches of one topology
//!   would get each other's points.
//!
//! # The simpler form
//!
//! Copying runs of locations, as larger patches do, begins and ends a loop for each edge of each
//! ring, and each end is a mispredicted branch. With AVX2, codes took `mosaic-even` from 114 to 67
//! ns per patch and `character` from 74 to 59 ns (`docs/experiments.md`).

use super::quad::{self, AxisPoint, Coordinate, QuadWalker};
use super::triangle::{self, TriangleWalker};
use crate::data::lanes::{EdgePoints, MAX_FACTORS};
use crate::stages::packet::{COMPACT_EDGE, COMPACT_TRIANGLE_INSIDE};
use core::slice::IterMut;
use tess_core::fixed_point::ONE;
use tess_core::{Domain, DomainPoint};

/// The most locations of half an edge.
pub(super) const HALF_EDGE: usize = COMPACT_EDGE / 2;

/// The most rings of a compact triangle, the outer one included.
pub(super) const RINGS: usize = COMPACT_TRIANGLE_INSIDE / 2;

/// The codes of a point's two coordinates.
pub(crate) type Code = [u16; 2];

/// The lowest bit of a location's number in a code. The number is the factor's number, times
/// [`HALF_EDGE`], plus the position. Below it is the number of the term, above it [`MINUS`].
pub(super) const LOCATION: u32 = 5;

/// The bit that is set if the location is subtracted.
pub(super) const MINUS: u16 = 1 << 15;

/// The kind of term that is added to a location of a triangle. The number of a term is its kind,
/// times [`RINGS`], plus the ring's number. Coordinates of quads have no term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Term {
    /// `perpendicular`.
    Perpendicular,
    /// `-shift`.
    Back,
    /// `ONE - shift`.
    Last,
    /// `shift - perpendicular`.
    Third,
    /// `ONE + shift - perpendicular`.
    LastThird,
}

/// The kinds of term, by number.
pub(super) const TERMS: [Term; 5] =
    [Term::Perpendicular, Term::Back, Term::Last, Term::Third, Term::LastThird];

/// The number of the term `ONE_THIRD`, which has no ring.
#[expect(clippy::cast_possible_truncation, reason = "30")]
pub(super) const CENTRE: u16 = (TERMS.len() * RINGS) as u16;

const _: () = {
    assert!(CENTRE < 1 << LOCATION, "terms stay below the location");
    assert!(
        (MAX_FACTORS * HALF_EDGE) << LOCATION <= MINUS as usize,
        "locations stay below `minus`"
    );
    assert!((COMPACT_EDGE - 1) / 2 < HALF_EDGE, "every position of half an edge has a number");
};

/// Writes the codes of a compact regular patch's points to the beginning of `codes`, which must
/// have room for them.
pub(crate) fn codes(domain: Domain, edges: &EdgePoints, codes: &mut [Code]) {
    let codes = codes.iter_mut();
    match domain {
        Domain::Isoline => debug_assert!(false, "isolines are not compact patches"),
        Domain::Triangle => triangle::walk(edges, &mut TriangleCodes { edges, codes }),
        Domain::Quad => quad::walk(edges, &mut QuadCodes { edges, codes }),
    }
}

/// The code of a corner of a minimum patch. Position 0 is at 0.
pub(crate) fn corner(domain: Domain, corner: DomainPoint) -> Code {
    [corner.u, corner.v].map(|coordinate| match (domain, coordinate.to_bits() == ONE) {
        (Domain::Triangle, true) => plus(Term::Last, 0),
        (_, true) => MINUS,
        (_, false) => 0,
    })
}

/// The code of a term with the location 0 (factor 0, position 0).
#[expect(clippy::cast_possible_truncation, reason = "below 30")]
const fn plus(term: Term, ring: u32) -> u16 {
    term as u16 * RINGS as u16 + ring as u16
}

/// The code, without a term, of a point of a factor, or of the same point seen from the other end.
#[expect(clippy::cast_possible_truncation, reason = "below 16 points of 6 factors")]
fn location(edges: &EdgePoints, AxisPoint { factor, point, mirrored }: AxisPoint) -> u16 {
    // Only the first half of an edge has locations; a point beyond it is `ONE` minus the one at the
    // same distance from the other end. Seen from that end, it is the location itself: two
    // reflections cancel.
    let opposite = edges[factor] - 1 - point;
    let position = point.min(opposite);
    let beyond_half = point > opposite;
    let number = (factor * HALF_EDGE) as u16 + position as u16;
    (number << LOCATION) | if beyond_half == mirrored { 0 } else { MINUS }
}

/// Writes the codes of a quad's runs.
struct QuadCodes<'a> {
    edges: &'a EdgePoints,
    codes: IterMut<'a, Code>,
}

impl QuadWalker for QuadCodes<'_> {
    type Held = u16;

    fn fixed(&self, number: u32) -> Coordinate<u16> {
        debug_assert!(number == 0 || number == ONE, "{number:#x} is no end of an edge");
        Coordinate::Held(if number == ONE { MINUS } else { 0 })
    }

    fn at(&self, point: AxisPoint) -> Coordinate<u16> {
        Coordinate::Held(location(self.edges, point))
    }

    fn run(&mut self, length: u32, u: Coordinate<u16>, v: Coordinate<u16>) {
        let number = |coordinate, k| match coordinate {
            Coordinate::Held(code) => code,
            Coordinate::Along(first) => {
                location(self.edges, AxisPoint { point: first.point + k, ..first })
            }
        };
        for (k, code) in (0..length).zip(&mut self.codes) {
            *code = [number(u, k), number(v, k)];
        }
    }
}

/// Writes the codes of a triangle's runs.
struct TriangleCodes<'a> {
    edges: &'a EdgePoints,
    codes: IterMut<'a, Code>,
}

impl TriangleWalker for TriangleCodes<'_> {
    fn run(&mut self, triangle::Run { edge, ring, factor, length }: triangle::Run) {
        // With `x` the location, the coordinates along an edge are `x - shift`, `ONE - shift - x`,
        // and on the last edge `x + shift - perpendicular`. `x` may itself be `ONE` minus a
        // location of the first half.
        let along = |point, mirrored, plain, opposite| {
            let location = location(self.edges, AxisPoint { factor, point, mirrored });
            location | plus(if location & MINUS == 0 { plain } else { opposite }, ring)
        };
        for (point, code) in (ring..ring + length).zip(&mut self.codes) {
            let ahead = along(point, false, Term::Back, Term::Last);
            let back = along(point, true, Term::Back, Term::Last);
            let held = plus(Term::Perpendicular, ring);
            *code = match edge {
                0 => [held, back],
                1 => [ahead, held],
                _ => [back, along(point, false, Term::Third, Term::LastThird)],
            };
        }
    }

    fn centre(&mut self) {
        if let Some(code) = self.codes.next() {
            *code = [CENTRE; 2];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tour;

    /// The numbers at the head of this file.
    #[test]
    fn the_worked_patch() {
        let codes = tour::all_codes();
        assert_eq!(codes.len(), 43, "a code pair for each point");
        let expected = [[0, 0x8000], [0, 0x8020], [0, 0x8040], [0, 0x0020]];
        assert_eq!(codes[..4], expected, "the edge u = 0, from v = ONE down");
        assert_eq!(codes[5], [0x0120, 0], "the second point of v = 0");
        assert_eq!(codes[22], [0x0420, 0x8520], "the first point of ring 1");
    }

    /// The corners of a minimum patch have codes of position 0.
    #[test]
    fn corners() {
        let far = DomainPoint::from_bits(ONE, 0);
        assert_eq!(corner(Domain::Quad, far), [MINUS, 0], "ONE - location 0");
        assert_eq!(
            corner(Domain::Triangle, far),
            [plus(Term::Last, 0), 0],
            "ONE - shift of ring 0"
        );
    }
}

//! Codes of the points of compact patches.
//!
//! A coordinate of a point is a location of a factor, or its opposite, plus a number that the domain and
//! the point's ring decide. Which ones follows from the topology alone, so it is noted once for each
//! topology, and no run of points begins or ends. `permute` makes points of codes.
//!
//! The locations are those of the first half of each edge: seen from the other end they are `ONE` minus
//! these.

use super::quad::{self, AxisPoint, Coordinate, QuadWalker};
use super::triangle::{self, TriangleWalker};
use crate::data::lanes::EdgePoints;
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

/// Where in a code the number of a location stands: the factor's number, times [`HALF_EDGE`], plus the
/// position. Below it stands the number of what is added, above it [`MINUS`].
pub(super) const LOCATION: u32 = 5;

/// Set if the location is subtracted.
pub(super) const MINUS: u16 = 1 << 15;

/// What is added to a coordinate of a triangle: this, times [`RINGS`], plus the ring's number. The
/// coordinates of quads have no such number: their [`MINUS`] is `ONE` minus the location.
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

/// The terms, by number.
pub(super) const TERMS: [Term; 5] =
    [Term::Perpendicular, Term::Back, Term::Last, Term::Third, Term::LastThird];

/// A term of its own, without a ring: `ONE_THIRD`.
#[expect(clippy::cast_possible_truncation, reason = "30")]
pub(super) const CENTRE: u16 = (TERMS.len() * RINGS) as u16;

/// Writes the codes of a compact regular patch's points to the beginning of `codes`, which has room.
pub(crate) fn codes(domain: Domain, edges: &EdgePoints, codes: &mut [Code]) {
    let codes = codes.iter_mut();
    match domain {
        Domain::Isoline => debug_assert!(false, "isolines are not compact patches"),
        Domain::Triangle => triangle::walk(edges, &mut Triangle { edges, codes }),
        Domain::Quad => quad::walk(edges, &mut Quad { edges, codes }),
    }
}

/// The code of a corner of a minimum patch. Position 0 lies at 0.
pub(crate) fn corner(domain: Domain, corner: DomainPoint) -> Code {
    [corner.u, corner.v].map(|coordinate| match (domain, coordinate.to_bits() == ONE) {
        (Domain::Triangle, true) => plus(Term::Last, 0),
        (_, true) => MINUS,
        (_, false) => 0,
    })
}

/// The code of a term without a location: with position 0.
#[expect(clippy::cast_possible_truncation, reason = "below 30")]
const fn plus(term: Term, ring: u32) -> u16 {
    term as u16 * RINGS as u16 + ring as u16
}

/// The code of point `point` of a factor, or of the same seen from the other end, without a term.
#[expect(clippy::cast_possible_truncation, reason = "below 16 points of 6 factors")]
fn location(edges: &EdgePoints, AxisPoint { factor, point, mirrored }: AxisPoint) -> u16 {
    let opposite = edges[factor] - 1 - point;
    let position = point.min(opposite);
    let beyond_half = point > opposite;
    let number = (factor * HALF_EDGE) as u16 + position as u16;
    (number << LOCATION) | if beyond_half == mirrored { 0 } else { MINUS }
}

/// Notes the codes of a quad's runs.
struct Quad<'a> {
    edges: &'a EdgePoints,
    codes: IterMut<'a, Code>,
}

impl QuadWalker for Quad<'_> {
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

/// Notes the codes of a triangle's runs.
struct Triangle<'a> {
    edges: &'a EdgePoints,
    codes: IterMut<'a, Code>,
}

impl TriangleWalker for Triangle<'_> {
    fn run(&mut self, triangle::Run { edge, ring, factor, length }: triangle::Run) {
        // With `x` the location, the coordinates along an edge are `x - shift`, `ONE - shift - x`, and
        // on the last edge `x + shift - perpendicular`; `x` itself may be `ONE` minus a location.
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

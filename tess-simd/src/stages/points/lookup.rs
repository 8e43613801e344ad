//! Points of compact patches by look-up, for levels without the permutes of AVX-512.
//!
//! All coordinates that a patch's codes can name are computed into a table first, in the output's
//! format. A point is then two loads and a store. `levels` passes this to `kernels/emit` at the
//! levels baseline and AVX2.
//!
//! # Data
//!
//! The table has 256 entries in rows of eight, one entry per position. Instead of a code, a
//! template stores the number of the code's entry, which is a byte in a `u16`.
//!
//! ```text
//! quads                                 triangles
//! row  0..=5   locations of factor      row  0..=2   locations of outer factor
//!      6..=11  ONE - those                   3..=5   ONE - those
//!      12..    unused                        6..=9   ring 1, with location x of the inside factor:
//!                                                    x - shift
//!                                                    ONE - shift - x
//!                                                    x + shift - perpendicular
//!                                                    ONE + shift - perpendicular - x
//!                                            10..=25 rings 2 to 5, the same
//!                                            26      perpendicular of rings 0..=5, then ONE_THIRD
//! ```
//!
//! # One patch
//!
//! Points 0, 1 and 5 of the quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md`:
//!
//! ```text
//! codes             entries    table, as 16.16      as binary32
//! 0x0000, 0x8000     0, 48     0x0000, 0x10000      0.0, 1.0
//! 0x0000, 0x8020     0, 49     0x0000, 0xA000       0.0, 0.625
//! 0x0120, 0x0000     9,  0     0x3AAB, 0x0000       0.22917175, 0.0
//! ```
//!
//! # What must hold
//!
//! - A template's entries were made by [`Lookup::stored`] and are read by [`Lookup::emit`];
//!   [`CompactPoints`] keeps the two together.
//! - Entries are below 256, so that `% ENTRIES` costs nothing and no check remains in the loop.
//! - Rows that a patch does not fill have values of earlier patches. No entry of the patch's
//!   topology names them.
//! - The compiler does not know `positions` (`black_box`). If it did, it would unroll eight
//!   different formulas instead of making one vector.
//!
//! # The simpler form
//!
//! Copying runs of points: a patch of `character` takes 129 ns at the baseline, and 94 ns with
//! look-ups; with AVX2 it takes 74 and 59 ns (`docs/experiments.md`).

use super::coordinate_code::{CENTRE, Code, HALF_EDGE, LOCATION, MINUS, RINGS, TERMS, Term};
use super::triangle::Inset;
use super::{CompactPoints, POINTS_AT_ONCE};
use crate::data::format::OutputPoint;
use crate::data::point_writer::PointWriter;
use crate::stages::packet::PacketPatch;
use crate::stages::place::place_in_half;
use core::hint::black_box;
use tess_core::Domain;
use tess_core::fixed_point::{ONE, ONE_THIRD};

/// A row of the table: coordinates at the eight positions of one factor.
type EntryRow = [u32; HALF_EDGE];

/// Number of the first rows: a row of locations for each factor of a quad or each outer factor of a
/// triangle. As many rows of `ONE` minus these follow.
const QUAD_FACTORS: usize = Domain::Quad.factors();
const TRIANGLE_OUTER: usize = Domain::Triangle.outer_factors();
/// The first row of a triangle's inner rings. Each ring has four rows, one for every kind of term
/// that is added to a location.
const INNER: usize = 2 * TRIANGLE_OUTER;
const ROWS_OF_RING: usize = TERMS.len() - 1;
/// The row of a triangle's coordinates without a location: one for each ring, beginning with 0 for
/// the outer ring, then the centre's.
const HELD: usize = INNER + ROWS_OF_RING * (RINGS - 1);
/// The number of coordinates: as many as a byte can address, so that no entry is out of range.
const ENTRIES: usize = 256;
const ROWS: usize = ENTRIES / HALF_EDGE;

const _: () = assert!(HELD < ROWS && RINGS < HALF_EDGE && 2 * QUAD_FACTORS <= ROWS, "all rows fit");

/// The coordinates of a patch.
#[derive(Clone, Debug)]
pub(crate) struct Lookup {
    rows: [EntryRow; ROWS],
    /// The positions of half an edge, hidden from the compiler.
    positions: EntryRow,
}

/// The entry of a code's coordinate in [`Lookup`].
#[expect(clippy::cast_possible_truncation, reason = "below 256")]
fn entry_of(domain: Domain, code: u16) -> u16 {
    let number = usize::from((code & !MINUS) >> LOCATION);
    let (factor, position) = (number / HALF_EDGE, number % HALF_EDGE);
    let (row, position) = if domain == Domain::Triangle {
        triangle_entry(usize::from(code % (1 << LOCATION)), factor, position)
    } else if code & MINUS == 0 {
        (factor, position)
    } else {
        (QUAD_FACTORS + factor, position)
    };
    (row * HALF_EDGE + position) as u16
}

/// The row and the position of a term's sum with a location.
fn triangle_entry(number: usize, factor: usize, position: usize) -> (usize, usize) {
    if number == usize::from(CENTRE) {
        return (HELD, RINGS);
    }
    let (term, ring) = (TERMS[number / RINGS], number % RINGS);
    match term {
        Term::Perpendicular => (HELD, ring),
        Term::Back | Term::Third if ring == 0 => (factor, position),
        Term::Last | Term::LastThird if ring == 0 => (TRIANGLE_OUTER + factor, position),
        _ => (INNER + ROWS_OF_RING * (ring - 1) + term as usize - 1, position),
    }
}

impl<W: PointWriter> CompactPoints<W> for Lookup {
    const LONG_BLOCKS: bool = false;

    fn stored(domain: Domain, code: u16) -> u16 {
        entry_of(domain, code)
    }

    // Only inlined code gets a level's instructions. WebAssembly has one level, and its pages must
    // load fast.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    #[cfg_attr(target_arch = "wasm32", inline(never))]
    fn emit(&mut self, patch: PacketPatch<'_>, entries: &[Code], out: &mut W) {
        if patch.domain() == Domain::Triangle {
            self.fill_edges::<W::Point, TRIANGLE_OUTER>(patch);
            self.fill_rings::<W::Point>(patch);
        } else {
            self.fill_edges::<W::Point, QUAD_FACTORS>(patch);
        }
        // One array of exactly 256 entries, so that a byte is always an index.
        let [coordinates] = self.rows.as_flattened().as_chunks::<ENTRIES>().0 else {
            return debug_assert!(false, "an entry's number is a byte");
        };
        out.map::<_, POINTS_AT_ONCE>(patch.points() as usize, entries, |[u, v]: Code| {
            let [u, v] = [usize::from(u) % ENTRIES, usize::from(v) % ENTRIES];
            point([coordinates[u], coordinates[v]])
        });
    }
}

impl Lookup {
    /// A table that no patch has filled yet.
    pub(crate) fn new() -> Self {
        Self { rows: [[0; HALF_EDGE]; ROWS], positions: black_box([0, 1, 2, 3, 4, 5, 6, 7]) }
    }

    /// Computes the coordinates of the first factors' locations, and of `ONE` minus these.
    #[inline(always)]
    fn fill_edges<P: OutputPoint, const FACTORS: usize>(&mut self, patch: PacketPatch<'_>) {
        for factor in 0..FACTORS {
            let locations = self.locations(patch, factor);
            self.rows[factor] = row::<P>(locations, |x| x);
            self.rows[FACTORS + factor] = row::<P>(locations, |x| ONE.wrapping_sub(x));
        }
    }

    /// Computes the coordinates of a triangle's inner rings and its centre.
    #[inline(always)]
    fn fill_rings<P: OutputPoint>(&mut self, patch: PacketPatch<'_>) {
        let inside = self.locations(patch, TRIANGLE_OUTER);
        let insets = inside.map(Inset::new);
        self.rows[HELD] = row::<P>(insets.map(|inset| inset.perpendicular), |x| x);
        self.rows[HELD][RINGS] = P::coordinate(ONE_THIRD);
        // Only the rings that the patch has: a ring is four rows of eight, one or two vectors each,
        // and small triangles have one ring or none.
        let rings = self.rows[INNER..HELD].as_chunks_mut::<ROWS_OF_RING>().0;
        let end = (patch.edge_points(TRIANGLE_OUTER) as usize / 2).min(RINGS);
        for ring in 1..end {
            let Inset { perpendicular, shift } = insets[ring];
            // Both terms are smaller than ONE, but a sum may pass through a negative number: all of
            // this is modulo 2^32.
            let (last, third) = (ONE - shift, shift.wrapping_sub(perpendicular));
            // In the order of the terms.
            rings[ring - 1] = [
                row::<P>(inside, |x| x.wrapping_sub(shift)),
                row::<P>(inside, |x| last.wrapping_sub(x)),
                row::<P>(inside, |x| x.wrapping_add(third)),
                row::<P>(inside, |x| third.wrapping_add(ONE).wrapping_sub(x)),
            ];
        }
    }

    /// The locations of half the edge of a factor.
    #[inline(always)]
    fn locations(&self, patch: PacketPatch<'_>, factor: usize) -> EntryRow {
        let spacing = patch.fractional_spacing(factor);
        let mut row = self.positions;
        for x in &mut row {
            *x = place_in_half(&spacing, *x);
        }
        row
    }
}

/// A row of coordinates, encoded in the output format.
#[inline(always)]
fn row<P: OutputPoint>(mut row: EntryRow, coordinate: impl Fn(u32) -> u32) -> EntryRow {
    for x in &mut row {
        *x = P::coordinate(coordinate(*x));
    }
    row
}

#[inline(always)]
fn point<P: OutputPoint>(coordinates: [u32; 2]) -> P {
    P::from_coordinates(coordinates)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::writer::Writer;
    use crate::tour;
    use alloc::vec::Vec;
    use tess_core::{DomainPoint, Patch};

    /// The numbers at the head of this file.
    #[test]
    fn the_worked_patch() {
        let packet = tour::packet();
        let stored =
            |code| <Lookup as CompactPoints<Writer<'_, DomainPoint>>>::stored(Domain::Quad, code);
        let entries: Vec<Code> =
            tour::all_codes().into_iter().map(|code| code.map(stored)).collect();
        assert_eq!([entries[0], entries[1], entries[5]], [[0, 48], [0, 49], [9, 0]], "entries");
        let mut table = Lookup::new();
        let mut points = [[0.0_f32; 2]; 43];
        table.emit(packet.patch(0), &entries, &mut Writer::new(&mut points));
        let bits = |entry: usize| table.rows.as_flattened()[entry];
        assert_eq!([bits(0), bits(48), bits(49)], [0.0, 1.0, 0.625].map(f32::to_bits), "the table");
        assert_eq!(bits(9), 0.229_171_75_f32.to_bits(), "0x3AAB");
        let expected: Vec<_> = Patch::new(tour::CONFIG, tour::QUAD).points().collect();
        for (point, expected) in points.iter().zip(expected) {
            assert_eq!(
                point.map(f32::to_bits),
                expected.to_f32().map(f32::to_bits),
                "{expected:?}"
            );
        }
    }
}

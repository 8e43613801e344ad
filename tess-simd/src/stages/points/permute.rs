//! Points of compact patches by permutes of AVX-512, eight points at a time.
//!
//! All locations and terms that a patch's codes name fit a few vectors, and the instruction
//! `vpermi2d` picks 16 of 32 numbers at once. `levels` passes this to `kernels/emit` at the level
//! AVX-512.
//!
//! # Data
//!
//! Each vector has sixteen 32-bit numbers. A vector of locations has the first half edges of two
//! factors.
//!
//! ```text
//!        lanes 0..=7              lanes 8..=15
//! a    locations of factor 0    factor 1               \ vpermi2d by bits 5..=9 of the code
//! b    locations of factor 2    factor 3               /
//! c    locations of factor 4    factor 5          quads: vpermd by bits 5..=8, where bit 10 is set
//! c, d terms 0..=15             16..=30           triangles: vpermi2d by bits 0..=4
//! ```
//!
//! A vector of codes has eight points: u, v, u, v ... Its sign bits are the bits `minus`, which
//! become a mask.
//!
//! ```text
//! quads      minus ? ONE - location : location
//! triangles  minus ? term - location : term + location
//! ```
//!
//! # One patch
//!
//! The quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md`, whose factors 0 and 1 have 5 and 7 points:
//!
//! ```text
//! a     0 6000 8000 .... .... .... .... ....  0 3AAB 4556 8000 .... .... .... ....
//! code  0000 8000 | 0000 8020 | 0000 8040 | 0000 0020 | 0100 0000 | 0120 0000 | ...
//! lane     0    0 |    0    1 |    0    2 |    0    1 |    8    0 |    9    0 | ...
//! point 0 10000   | 0 A000    | 0 8000    | 0 6000    | 0 0       | 3AAB 0    | ...
//! ```
//!
//! # What must hold
//!
//! - The CPU has the level's instructions. [`with_avx512`] gives them to each function here; such a
//!   function can be called without `unsafe` only from another one, or from a closure in one
//!   ([`Permutes`]).
//! - Inside factors of quads have numbers 4 and 5: bit 10 of a code tells them from outer ones.
//! - There are at most 31 terms, which fit two vectors.
//! - Codes are padded to multiples of [`LEAST`]. The padding may be anything: the points made from
//!   it follow the patch's points, and the next patch overwrites them.
//!
//! # The simpler form
//!
//! Gathers from memory take 1.4 to 1.6 times as long for triangles. With copies of runs, as for
//! larger patches, `character` was written at 0.17 of a fill; with permutes and the stages' order
//! of `kernels/emit` it is written at 0.24 (`docs/experiments.md`).

use super::coordinate_code::{CENTRE, Code, HALF_EDGE, LOCATION, RINGS, TERMS, Term};
use super::{CompactPoints, POINTS_AT_ONCE};
use crate::data::format::OutputPoint;
use crate::data::point_writer::PointWriter;
use crate::stages::packet::PacketPatch;
use bytemuck::must_cast;
use core::arch::x86_64::{
    __m256i, __m512i, _mm512_add_epi32, _mm512_cmpeq_epi32_mask, _mm512_cmpgt_epu32_mask,
    _mm512_cvtepi16_epi32, _mm512_mask_add_epi32, _mm512_mask_blend_epi32, _mm512_mask_mov_epi32,
    _mm512_mask_set1_epi32, _mm512_mask_sub_epi32, _mm512_movepi32_mask, _mm512_mullo_epi32,
    _mm512_permutex2var_epi32, _mm512_permutexvar_epi32, _mm512_set1_epi32, _mm512_srli_epi32,
    _mm512_sub_epi32, _mm512_test_epi32_mask,
};
use tess_core::Domain;
use tess_core::fixed_point::{HALF, ONE, ONE_THIRD, TWO_THIRDS};
use tess_level::with_avx512;

/// Points are made in multiples of this number. Most compact patches have at most this many.
const LEAST: usize = 32;

/// The bit that is set in a code if the location belongs to a quad's inside factor, number 4 or 5.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "a single bit of sixteen"
)]
const INSIDE: i32 = (Domain::Quad.outer_factors() * HALF_EDGE) as i32 * (1 << LOCATION);

/// A closure that calls [`emit`], to be passed to functions that need [`CompactPoints`].
pub(crate) struct Permutes<F>(pub(crate) F);

impl<W, F: Fn(PacketPatch<'_>, &[Code], &mut W)> CompactPoints<W> for Permutes<F> {
    const LONG_BLOCKS: bool = true;

    /// Returns the code itself.
    fn stored(_: Domain, code: u16) -> u16 {
        code
    }

    #[inline(always)]
    fn emit(&mut self, patch: PacketPatch<'_>, codes: &[Code], out: &mut W) {
        self.0(patch, codes, out);
    }
}

/// How to make sixteen terms: the lane of each term's location, its constant, and masks of the
/// lanes that add or subtract `perpendicular` and `shift`.
#[derive(Clone, Copy)]
struct Recipe {
    location: [u32; 16],
    constant: [u32; 16],
    perpendicular: u16,
    less_perpendicular: u16,
    shift: u16,
    less_shift: u16,
}

/// The recipes of all terms, in the order of their numbers.
#[expect(clippy::cast_possible_truncation, reason = "numbers of lanes")]
const RECIPES: [Recipe; 2] = {
    let mut all = [Recipe {
        location: [HALF_EDGE as u32; 16],
        constant: [ONE_THIRD; 16],
        perpendicular: 0,
        less_perpendicular: 0,
        shift: 0,
        less_shift: 0,
    }; 2];
    let mut number = 0;
    while number < CENTRE as usize {
        let (term, ring) = (TERMS[number / RINGS], number % RINGS);
        let (recipe, lane) = (&mut all[number / 16], number % 16);
        recipe.location[lane] = (HALF_EDGE + ring) as u32;
        recipe.constant[lane] = match term {
            Term::Last | Term::LastThird => ONE,
            _ => 0,
        };
        let bit = 1 << lane;
        match term {
            Term::Perpendicular => recipe.perpendicular |= bit,
            Term::Back | Term::Last => recipe.less_shift |= bit,
            Term::Third | Term::LastThird => {
                recipe.shift |= bit;
                recipe.less_perpendicular |= bit;
            }
        }
        number += 1;
    }
    all
};

with_avx512! {
    /// Writes the points of a compact patch of fractional factors.
    pub(crate) fn emit(patch: PacketPatch<'_>, codes: &[Code], out: &mut impl PointWriter) {
        let points = patch.points() as usize;
        // From here on no memory is read except codes: every number that one can name is in `a` to
        // `d`. For a triangle, `b` has factor 2 and the inside factor, number 3.
        let [a, b] = [locations(patch, 0), locations(patch, 2)];
        if patch.domain() == Domain::Triangle {
            let [c, d] = terms(b);
            out.blocks::<_, POINTS_AT_ONCE, LEAST>(points, codes, move |codes| {
                let codes = extended(codes);
                // `vpermi2d` reads only the lowest five bits of a lane, so the bits above need no
                // mask. After this shift the lowest five are the location's number.
                let number = _mm512_srli_epi32::<LOCATION>(codes);
                let location = _mm512_permutex2var_epi32(a, number, b);
                // Unshifted, the lowest five are the term's.
                let term = _mm512_permutex2var_epi32(c, codes, d);
                let sum = _mm512_add_epi32(term, location);
                // `minus` is bit 15 of a code, hence the sign of a lane. The lanes that have it get
                // the difference in place of the sum: one instruction instead of two and a blend.
                let minus = _mm512_movepi32_mask(codes);
                point(_mm512_mask_sub_epi32(sum, minus, term, location))
            });
        } else {
            // A quad has no terms, but 48 locations, and one permute has room for 32: those of the
            // outer factors are in `a` and `b`, those of the inside factors in `c`.
            let c = locations(patch, 4);
            let one = _mm512_set1_epi32(ONE.cast_signed());
            let inside = _mm512_set1_epi32(INSIDE);
            out.blocks::<_, POINTS_AT_ONCE, LEAST>(points, codes, move |codes| {
                let codes = extended(codes);
                let number = _mm512_srli_epi32::<LOCATION>(codes);
                let outer = _mm512_permutex2var_epi32(a, number, b);
                // Both permutes are made for every lane; bit 10 of the code chooses. A branch would
                // mispredict, because edges and interior change every few points.
                let is_inside = _mm512_test_epi32_mask(codes, inside);
                let location =
                    _mm512_mask_blend_epi32(is_inside, outer, _mm512_permutexvar_epi32(number, c));
                let minus = _mm512_movepi32_mask(codes);
                point(_mm512_mask_sub_epi32(location, minus, one, location))
            });
        }
    }

    /// The codes of eight points, with their signs extended.
    fn extended(codes: &[Code; POINTS_AT_ONCE]) -> __m512i {
        _mm512_cvtepi16_epi32(must_cast::<_, __m256i>(*codes))
    }

    /// The locations of half the edges of two factors.
    fn locations(patch: PacketPatch<'_>, first: usize) -> __m512i {
        const POSITIONS: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7];
        const MIDDLE_OF: [u32; 16] = [1, 3, 5, 7, 9, 11, 13, 15, 1, 3, 5, 7, 9, 11, 13, 15];
        // `place_in_half` for sixteen positions: eight of one factor, eight of the next.
        let (one, other) = (patch.fractional_spacing(first), patch.fractional_spacing(first + 1));
        let both = |one: u32, other: u32| {
            let one = _mm512_set1_epi32(one.cast_signed());
            _mm512_mask_set1_epi32(one, 0xFF00, other.cast_signed())
        };
        // The place before rounding: position * step, less lag after the split (`stages/place`).
        // Products are modulo 2^32; the result is at most 2^31, which is HALF in 0.32.
        let positions = must_cast(POSITIONS);
        let sums = _mm512_mullo_epi32(positions, both(one.step, other.step));
        let splits = both(one.split_position, other.split_position);
        let behind = _mm512_cmpgt_epu32_mask(positions, splits);
        let sums = _mm512_mask_sub_epi32(sums, behind, sums, both(one.lag, other.lag));
        let half = _mm512_set1_epi32(HALF.cast_signed());
        let rounded = _mm512_srli_epi32::<16>(_mm512_add_epi32(sums, half));
        // The middle of an odd number of points is HALF, which rounded reciprocals may miss.
        // Positions that the factor lacks have unspecified numbers, which no code names.
        let middle = _mm512_cmpeq_epi32_mask(must_cast(MIDDLE_OF), both(one.points, other.points));
        _mm512_mask_mov_epi32(rounded, middle, half)
    }

    /// The terms of a triangle, from a vector whose second half has the inside factor's locations.
    fn terms(inside: __m512i) -> [__m512i; 2] {
        [half_of_terms::<0>(inside), half_of_terms::<1>(inside)]
    }

    /// One vector of terms: `constant`, with `perpendicular` and `shift` added and subtracted in
    /// the lanes of the masks.
    fn half_of_terms<const HALF_OF: usize>(inside: __m512i) -> __m512i {
        let recipe = const { &RECIPES[HALF_OF] };
        // The ring's location in each lane; five terms have the same ring.
        let location = _mm512_permutexvar_epi32(must_cast(recipe.location), inside);
        let sum = _mm512_mullo_epi32(location, _mm512_set1_epi32(TWO_THIRDS.cast_signed()));
        let half = _mm512_set1_epi32(HALF.cast_signed());
        // `Inset::new`: two thirds of the location, rounded, and half of that, rounded up.
        let perpendicular = _mm512_srli_epi32::<16>(_mm512_add_epi32(sum, half));
        let shift = _mm512_sub_epi32(perpendicular, _mm512_srli_epi32::<1>(perpendicular));
        // Each mask has the lanes whose term contains that summand. Lanes of ring 0 have location
        // 0, so their summands are 0.
        let sum = must_cast(recipe.constant);
        let sum = _mm512_mask_add_epi32(sum, recipe.perpendicular, sum, perpendicular);
        let sum = _mm512_mask_sub_epi32(sum, recipe.less_perpendicular, sum, perpendicular);
        let sum = _mm512_mask_add_epi32(sum, recipe.shift, sum, shift);
        _mm512_mask_sub_epi32(sum, recipe.less_shift, sum, shift)
    }

    /// Eight points from their coordinates.
    fn point<P: OutputPoint>(coordinates: __m512i) -> [P; POINTS_AT_ONCE] {
        // The lanes already alternate u, v as points do in memory: for 16.16 this compiles to one
        // store, for binary32 to an `or` and a subtraction before it.
        let mut points = [P::default(); POINTS_AT_ONCE];
        let coordinates = must_cast::<_, [[u32; 2]; POINTS_AT_ONCE]>(coordinates);
        for (point, [u, v]) in points.iter_mut().zip(coordinates) {
            *point = P::from_bits(u, v);
        }
        points
    }
}

//! The vertex-cache order: the same triangles, in an order in which a vertex is used again soon.
//!
//! The specification walks around a patch ring by ring, so nearly every vertex is used twice, a
//! whole ring apart: a GPU that keeps the last 32 shaded vertices shades it twice. This order cuts
//! the rings across into columns and walks each column from the outer edge inwards. It is not part
//! of any specification; it serves renderers. `Patch::tessellate_in` and `tess-simd` write it, and
//! `tess-gpu`'s shaders invert the formulas below.
//!
//! # The data
//!
//! Each outer edge owns a *sector*: its transition and the stitches of the rings further in. Cells
//! are counted along the edge from the patch's corner; a column is [`COLUMN`] cells. Ring `k`
//! begins `k` cells from the corner.
//!
//! ```text
//!            column 0        column 1
//!  outer edge ─────────────┬────────────  cell 0 1 2 3 | 4 5
//!   ring 1     \ 0 ..... 6 │ 7 .. 9 /     10 triangles: the transition
//!   ring 2       \ 0 ... 4 │ 5 /           6 triangles
//!   ring 3         \ 0 . 1 /               2 triangles
//! ```
//!
//! The numbers are the steps of each stitch. A column cuts a run of steps out of each stitch, so
//! the whole order is a list of ranges of the specification's triangle numbers
//! ([`CacheOrder::runs`]), and the place of a triangle is a sum of borders in closed form
//! (`CacheOrder::cache_position`).
//!
//! # One patch
//!
//! A quad whose factors are all 6 has 7 points on each edge; the picture above shows one of its
//! sectors. In the specification's order, triangles 0 to 39 belong to ring 1, ten per edge, 40 to
//! 63 to ring 2, and 64 to 71 to ring 3. The first edge's runs:
//!
//! ```
//! use tess_core::cache_order::CacheOrder;
//!
//! let mut runs = Vec::new();
//! CacheOrder::new([7; 4], [7; 2]).runs(|run| runs.push(run));
//! assert_eq!(runs[..3], [0..7, 40..45, 64..66], "column 0: rings 1, 2 and 3");
//! assert_eq!(runs[3..5], [7..10, 45..46], "column 1: rings 1 and 2");
//! assert_eq!(runs[5], 10..17, "the second edge begins");
//! assert_eq!(runs.iter().map(|run| run.len()).sum::<usize>(), 2 * 6 * 6);
//! ```
//!
//! # What holds
//!
//! - Every triangle up to the innermost ring is in exactly one run: borders grow with the column,
//!   begin at 0 and end at the stitch's size. Otherwise triangles would be lost or drawn twice.
//! - `cache_position` is the inverse of the list of runs. Backends use one or the other.
//! - Triangles inside the innermost ring come last and keep their numbers. `runs` leaves them out.
//! - Points keep their numbers, so both orders have the same points.
//!
//! # Why not simpler
//!
//! Strips from one side of the patch to the other need no sectors. On an NVIDIA H200 they draw at
//! best 1.61 billion triangles per second at factor 64; columns of four draw 1.63 billion and the
//! specification's order 1.50. At factor 8 the three draw 1.58, 1.71 and 1.49 billion. Columns of
//! other widths lose up to 15 %. A cache of 32 vertices misses 0.64 to 0.67 times per triangle with
//! columns of four, and 0.9 to 1.0 times with the specification's order.

use crate::closed_form::locate::origin::PrimitiveOrigin;
use crate::model::factors::ProcessedPatch;
use crate::model::patch_factors::PatchFactors;
use core::ops::Range;

/// The most rings that have stitches.
const MAX_RINGS: usize = 32;

/// Cells of a column along its edge.
pub const COLUMN: u32 = 4;

/// The vertex-cache order of a regular triangle or quad patch, whose output is triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CacheOrder<const EDGES: usize> {
    sectors: [Sector; EDGES],
}

/// The stitches along one outer edge: its transition and, further in, one for each ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Sector {
    /// Triangles of the transition.
    transition: u32,
    /// Points along the inside axis that the edge runs along.
    along: u32,
    /// One more than the number of rings.
    end: u32,
}

impl<const EDGES: usize> CacheOrder<EDGES> {
    /// The order of a patch, from its points along each outer edge and along the inside axes: u and
    /// v of a quad; a triangle gives its one inside count twice.
    ///
    /// Total: outer edges have 2 to 65 points, inside axes 3 to 65. A count outside its range is
    /// clamped to it.
    #[must_use]
    pub fn new(outer: [u32; EDGES], inside: [u32; 2]) -> Self {
        let outer = outer.map(|points| points.clamp(2, 65));
        let [u, v] = inside.map(|points| points.clamp(3, 65));
        let end = u.min(v).div_ceil(2);
        let sectors = core::array::from_fn(|edge| {
            let along = if edge.is_multiple_of(2) { v } else { u };
            Sector { transition: outer[edge] + along - 4, along, end }
        });
        Self { sectors }
    }

    /// The place of a triangle in this order. `origin` and `t` are its origin and its number in the
    /// specification's order.
    fn cache_position(&self, origin: PrimitiveOrigin, t: u32) -> u32 {
        let (ring, edge, step) = match origin {
            PrimitiveOrigin::Transition { edge, step } => (1, edge as usize, step),
            PrimitiveOrigin::Ring { ring, edge, step } => (ring, edge as usize, step),
            _ => return t,
        };
        let before: u32 = self.sectors[..edge].iter().map(Sector::size).sum();
        before + self.sectors[edge].triangles_before(ring, step)
    }

    /// Sends the triangles of all stitches to `emit`, in this order, as ranges of their numbers in
    /// the specification's order. No range is empty. Triangles inside the innermost ring follow in
    /// the specification's order and are not sent.
    pub fn runs(&self, mut emit: impl FnMut(Range<u32>)) {
        let firsts = self.firsts();
        for (edge, sector) in self.sectors.iter().enumerate() {
            for column in 0..sector.columns() {
                for (ring, steps) in sector.runs(column) {
                    let first = firsts[ring as usize - 1][edge];
                    emit(first + steps.start..first + steps.end);
                }
            }
        }
    }

    /// The columns along an outer edge. The whole order is edge by edge, column by column.
    ///
    /// # Panics
    /// If `edge` is not below `EDGES`.
    #[inline(always)]
    #[must_use]
    pub const fn columns(&self, edge: usize) -> Range<u32> {
        0..self.sectors[edge].columns()
    }

    /// The triangles of a column along an outer edge, in this order: for each ring, 1 first, the
    /// steps of its stitch that the column has. No range is empty.
    ///
    /// # Panics
    /// If `edge` is not below `EDGES`.
    #[inline(always)]
    pub fn column(&self, edge: usize, column: u32) -> impl Iterator<Item = (u32, Range<u32>)> {
        self.sectors[edge].runs(column)
    }

    /// The number of each stitch's first triangle in the specification's order, which goes ring by
    /// ring and in each ring edge by edge. Element 0 is ring 1.
    fn firsts(&self) -> [[u32; EDGES]; MAX_RINGS] {
        let (mut firsts, mut next) = ([[0; EDGES]; MAX_RINGS], 0);
        // All sectors have the same rings.
        let end = self.sectors.iter().map(|sector| sector.end).min().unwrap_or(0);
        for (ring, firsts) in (1..end).zip(&mut firsts) {
            for (first, sector) in firsts.iter_mut().zip(&self.sectors) {
                *first = next;
                next += sector.stitch(ring);
            }
        }
        firsts
    }
}

impl Sector {
    /// Triangles of the stitch between `ring` and the ring outside of it.
    const fn stitch(&self, ring: u32) -> u32 {
        if ring == 1 { self.transition } else { 2 * (self.along - 2 * ring) }
    }

    fn size(&self) -> u32 {
        self.transition + self.borders(self.end, self.columns())
    }

    const fn columns(&self) -> u32 {
        self.along.div_ceil(COLUMN)
    }

    /// The steps of each ring's stitch that a column has, ring 1 first.
    #[inline(always)]
    fn runs(self, column: u32) -> impl Iterator<Item = (u32, Range<u32>)> {
        let steps = move |ring| self.border(ring, column)..self.border(ring, column + 1);
        // A ring begins one cell further from the corner than the one outside of it, so if a ring
        // has no triangles in this column, the rings further in have none either.
        (1..self.end)
            .map(move |ring| (ring, steps(ring)))
            .take_while(|(_, steps)| !steps.is_empty())
    }

    /// The first step of a stitch that belongs to `column` or to a later one.
    ///
    /// Cells are counted from the patch's corner in steps of the inside axis, and the inner row of
    /// ring `k` begins `k` cells from the corner. A ring stitch has two triangles per cell after
    /// its first triangle. The number of a transition's triangles depends on its outer edge, so it
    /// is cut in proportion.
    #[inline(always)]
    fn border(&self, ring: u32, column: u32) -> u32 {
        let regular = (2 * COLUMN * column + 1).saturating_sub(2 * ring);
        if ring > 1 {
            return regular.min(self.stitch(ring));
        }
        (regular * self.transition / (2 * self.along - 4)).min(self.transition)
    }

    /// The sum of [`Self::border`] over the rings `2..end`. A ring adds `2 COLUMN column + 1 - 2
    /// ring` where that is positive and at most the stitch's size, else 0 or the whole stitch.
    fn borders(&self, end: u32, column: u32) -> u32 {
        let (first, whole) = (2 * COLUMN * column + 1, 2 * self.along);
        // From this ring on, `first - 2 ring` is at least the stitch's size, `whole - 4 ring`.
        let half = (whole + 1).saturating_sub(first) / 2;
        let top = end.max(2);
        // The rings 2..cut are cut at `first - 2 ring`, which is positive up to ring COLUMN column;
        // the rings complete..top add their whole stitch. Those between the two add nothing.
        let cut = end.min(COLUMN * column + 1).min(half).max(2);
        let complete = half.clamp(2, top);
        // Two arithmetic series: the number of rings times the mean of the first and the last.
        (cut - 2) * first.saturating_sub(cut + 1)
            + (top - complete) * (whole - 2 * (complete + top - 1))
    }

    /// The column of a step: the last one whose [`Self::border`] is at most `step`.
    fn column(&self, ring: u32, step: u32) -> u32 {
        // 2 COLUMN column + 1 - 2 ring <= step, solved for the column.
        if ring > 1 {
            return (step + 2 * ring - 1) / (2 * COLUMN);
        }
        // The largest number of regular steps whose share of the transition, rounded down, is at
        // most `step`; then solved for the column as above, with ring 1.
        let last = ((step + 1) * (2 * self.along - 4) - 1) / self.transition;
        (last + 1) / (2 * COLUMN)
    }

    /// How many triangles of the sector come before this one.
    fn triangles_before(&self, ring: u32, step: u32) -> u32 {
        let column = self.column(ring, step);
        // A border counts the steps of a stitch before a column, so the sum over all stitches
        // counts the triangles of the columns before; differences of borders are those of this
        // column.
        let columns_before = self.border(1, column) + self.borders(self.end, column);
        let begin = self.border(ring, column);
        if ring == 1 {
            return columns_before + step - begin;
        }
        let transition = self.border(1, column + 1) - self.border(1, column);
        let rings = self.borders(ring, column + 1) - self.borders(ring, column);
        columns_before + transition + rings + step - begin
    }
}

/// The place of triangle `t` in the vertex-cache order: `t` itself, unless the patch has rings.
pub(crate) fn cache_position(patch: &ProcessedPatch, origin: PrimitiveOrigin, t: u32) -> u32 {
    match patch {
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => {
            let outer = factors.outer().map(|factor| factor.context.points);
            CacheOrder::new(outer, [factors.inside.context.points; 2]).cache_position(origin, t)
        }
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => {
            let outer = factors.outer().map(|factor| factor.context.points);
            let inside = factors.inside().map(|factor| factor.context.points);
            CacheOrder::new(outer, inside).cache_position(origin, t)
        }
        _ => t,
    }
}

//! The vertex-cache order: the same triangles, in an order in which a vertex is used again soon.
//!
//! The specification walks around a patch ring by ring, so nearly every vertex is met twice, with a
//! whole ring between. Here each outer edge's share of the rings is cut across into columns of
//! [`COLUMN`] cells, and a column is walked from the outer edge inwards before the next one begins.
//! What is inside the innermost ring comes last, as in the specification. No specification asks for
//! this order; it serves renderers.

use crate::factors::ProcessedPatch;
use crate::locate::origin::PrimitiveOrigin;
use crate::patch_factors::PatchFactors;
use core::ops::Range;

/// The order in which a patch's triangles are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Order {
    /// That of the specification (sections 7 and 8), bit for bit.
    #[default]
    Specification,
    /// The same triangles, ordered for a vertex cache. Points keep their order and numbers; lines and
    /// points are written as the specification says.
    VertexCache,
}

/// Rings that have stitches, at most.
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
    /// The order of a patch with these points along each outer edge, and along each inside axis:
    /// u and v of a quad, the one of a triangle twice.
    #[must_use]
    pub fn new(outer: [u32; EDGES], inside: [u32; 2]) -> Self {
        let [u, v] = inside;
        let end = u.min(v).div_ceil(2);
        let sectors = core::array::from_fn(|edge| {
            let along = if edge.is_multiple_of(2) { v } else { u };
            Sector { transition: outer[edge] + along - 4, along, end }
        });
        Self { sectors }
    }

    /// Where the triangle of this origin is drawn; `t` is its number in the specification's order.
    #[must_use]
    pub fn position(&self, origin: PrimitiveOrigin, t: u32) -> u32 {
        let (ring, edge, step) = match origin {
            PrimitiveOrigin::Transition { edge, step } => (1, edge as usize, step),
            PrimitiveOrigin::Ring { ring, edge, step } => (ring, edge as usize, step),
            _ => return t,
        };
        let before: u32 = self.sectors[..edge].iter().map(Sector::size).sum();
        before + self.sectors[edge].position(ring, step)
    }

    /// All triangles up to the innermost ring as ranges of their numbers in the specification's
    /// order, in the vertex-cache order; none is empty.
    pub fn runs(&self, mut emit: impl FnMut(Range<u32>)) {
        for (edge, sector) in self.sectors.iter().enumerate() {
            let mut first = [0; MAX_RINGS];
            for (ring, first) in (1..sector.end).zip(&mut first) {
                *first = self.first_of_stitch(ring, edge);
            }
            for column in 0..sector.columns() {
                for (ring, first) in (1..sector.end).zip(first) {
                    let begin = sector.border(ring, column);
                    let end = sector.border(ring, column + 1);
                    if begin < end {
                        emit(first + begin..first + end);
                    } else if ring > 1 {
                        break; // the rings further in have nothing in this column either
                    }
                }
            }
        }
    }

    /// The number in the specification's order of a stitch's first triangle.
    fn first_of_stitch(&self, ring: u32, edge: usize) -> u32 {
        let earlier = |sector: &Sector| sector.transition + sector.borders(ring, sector.columns());
        let earlier: u32 = if ring == 1 { 0 } else { self.sectors.iter().map(earlier).sum() };
        earlier + self.sectors[..edge].iter().map(|sector| sector.stitch(ring)).sum::<u32>()
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

    /// The first step of a stitch that belongs to `column` or to a later one.
    ///
    /// Cells are counted from the patch's corner in steps of the inside axis, and the inner row of
    /// ring `k` begins `k` of them in. A ring stitch has two triangles a cell behind its first one;
    /// a transition has as many as its outer edge asks for, and is cut in proportion.
    fn border(&self, ring: u32, column: u32) -> u32 {
        let regular = (2 * COLUMN * column + 1).saturating_sub(2 * ring);
        if ring > 1 {
            return regular.min(self.stitch(ring));
        }
        (regular * self.transition / (2 * self.along - 4)).min(self.transition)
    }

    /// The sum of [`Self::border`] over the rings `2..end`: of `2 COLUMN column + 1 - 2 ring` while that is
    /// positive and within the stitch, then of whole stitches.
    fn borders(&self, end: u32, column: u32) -> u32 {
        let (first, whole) = (2 * COLUMN * column + 1, 2 * self.along);
        let half = (whole + 1).saturating_sub(first) / 2;
        let top = end.max(2);
        let cut = end.min(COLUMN * column + 1).min(half).max(2);
        let complete = half.clamp(2, top);
        (cut - 2) * first.saturating_sub(cut + 1)
            + (top - complete) * (whole - 2 * (complete + top - 1))
    }

    /// The column of a step.
    fn column(&self, ring: u32, step: u32) -> u32 {
        if ring > 1 {
            return (step + 2 * ring - 1) / (2 * COLUMN);
        }
        let last = ((step + 1) * (2 * self.along - 4) - 1) / self.transition;
        (last + 1) / (2 * COLUMN)
    }

    /// How many triangles of the sector are drawn before this one.
    fn position(&self, ring: u32, step: u32) -> u32 {
        let column = self.column(ring, step);
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

/// Where triangle `t` of a patch is drawn: `t` itself, unless the patch has rings.
pub(crate) fn position(patch: &ProcessedPatch, origin: PrimitiveOrigin, t: u32) -> u32 {
    match patch {
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => {
            let outer = factors.outer().map(|factor| factor.context.points);
            CacheOrder::new(outer, [factors.inside.context.points; 2]).position(origin, t)
        }
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => {
            let outer = factors.outer().map(|factor| factor.context.points);
            let inside = factors.inside().map(|factor| factor.context.points);
            CacheOrder::new(outer, inside).position(origin, t)
        }
        _ => t,
    }
}

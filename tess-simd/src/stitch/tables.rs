//! The tables of stitches, read off patches that the core tessellated.

use super::code::{INNER, STEP};
use super::rows::Codes;
use alloc::vec::Vec;
use core::ops::Range;
use tess_core::{
    Config, OutputPrimitive, Partitioning, Patch, PatchFactors, ProcessedFactor, ProcessedPatch,
    QuadFactors, Tessellation,
};

/// Point counts of edges are below this.
const COUNTS: usize = 66;

/// A stitch's codes, and how many there are without the padding.
#[derive(Clone, Copy, Debug, Default)]
struct Table {
    first: u32,
    length: u32,
}

/// Every stitch that a configuration can ask for.
///
/// About 760 KiB for integer partitionings and 200 KiB for fractional ones; configurations that
/// make no triangles have empty tables.
#[derive(Clone, Debug)]
pub(crate) struct Stitches {
    codes: Vec<i8>,
    /// By the point count of the inner row.
    rings: [Table; COUNTS],
    /// By the point counts of the outer edge and of the inside factor.
    transitions: Vec<Table>,
    /// By kind of strip, row A being the outer and row B the inner one.
    strips: [Table; 3],
}

/// The diagonals of a centre strip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Strip {
    /// All forward.
    Forward,
    /// As on either side of the middle where the middle one alone is different.
    Mirrored,
    /// As in that middle.
    Middle,
}

/// The most quads that a centre strip has.
const MAX_STRIP: u32 = 62;

impl Stitches {
    /// Reads all stitches off the core.
    pub(crate) fn new(config: Config) -> Self {
        let mut all = Self {
            codes: Vec::new(),
            rings: [Table::default(); COUNTS],
            transitions: Vec::new(),
            strips: [Table::default(); 3],
        };
        if matches!(config.output, OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw) {
            all.transitions.resize(COUNTS * COUNTS, Table::default());
            all.read_transitions(config);
            all.read_rings(config);
            all.read_strips(config);
            all.codes.resize(all.codes.len() + STEP, 0); // strips are read from any quad on
        }
        all
    }

    /// Bytes of memory that the tables take.
    pub(crate) fn bytes(&self) -> usize {
        self.codes.capacity() + self.transitions.capacity() * size_of::<Table>() + size_of::<Self>()
    }

    /// The stitch between neighbouring rings whose inner row has `inner_points` points.
    #[inline(always)]
    pub(crate) fn ring(&self, inner_points: u32) -> Codes<'_> {
        self.get(self.rings[inner_points as usize % COUNTS])
    }

    /// The stitch between an outer edge and the first ring, by the point counts of the outer and
    /// of the inside factor.
    #[inline(always)]
    pub(crate) fn transition(&self, outer: u32, inside: u32) -> Codes<'_> {
        let at = outer as usize * COUNTS + inside as usize;
        self.get(self.transitions.get(at).copied().unwrap_or_default())
    }

    /// Some quads of a strip.
    #[inline(always)]
    pub(crate) fn strip(&self, strip: Strip, quads: Range<u32>) -> Codes<'_> {
        let Codes { codes, .. } = self.get(self.strips[strip as usize]);
        Codes {
            codes: codes.get(6 * quads.start as usize..).unwrap_or_default(),
            length: 6 * (quads.end - quads.start) as usize,
        }
    }

    #[inline(always)]
    fn get(&self, table: Table) -> Codes<'_> {
        Codes {
            codes: self.codes.get(table.first as usize..).unwrap_or_default(),
            length: table.length as usize,
        }
    }

    /// Adds a table, padded so that reading it in whole blocks stays within it.
    fn add(&mut self, codes: impl Iterator<Item = i8>) -> Table {
        let first = self.codes.len();
        self.codes.extend(codes);
        let length = self.codes.len() - first;
        self.codes.resize(first + length.next_multiple_of(STEP), 0);
        let in_u32 = |n| u32::try_from(n).unwrap_or(u32::MAX); // below 2^20
        Table { first: in_u32(first), length: in_u32(length) }
    }

    /// Edge 0 of quads runs along v, and its transition comes first.
    fn read_transitions(&mut self, config: Config) {
        for outer in 1..=64 {
            for inside in 1..=64 {
                let quad = Quad::new(config, [outer, 1, 1, 1], [2, inside]);
                let Some(quad) = quad else { continue };
                let [outer_points, ..] = quad.outer;
                let at = outer_points as usize * COUNTS + quad.inside[1] as usize;
                if self.transitions[at].length > 0 {
                    continue;
                }
                let first_ring: u32 = quad.outer.iter().map(|n| n - 1).sum();
                let length = quad.transition_indices(0);
                let indices = quad.output.indices[..length].iter();
                self.transitions[at] = self.add(indices.map(|&index| {
                    if index < outer_points {
                        code(index)
                    } else {
                        code(index - first_ring) + INNER
                    }
                }));
            }
        }
    }

    /// Edge 0 of the second ring of quads comes after the four transitions.
    fn read_rings(&mut self, config: Config) {
        for inside in 4..=64 {
            let Some(quad) = Quad::new(config, [1; 4], [6, inside]) else { continue };
            let inner_points = quad.inside[1] - 4;
            if self.rings[inner_points as usize].length > 0 {
                continue;
            }
            let outer = quad.outer.iter().map(|n| n - 1).sum::<u32>();
            let inner = outer + 2 * (quad.inside[0] - 3) + 2 * (quad.inside[1] - 3);
            let before: usize = (0..4).map(|edge| quad.transition_indices(edge)).sum();
            let length = 6 * inner_points as usize;
            let indices = quad.output.indices[before..before + length].iter();
            self.rings[inner_points as usize] = self.add(indices.map(|&index| {
                if index < inner { code(index - outer) } else { code(index - inner) + INNER }
            }));
        }
    }

    /// A strip's quads repeat: each is another one moved along both rows.
    fn read_strips(&mut self, config: Config) {
        let config = Config { partitioning: Partitioning::Integer, ..config }; // has odd factors
        let strips =
            [(Strip::Forward, [7, 3], 0), (Strip::Mirrored, [3, 7], 0), (Strip::Middle, [3, 7], 2)];
        for (strip, inside, k) in strips {
            let Some(quad) = Quad::new(config, [1; 4], inside) else { continue };
            let first_ring: u32 = quad.outer.iter().map(|n| n - 1).sum();
            let quads = quad.inside[0].abs_diff(quad.inside[1]) + 1;
            // Row A starts at the ring's second or first point; row B comes back to the point
            // before, so where A starts at the second, B's entry 0 is the ring's first.
            let a = if strip == Strip::Forward { first_ring + 1 } else { first_ring };
            let b = first_ring + 2 * quads + 1 + u32::from(strip == Strip::Forward);
            let indices = &quad.output.indices;
            let strip_indices = &indices[indices.len() - 6 * quads as usize..];
            let of_quad = &strip_indices[6 * k as usize..][..6];
            let codes: Vec<i8> = of_quad
                .iter()
                .map(|&index| {
                    if (a..=a + quads).contains(&index) {
                        code(index - a - k)
                    } else if strip == Strip::Forward && index == first_ring {
                        INNER
                    } else {
                        code(b - index - k) + INNER
                    }
                })
                .collect();
            let moved = |k| codes.iter().map(move |entry| entry + code(k));
            self.strips[strip as usize] = self.add((0..MAX_STRIP).flat_map(moved));
        }
    }
}

/// A quad of integer factors as the core tessellates it.
struct Quad {
    outer: [u32; 4],
    inside: [u32; 2],
    output: Tessellation,
}

impl Quad {
    /// The quad of these factors, raised to the partitioning's range; `None` if that makes it a
    /// minimum patch.
    fn new(config: Config, outer: [u8; 4], inside: [u8; 2]) -> Option<Self> {
        let [u0, v0, u1, v1] = outer.map(f32::from);
        let [inside_u, inside_v] = inside.map(f32::from);
        let factors = QuadFactors { u0, v0, u1, v1, inside_u, inside_v };
        let patch = Patch::new(config, PatchFactors::Quad(factors));
        let ProcessedPatch::Regular(PatchFactors::Quad(factors)) = patch.processed() else {
            return None;
        };
        let points = |factor: ProcessedFactor| factor.context.points;
        let (outer, inside) = (factors.outer().map(points), factors.inside().map(points));
        Some(Self { outer, inside, output: patch.tessellate() })
    }

    /// Indices of the transition along an edge: three for each of K + M - 2 triangles.
    fn transition_indices(&self, edge: usize) -> usize {
        let inside = self.inside[(edge + 1) % 2];
        3 * (self.outer[edge] + inside - 4) as usize
    }
}

/// A row position as a code. Positions are at most 64.
#[expect(clippy::cast_possible_truncation, reason = "at most 64")]
const fn code(position: u32) -> i8 {
    position as i8
}

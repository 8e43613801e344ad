//! The tables of stitches, made from the core's steps.

use super::rows::Codes;
use super::step_code::{self, CODES_AT_ONCE};
use alloc::vec::Vec;
use tess_core::stitch::{self, Diagonals};
use tess_core::{Config, OutputPrimitive, Partitioning, Side, Step};

/// The most points of an edge.
const MAX_POINTS: u32 = 65;
/// Length of a table by point count.
const COUNTS: usize = MAX_POINTS as usize + 1;
/// Length of a table by the points of an inner row between two rings, of which there are at most
/// 61.
const RINGS: usize = 62;
/// No centre strip has more quads.
const MAX_STRIP: u32 = 63;
/// Length of a table by quads.
const STRIPS: usize = MAX_STRIP as usize + 1;

/// The place of a stitch's codes, and their number without the padding.
#[derive(Clone, Copy, Debug, Default)]
struct Table {
    first: u32,
    length: u32,
}

/// Every stitch that a configuration can need.
///
/// About 870 KiB for integer partitionings and 200 to 290 KiB for fractional ones. Configurations
/// that make no triangles have empty tables.
#[derive(Clone, Debug)]
pub(crate) struct Stitches {
    codes: Vec<i8>,
    /// Indexed by the point counts of the outer edge and of the inside factor: [`transition`].
    transitions: Vec<Table>,
    /// Indexed by the point count of the inner row.
    rings: [Table; RINGS],
    /// The longest strip of forward diagonals; shorter strips are its beginning.
    forward: Table,
    /// The strips whose middle diagonal is not forward, indexed by their number of quads.
    except_middle: [Table; STRIPS],
}

impl Stitches {
    /// Makes the tables of a configuration.
    pub(crate) fn new(config: Config) -> Self {
        let mut all = Self {
            codes: Vec::new(),
            transitions: Vec::new(),
            rings: [Table::default(); RINGS],
            forward: Table::default(),
            except_middle: [Table::default(); STRIPS],
        };
        if matches!(config.output, OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw) {
            all.make(config);
        }
        all
    }

    fn make(&mut self, config: Config) {
        let output = config.output;
        self.transitions.resize(COUNTS * COUNTS, Table::default());
        let possible = |&points: &u32| can_have(config.partitioning, points);
        for outer in (2..=MAX_POINTS).filter(possible) {
            for inside in (3..=MAX_POINTS).filter(possible) {
                self.transitions[transition(outer, inside)] =
                    self.add(output, |to| stitch::transition(config.split, outer, inside, to));
            }
        }
        for (inner_points, table) in (1..).zip(1..RINGS) {
            self.rings[table] = self.add(output, |to| stitch::ring(inner_points, to));
        }
        for (quads, table) in (1..).zip(1..STRIPS) {
            self.except_middle[table] =
                self.add(output, |to| stitch::strip(quads, Diagonals::ForwardExceptMiddle, to));
        }
        self.forward = self.add(output, |to| stitch::strip(MAX_STRIP, Diagonals::Forward, to));
        self.codes.shrink_to_fit();
    }

    /// Adds the codes of the stitch whose steps `stitch` sends, padded to whole blocks.
    fn add(&mut self, output: OutputPrimitive, stitch: impl FnOnce(&mut dyn FnMut(Step))) -> Table {
        let first = self.codes.len();
        stitch(&mut |step| self.codes.extend(codes(step, output)));
        let length = self.codes.len() - first;
        self.codes.resize(first + length.next_multiple_of(CODES_AT_ONCE), 0);
        let in_u32 = |n| u32::try_from(n).unwrap_or(u32::MAX); // below 2^20
        Table { first: in_u32(first), length: in_u32(length) }
    }

    /// Bytes of memory that the tables take.
    pub(crate) fn bytes(&self) -> usize {
        self.codes.capacity() + self.transitions.capacity() * size_of::<Table>() + size_of::<Self>()
    }

    /// The stitch between an outer edge and the first ring, by the point counts of the outer and
    /// of the inside factor.
    #[inline(always)]
    pub(crate) fn transition(&self, outer: u32, inside: u32) -> Codes<'_> {
        let table = self.transitions.get(transition(outer, inside));
        self.get(table.copied().unwrap_or_default())
    }

    /// The stitch between neighbouring rings whose inner row has `inner_points` points.
    #[inline(always)]
    pub(crate) fn ring(&self, inner_points: u32) -> Codes<'_> {
        self.get(self.rings[inner_points as usize % RINGS])
    }

    /// The strip of this many quads.
    #[inline(always)]
    pub(crate) fn strip(&self, quads: u32, diagonals: Diagonals) -> Codes<'_> {
        match diagonals {
            Diagonals::Forward => {
                let Codes { codes, .. } = self.get(self.forward);
                Codes { codes, length: 6 * quads as usize }
            }
            Diagonals::ForwardExceptMiddle => self.get(self.except_middle[quads as usize % STRIPS]),
        }
    }

    #[inline(always)]
    fn get(&self, table: Table) -> Codes<'_> {
        Codes {
            codes: self.codes.get(table.first as usize..).unwrap_or_default(),
            length: table.length as usize,
        }
    }
}

/// The index of a transition's table.
#[inline(always)]
const fn transition(outer: u32, inside: u32) -> usize {
    outer as usize * COUNTS + inside as usize
}

/// Whether an edge can have this many points, which is one more than its segments.
const fn can_have(partitioning: Partitioning, points: u32) -> bool {
    match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => true,
        Partitioning::FractionalOdd => points.is_multiple_of(2),
        Partitioning::FractionalEven => !points.is_multiple_of(2),
    }
}

/// The codes of a step's triangle.
fn codes(step: Step, output: OutputPrimitive) -> [i8; 3] {
    let [a, b, c] = step.vertices().map(|(side, entry)| match side {
        Side::Outer => step_code::outer(entry),
        Side::Inner => step_code::inner(entry),
    });
    if output == OutputPrimitive::TriangleCcw { [a, c, b] } else { [a, b, c] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sizes that [`Stitches`], [`Tessellator`](crate::Tessellator) and the README state.
    #[test]
    fn tables_take_what_is_said() {
        for partitioning in Partitioning::ALL {
            for output in OutputPrimitive::ALL {
                let bytes = Stitches::new(Config::new(partitioning, output)).bytes();
                let expected = match (output, partitioning) {
                    (OutputPrimitive::Point | OutputPrimitive::Line, _) => 1000..2000,
                    (_, Partitioning::Integer | Partitioning::Pow2) => 850_000..900_000,
                    _ => 200_000..300_000,
                };
                assert!(expected.contains(&bytes), "{partitioning:?} {output:?}: {bytes} bytes");
            }
        }
    }
}

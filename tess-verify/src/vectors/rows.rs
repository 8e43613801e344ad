//! The rows of the CSV kinds.

use super::digest::{points_digest, words_digest};
use crate::case::Case;
use crate::names::Named;
use std::fmt;
use tess_core::prepare::{Prepared, Reduction, Request};
use tess_core::{Config, Domain, Parity, Partitioning, SplitOrder, Tessellation};

/// A row of a CSV kind: its values, and the text from which they were read.
#[derive(Clone, Debug)]
pub struct CsvRow {
    pub(super) line: u64,
    pub(super) text: String,
    pub(crate) values: Values,
}

/// The values of a row, by the kind of the file.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Values {
    Patch(PatchRow),
    Sweep(ChainRow),
    Uniform(ChainRow),
    Locations(LocationsRow),
    Factors(FactorsRow),
    Preparation(PreparationRow),
}

/// The counts and digests of a patch's output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sizes {
    /// The number of points.
    pub(crate) points: u64,
    /// The number of indices.
    pub(crate) indices: u64,
    /// The digest of the points.
    pub(crate) points_digest: u64,
    /// The digest of the indices.
    pub(crate) indices_digest: u64,
}

/// The counts and digests of one patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PatchRow {
    /// The tessellated case.
    pub(crate) case: Case,
    /// The counts and digests of its output.
    pub(crate) output: Sizes,
}

impl Sizes {
    /// The counts and digests of an output.
    pub(crate) fn of(output: &Tessellation) -> Self {
        Self {
            points: output.points.len() as u64,
            indices: output.indices.len() as u64,
            points_digest: points_digest(&output.points),
            indices_digest: words_digest(&output.indices),
        }
    }
}

/// The row as in a file of the kind `patches`.
impl fmt::Display for PatchRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Case { config: Config { partitioning, output, split }, factors } = self.case;
        let domain = self.case.domain().name();
        write!(f, "{domain},{},{},{},", partitioning.name(), output.name(), split.name())?;
        let bits = factors.iter().map(|factor| format!("{:08x}", factor.to_bits()));
        f.write_str(&bits.collect::<Vec<_>>().join(" "))?;
        let Sizes { points, indices, points_digest, indices_digest } = self.output;
        write!(f, ",{points},{indices},{points_digest:016x},{indices_digest:016x}")
    }
}

/// A digest chained over a sequence of patches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChainRow {
    /// The domain of the patches.
    pub(crate) domain: Domain,
    /// The configuration of the patches; the split order is ruler.
    pub(crate) config: Config,
    /// The number of the sequence; `golden/README.md` in the repository describes each.
    pub(crate) row: u8,
    /// The digest.
    pub(crate) chain: u64,
}

/// Digests over all factors with one integer part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocationsRow {
    /// The split order.
    pub(crate) split: SplitOrder,
    /// The parity.
    pub(crate) parity: Parity,
    /// The integer part of the factors.
    pub(crate) bucket: u32,
    /// The digest of the contexts.
    pub(crate) contexts_digest: u64,
    /// The digest of the locations.
    pub(crate) locations_digest: u64,
    /// The number of locations.
    pub(crate) locations: u64,
}

/// Digests over the processed factors of all binary32 numbers of a binade.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FactorsRow {
    /// The partitioning.
    pub(crate) partitioning: Partitioning,
    /// The binade [2^exponent, 2^(exponent + 1)).
    pub(crate) exponent: i32,
    /// The digest of the u = 0 factors.
    pub(crate) outer_digest: u64,
    /// The digest of the inside factors.
    pub(crate) inside_digest: u64,
}

/// A factor preparation and the tessellation of its rounded factors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreparationRow {
    /// The configuration; the split order is ruler.
    pub(crate) config: Config,
    /// How the inside factors are derived.
    pub(crate) reduction: Reduction,
    /// The factors to prepare.
    pub(crate) request: Request,
    /// The prepared factors.
    pub(crate) prepared: Prepared,
    /// The counts and digests of the tessellator's output.
    pub(crate) output: Sizes,
}

//! The rows of the CSV kinds.

use super::digest::{points_digest, words_digest};
use crate::case::Case;
use crate::names::Named;
use std::fmt;
use tess_core::prepare::{Prepared, Reduction, Request};
use tess_core::{Config, Domain, Parity, Partitioning, SplitOrder, Tessellation};

/// A row of a CSV kind: its values, and the text that they were read from.
#[derive(Clone, Debug)]
pub struct CsvRow {
    pub(super) line: u64,
    pub(super) text: String,
    pub(crate) values: Values,
}

/// The values of a row, by the kind of its file.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Values {
    Patch(PatchRow),
    Sweep(ChainRow),
    Uniform(ChainRow),
    Locations(LocationsRow),
    Factors(FactorsRow),
    Preparation(PreparationRow),
}

/// Counts and digests of a patch's output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sizes {
    /// Number of points.
    pub(crate) points: u64,
    /// Number of indices.
    pub(crate) indices: u64,
    /// Digest of the points.
    pub(crate) points_digest: u64,
    /// Digest of the indices.
    pub(crate) indices_digest: u64,
}

/// Counts and digests of one patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PatchRow {
    /// The tessellated case.
    pub(crate) case: Case,
    /// Counts and digests of its output.
    pub(crate) output: Sizes,
}

impl Sizes {
    /// Counts and digests of an output.
    pub(crate) fn of(output: &Tessellation) -> Self {
        Self {
            points: output.points.len() as u64,
            indices: output.indices.len() as u64,
            points_digest: points_digest(&output.points),
            indices_digest: words_digest(&output.indices),
        }
    }
}

/// The row as it stands in a file of the kind `patches`.
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
    /// Domain of the patches.
    pub(crate) domain: Domain,
    /// Configuration of the patches; the split order is ruler.
    pub(crate) config: Config,
    /// Which sequence: `golden/README.md` in the repository describes them.
    pub(crate) row: u8,
    /// The digest.
    pub(crate) chain: u64,
}

/// Digests over all fractions of a factor's integer part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocationsRow {
    /// Split order.
    pub(crate) split: SplitOrder,
    /// Parity.
    pub(crate) parity: Parity,
    /// Integer part of the factors.
    pub(crate) bucket: u32,
    /// Digest of the contexts.
    pub(crate) contexts_digest: u64,
    /// Digest of the locations.
    pub(crate) locations_digest: u64,
    /// How many locations.
    pub(crate) locations: u64,
}

/// Digests over the processed factors of all binary32 of a binade.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FactorsRow {
    /// Partitioning.
    pub(crate) partitioning: Partitioning,
    /// The binade [2^exponent, 2^(exponent + 1)).
    pub(crate) exponent: i32,
    /// Digest of the u = 0 factors.
    pub(crate) outer_digest: u64,
    /// Digest of the inside factors.
    pub(crate) inside_digest: u64,
}

/// A factor preparation and the tessellation of its rounded factors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreparationRow {
    /// Configuration; the split order is ruler.
    pub(crate) config: Config,
    /// How inside factors are made.
    pub(crate) reduction: Reduction,
    /// The factors to prepare.
    pub(crate) request: Request,
    /// The factors behind the preparation.
    pub(crate) prepared: Prepared,
    /// Counts and digests of the tessellator's output.
    pub(crate) output: Sizes,
}

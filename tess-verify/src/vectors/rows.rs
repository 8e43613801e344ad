//! The rows of the CSV kinds.

use super::digest::{points_digest, words_digest};
use crate::case::Case;
use crate::names::Named;
use std::fmt;
use tess_core::prepare::{Prepared, Reduction, Request};
use tess_core::{Config, Domain, Parity, Partitioning, SplitOrder, Tessellation};

/// A row of a CSV kind with the text that it was read from.
#[derive(Clone, Debug)]
pub struct Recorded<T> {
    /// The line of the file.
    pub line: u64,
    /// The row as it stands there.
    pub text: String,
    /// Its values.
    pub row: T,
}

impl<T> std::ops::Deref for Recorded<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.row
    }
}

/// Counts and digests of a patch's output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Number of points.
    pub points: u64,
    /// Number of indices.
    pub indices: u64,
    /// Digest of the points.
    pub points_digest: u64,
    /// Digest of the indices.
    pub indices_digest: u64,
}

/// Counts and digests of one patch.
#[derive(Clone, Copy, Debug)]
pub struct PatchRow {
    /// What was tessellated.
    pub case: Case,
    /// What came out.
    pub output: Sizes,
}

impl Sizes {
    /// Counts and digests of an output.
    #[must_use]
    pub fn of(output: &Tessellation) -> Self {
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
pub struct ChainRow {
    /// Domain of the patches.
    pub domain: Domain,
    /// Configuration of the patches; the split order is ruler.
    pub config: Config,
    /// Which sequence: `golden/README.md` in the repository describes them.
    pub row: u8,
    /// The digest.
    pub chain: u64,
}

/// Digests over all fractions of a factor's integer part.
#[derive(Clone, Copy, Debug)]
pub struct LocationsRow {
    /// Split order.
    pub split: SplitOrder,
    /// Parity.
    pub parity: Parity,
    /// Integer part of the factors.
    pub bucket: u32,
    /// Digest of the contexts.
    pub contexts_digest: u64,
    /// Digest of the locations.
    pub locations_digest: u64,
    /// How many locations.
    pub locations: u64,
}

/// Digests over the processed factors of all binary32 of a binade.
#[derive(Clone, Copy, Debug)]
pub struct FactorsRow {
    /// Partitioning.
    pub partitioning: Partitioning,
    /// The binade [2^exponent, 2^(exponent + 1)).
    pub exponent: i32,
    /// Digest of the u = 0 factors.
    pub outer_digest: u64,
    /// Digest of the inside factors.
    pub inside_digest: u64,
}

/// A factor preparation and the tessellation of its rounded factors.
#[derive(Clone, Copy, Debug)]
pub struct PreparationRow {
    /// Configuration; the split order is ruler.
    pub config: Config,
    /// How inside factors are made.
    pub reduction: Reduction,
    /// What is prepared.
    pub request: Request,
    /// What comes out of the preparation.
    pub prepared: Prepared,
    /// What comes out of the tessellator.
    pub output: Sizes,
}

//! The records of each kind of vector file.

use super::error::VectorError;
use super::header::Kind;
use super::listing::Listing;
use super::row::Row;
use crate::case::Case;
use crate::digest::{points_digest, words_digest};
use crate::names::Named;
use std::fmt;
use std::ops::RangeInclusive;
use tess_core::Tessellation;
use tess_core::prepare::{Prepared, QuadAxes, Reduction, Request};
use tess_core::{Config, Domain, OutputPrimitive, Parity, Partitioning, PatchFactors, SplitOrder};

/// One record.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Record {
    /// Of the kind `listings`.
    Listing(Listing),
    /// Of the kind `patches`.
    Patch(Recorded<PatchRow>),
    /// Of the kind `sweep`.
    Sweep(Recorded<ChainRow>),
    /// Of the kind `uniform`.
    Uniform(Recorded<ChainRow>),
    /// Of the kind `locations`.
    Locations(Recorded<LocationsRow>),
    /// Of the kind `factors`.
    Factors(Recorded<FactorsRow>),
    /// Of the kind `preparation`.
    Preparation(Recorded<PreparationRow>),
}

impl Record {
    /// The line of the file that it starts on.
    #[must_use]
    pub const fn line(&self) -> u64 {
        match self {
            Self::Listing(listing) => listing.line,
            Self::Patch(row) => row.line,
            Self::Sweep(row) | Self::Uniform(row) => row.line,
            Self::Locations(row) => row.line,
            Self::Factors(row) => row.line,
            Self::Preparation(row) => row.line,
        }
    }

    /// The row as it stands in the file; `None` for a listing, which has no row.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Listing(_) => None,
            Self::Patch(row) => Some(&row.text),
            Self::Sweep(row) | Self::Uniform(row) => Some(&row.text),
            Self::Locations(row) => Some(&row.text),
            Self::Factors(row) => Some(&row.text),
            Self::Preparation(row) => Some(&row.text),
        }
    }
}

/// A row of a CSV kind with the text that it was read from.
#[derive(Clone, Debug)]
pub struct Recorded<T> {
    /// The line of the file.
    pub line: u64,
    /// The row as it stands there.
    pub text: String,
    /// What it says.
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
    /// Which sequence; see [`crate::sequences`].
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

/// Reads one row of a CSV kind.
pub(super) fn read(kind: Kind, row: &Row<'_>) -> Result<Record, VectorError> {
    fn recorded<T>(row: &Row<'_>, parsed: T) -> Recorded<T> {
        Recorded { line: row.line(), text: row.text(), row: parsed }
    }
    Ok(match kind {
        // Listings have no rows.
        Kind::Listings => return Err(row.error("kind", "listings are not rows")),
        Kind::Patches => Record::Patch(recorded(row, patch_row(row)?)),
        Kind::Sweep => Record::Sweep(recorded(row, chain_row(row, 1..=64, |_| 64)?)),
        Kind::Uniform => {
            let cases = |row| if row == 65 { 1 } else { 100 };
            Record::Uniform(recorded(row, chain_row(row, 0..=65, cases)?))
        }
        Kind::Locations => Record::Locations(recorded(row, locations_row(row)?)),
        Kind::Factors => Record::Factors(recorded(row, factors_row(row)?)),
        Kind::Preparation => Record::Preparation(recorded(row, preparation_row(row)?)),
    })
}

fn patch_row(row: &Row<'_>) -> Result<PatchRow, VectorError> {
    let config = Config {
        partitioning: row.named::<Partitioning>("partitioning")?,
        output: row.named::<OutputPrimitive>("output")?,
        split: row.named::<SplitOrder>("split")?,
    };
    let domain = row.named::<Domain>("domain")?;
    let factors = factors(row, "factors_f32_hex", domain)?;
    Ok(PatchRow { case: Case { config, factors }, output: sizes(row)? })
}

fn factors(
    row: &Row<'_>,
    column: &'static str,
    domain: Domain,
) -> Result<PatchFactors, VectorError> {
    let list = row.floats(column)?;
    PatchFactors::from_slice(domain, &list)
        .ok_or_else(|| wrong_number(row, column, domain, list.len()))
}

fn wrong_number(row: &Row<'_>, column: &'static str, domain: Domain, found: usize) -> VectorError {
    let names = domain.factor_names();
    row.error(column, format!("expected {} ({}), found {found}", names.len(), names.join(" ")))
}

fn sizes(row: &Row<'_>) -> Result<Sizes, VectorError> {
    Ok(Sizes {
        points: row.number("points")?,
        indices: row.number("indices")?,
        points_digest: row.digest("points_fnv1a64")?,
        indices_digest: row.digest("indices_fnv1a64")?,
    })
}

fn chain_row(
    row: &Row<'_>,
    rows: RangeInclusive<u8>,
    cases: impl Fn(u8) -> u32,
) -> Result<ChainRow, VectorError> {
    let number = row.number_in("row", rows)?;
    row.number_in("cases", cases(number)..=cases(number))?;
    Ok(ChainRow {
        domain: row.named("domain")?,
        config: Config::new(row.named("partitioning")?, row.named("output")?),
        row: number,
        chain: row.digest("chain_fnv1a64")?,
    })
}

fn locations_row(row: &Row<'_>) -> Result<LocationsRow, VectorError> {
    let parity: Parity = row.named("parity")?;
    let buckets = match parity {
        Parity::Even => 2..=64,
        Parity::Odd => 1..=63,
    };
    Ok(LocationsRow {
        split: row.named("split")?,
        parity,
        bucket: row.number_in("factor_bucket", buckets)?,
        contexts_digest: row.digest("contexts_fnv1a64")?,
        locations_digest: row.digest("locations_fnv1a64")?,
        locations: row.number("locations")?,
    })
}

fn factors_row(row: &Row<'_>) -> Result<FactorsRow, VectorError> {
    Ok(FactorsRow {
        partitioning: row.named("partitioning")?,
        exponent: row.number_in("exponent", -126..=127)?,
        outer_digest: row.digest("outer_fnv1a64")?,
        inside_digest: row.digest("inside_fnv1a64")?,
    })
}

fn preparation_row(row: &Row<'_>) -> Result<PreparationRow, VectorError> {
    let domain = row.named("domain")?;
    let prepared = Prepared {
        unrounded: factors(row, "unrounded_f32_hex", domain)?,
        rounded: factors(row, "rounded_f32_hex", domain)?,
    };
    Ok(PreparationRow {
        config: Config::new(row.named("partitioning")?, row.named("output")?),
        reduction: row.named("reduction")?,
        request: request(row, domain)?,
        prepared,
        output: sizes(row)?,
    })
}

fn request(row: &Row<'_>, domain: Domain) -> Result<Request, VectorError> {
    let axes: QuadAxes = row.named("axis")?;
    Ok(match factors(row, "input_f32_hex", domain)? {
        PatchFactors::Isoline(factors) => Request::Isoline(factors),
        PatchFactors::Triangle(factors) => Request::Triangle(factors),
        PatchFactors::Quad(factors) => Request::Quad(factors, axes),
    })
}

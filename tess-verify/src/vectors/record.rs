//! The records of each kind of vector file.

use super::coordinates::{self, Coordinates};
use super::error::VectorError;
use super::header::Kind;
use super::lines::Lines;
use super::listing::{self, Listing};
use super::row::Row;
use super::rows::{
    ChainRow, CsvRow, FactorsRow, LocationsRow, PatchRow, PreparationRow, Sizes, Values,
};
use crate::case::{Case, CaseError};
use std::fmt;
use std::io::BufRead;
use std::ops::RangeInclusive;
use tess_core::prepare::{Prepared, Request};
use tess_core::{Config, Domain, OutputPrimitive, Parity, Partitioning, PatchFactors, SplitOrder};

/// One record.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Record {
    /// A record of the kind `listings`.
    Listing(Listing),
    /// A record of the kind `listings`, by coordinates.
    Coordinates(Coordinates),
    /// A record of any other kind.
    Row(CsvRow),
}

impl Record {
    /// The line of the file that it starts on.
    #[must_use]
    pub const fn line(&self) -> u64 {
        match self {
            Self::Listing(listing) => listing.line,
            Self::Coordinates(coordinates) => coordinates.line,
            Self::Row(row) => row.line,
        }
    }

    /// The record's patch; `None` for a row of digests over many patches.
    #[must_use]
    pub const fn case(&self) -> Option<Case> {
        match self {
            Self::Listing(listing) => Some(listing.case),
            Self::Coordinates(coordinates) => Some(coordinates.case),
            Self::Row(row) => match &row.values {
                Values::Patch(row) => Some(row.case),
                Values::Preparation(row) => {
                    Some(Case { config: row.config, factors: row.prepared.rounded })
                }
                _ => None,
            },
        }
    }

    /// The row as it is in the file; `None` for a listing.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Listing(_) | Self::Coordinates(_) => None,
            Self::Row(row) => Some(&row.text),
        }
    }
}

/// The record as in a file; a listing by coordinates is in the notation `hex`.
impl fmt::Display for Record {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Listing(listing) => listing.fmt(f),
            Self::Coordinates(coordinates) => coordinates.fmt(f),
            Self::Row(row) => writeln!(f, "{}", row.text),
        }
    }
}

/// Reads a listing of either form. Its first line has already been read. Errors mention that line
/// and the record's `number`.
pub(super) fn read_listing<R: BufRead>(
    lines: &mut Lines<R>,
    number: u64,
) -> Result<Record, VectorError> {
    let first = lines.last();
    let parsed: Result<Case, CaseError> = first.text.parse();
    let case = parsed.map_err(|error| first.error(error.field, error.message))?;
    let start = first.place.line;
    let record = read_output(lines, case, start);
    record.map_err(|error| {
        let message = format!("{} (record {number}, from line {start}: {case})", error.message);
        VectorError { message, ..error }
    })
}

fn read_output<R: BufRead>(
    lines: &mut Lines<R>,
    case: Case,
    start: u64,
) -> Result<Record, VectorError> {
    if coordinates::is_announced(&lines.expect("points")?) {
        return coordinates::read(lines, case, start).map(Record::Coordinates);
    }
    listing::read(lines, case, start).map(Record::Listing)
}

/// Reads a row of a CSV kind.
pub(super) fn read_row(kind: Kind, row: &Row<'_>) -> Result<Record, VectorError> {
    let values = match kind {
        // Listings have no rows.
        Kind::Listings => return Err(row.error("kind", "listings are not rows")),
        Kind::Patches => Values::Patch(patch_row(row)?),
        Kind::Sweep => Values::Sweep(chain_row(row, 1..=64, |_| 64)?),
        Kind::Uniform => {
            Values::Uniform(chain_row(row, 0..=65, |row| if row == 65 { 1 } else { 100 })?)
        }
        Kind::Locations => Values::Locations(locations_row(row)?),
        Kind::Factors => Values::Factors(factors_row(row)?),
        Kind::Preparation => Values::Preparation(preparation_row(row)?),
    };
    Ok(Record::Row(CsvRow { line: row.line(), text: row.text(), values }))
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
    PatchFactors::from_slice(domain, &list).ok_or_else(|| {
        let (names, found) = (domain.factor_names(), list.len());
        row.error(column, format!("expected {} ({}), found {found}", names.len(), names.join(" ")))
    })
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
        request: Request::from_record(factors(row, "input_f32_hex", domain)?, row.named("axis")?),
        prepared,
        output: sizes(row)?,
    })
}

//! The kinds whose records are patches: single ones, and sequences with one digest each.

use super::sequences;
use super::{Found, How, Tested, device, stages};
use crate::backend::{Answers, Backend, BackendError, batch, tessellate};
use crate::case::Case;
use crate::check::compare::{self, Element, Mismatch, SpecStage};
use crate::core_backend::CoreBackend;
use crate::strength::Strength;
use crate::vectors::Fnv1a;
use crate::vectors::{ChainRow, PreparationRow, Record, Sizes, Values};
use tess_core::prepare::prepare;
use tess_core::{PatchFactors, Tessellation};

/// Checks listings, patches and preparations.
pub(super) fn single(how: &How, backend: &mut dyn Backend, records: &[Record]) -> Answers<Found> {
    match how.tested {
        Tested::Backend => {}
        Tested::Listings(strength) => return Ok(listings(records, strength)),
        Tested::Answers => return Ok(records.iter().map(|_| Found::Equal).collect()),
    }
    let cases: Vec<Case> = records.iter().filter_map(Record::case).collect();
    let outputs = tessellate(backend, &cases)?;
    let mut found = Vec::with_capacity(records.len());
    for ((record, case), output) in records.iter().zip(&cases).zip(&outputs) {
        found.push(Found::new(compare_one(backend, record, case, output)?, Some(*case)));
    }
    Ok(found)
}

/// Checks the listings of a device.
fn listings(records: &[Record], strength: Strength) -> Vec<Found> {
    let listing = |record: &Record| match record {
        Record::Listing(listing) => Some(device::check(&listing.case, &listing.output, strength)),
        Record::Coordinates(coordinates) => Some(device::check_coordinates(coordinates, strength)),
        _ => None,
    };
    records.iter().filter_map(listing).collect()
}

fn compare_one(
    backend: &mut dyn Backend,
    record: &Record,
    case: &Case,
    output: &Tessellation,
) -> Result<Option<Mismatch>, BackendError> {
    match record {
        Record::Listing(listing) => {
            let found = Mismatch::between(case, output, &listing.output);
            Ok(found.map(|mismatch| stages::trace(backend, case, mismatch)))
        }
        Record::Coordinates(coordinates) => {
            Ok(compare::sequences(case, output, &coordinates.output()))
        }
        Record::Row(row) => match &row.values {
            Values::Patch(row) => sizes(backend, case, output, &row.output),
            Values::Preparation(row) => match prepared(row) {
                Some(mismatch) => Ok(Some(mismatch)),
                None => sizes(backend, case, output, &row.output),
            },
            _ => Ok(None),
        },
    }
}

/// Compares an output with recorded counts and digests. A difference is narrowed down to the first
/// element that differs from the model's.
fn sizes(
    backend: &mut dyn Backend,
    case: &Case,
    observed: &Tessellation,
    expected: &Sizes,
) -> Result<Option<Mismatch>, BackendError> {
    let sizes = Sizes::of(observed);
    if sizes == *expected {
        return Ok(None);
    }
    let found = Mismatch::between(case, observed, &case.patch().tessellate());
    if let Some(mismatch) = found {
        return Ok(Some(stages::trace(backend, case, mismatch)));
    }
    let digest = Mismatch::digest;
    Ok(Mismatch::count("points", sizes.points, expected.points)
        .or_else(|| Mismatch::count("indices", sizes.indices, expected.indices))
        .or_else(|| {
            digest("points", sizes.points_digest, expected.points_digest, SpecStage::Location)
        })
        .or_else(|| {
            digest("indices", sizes.indices_digest, expected.indices_digest, SpecStage::Stitch)
        }))
}

/// Compares the model's factor preparation with the recorded one; no backend implements it.
fn prepared(row: &PreparationRow) -> Option<Mismatch> {
    let observed = prepare(row.config.partitioning, row.reduction, row.request);
    let results = [
        ("unrounded", observed.unrounded, row.prepared.unrounded),
        ("rounded", observed.rounded, row.prepared.rounded),
    ];
    results.into_iter().find_map(|(result, observed, expected)| {
        let bits = observed.map(f32::to_bits).iter().zip(expected.map(f32::to_bits).iter());
        let mut named = expected.domain().factor_names().iter().zip(bits);
        let (&factor, (observed, expected)) = named.find(|(_, (o, e))| o != e)?;
        let element = Element::Prepared { result, factor };
        Some(Mismatch::hex(element, 8, observed, expected, SpecStage::Preparation))
    })
}

/// Checks a row of a systematic sweep.
pub(super) fn sweep(backend: &mut dyn Backend, row: &ChainRow) -> Result<Found, BackendError> {
    let patches = sequences::sweep(row.domain, row.config.partitioning, row.row);
    chain(backend, row, &patches)
}

/// Checks a row of patches whose factors are all equal.
pub(super) fn uniform(backend: &mut dyn Backend, row: &ChainRow) -> Result<Found, BackendError> {
    chain(backend, row, &sequences::uniform(row.domain, row.row))
}

fn chain(
    backend: &mut dyn Backend,
    row: &ChainRow,
    patches: &[PatchFactors],
) -> Result<Found, BackendError> {
    let observed = batch(backend, row.config, patches)?;
    let mut digest = Fnv1a::default();
    observed.iter().for_each(|patch| digest.patch(patch));
    if digest.finish() == row.chain {
        return Ok(Found::Equal);
    }
    let expected = CoreBackend.tessellate(row.config, patches)?;
    for ((&factors, observed), expected) in patches.iter().zip(&observed).zip(&expected) {
        let case = Case { config: row.config, factors };
        if let Some(mismatch) = Mismatch::between(&case, observed, expected) {
            return Ok(Found::Different(stages::trace(backend, &case, mismatch), Some(case)));
        }
    }
    let mismatch =
        Mismatch::digest("chained patches", digest.finish(), row.chain, SpecStage::Unknown);
    Ok(Found::new(mismatch, None))
}

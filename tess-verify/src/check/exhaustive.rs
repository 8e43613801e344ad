//! The exhaustive kinds: all fixed-point factors, and all binary32 numbers of a binade.

use crate::backend::{Backend, BackendError, all_answered};
use crate::check::compare::{self, Mismatch, SpecStage};
use crate::check::sequences::{BINADE_SIZE, binade, bucket};
use crate::core_backend::CoreBackend;
use crate::vectors::{FactorsRow, LocationsRow};
use crate::vectors::{Fnv1a, words_digest};
use tess_core::FixedFactor;

/// Checks the contexts and locations of all factors with one integer part. Locations are computed
/// from the model's contexts, so a wrong context neither hides nor fakes a wrong location.
pub(super) fn locations(
    backend: &mut dyn Backend,
    row: &LocationsRow,
) -> Result<Option<Mismatch>, BackendError> {
    let factors: Vec<FixedFactor> = bucket(row.parity, row.bucket).collect();
    let contexts = CoreBackend.contexts(row.split, row.parity, &factors)?;
    let answers = backend.contexts(row.split, row.parity, &factors)?;
    let observed = all_answered(backend, "contexts", answers, factors.len())?;
    let mut digest = Fnv1a::default();
    observed.iter().for_each(|context| digest.context(context));
    // The digest does not cover the parity.
    if digest.finish() != row.contexts_digest || observed != contexts {
        let digest = || {
            let (observed, expected) = (digest.finish(), row.contexts_digest);
            Mismatch::digest("contexts", observed, expected, SpecStage::Context)
        };
        return Ok(compare::contexts(&factors, &observed, &contexts).or_else(digest));
    }
    let observed = backend.locations(&contexts)?;
    let (count, digest) = (observed.len() as u64, words_digest(&observed));
    if (count, digest) == (row.locations, row.locations_digest) {
        return Ok(None);
    }
    let expected = CoreBackend.locations(&contexts)?;
    Ok(compare::locations(&factors, &contexts, &observed, &expected)
        .or_else(|| Mismatch::count("locations", count, row.locations))
        .or_else(|| {
            Mismatch::digest("locations", digest, row.locations_digest, SpecStage::Location)
        }))
}

/// The number of binary32 numbers per call of the backend.
const CHUNK: u32 = 1 << 16;

/// Checks factor processing of every binary32 number of a binade.
pub(super) fn factors(
    backend: &mut dyn Backend,
    row: &FactorsRow,
) -> Result<Option<Mismatch>, BackendError> {
    let (mut outer, mut inside) = (Fnv1a::default(), Fnv1a::default());
    for start in (0..BINADE_SIZE).step_by(CHUNK as usize) {
        for [of_edge, of_inside] in chunk(backend, row, start)?.1 {
            outer.words([of_edge.to_bits()]);
            inside.words([of_inside.to_bits()]);
        }
    }
    let (outer, inside) = (outer.finish(), inside.finish());
    if (outer, inside) == (row.outer_digest, row.inside_digest) {
        return Ok(None);
    }
    for start in (0..BINADE_SIZE).step_by(CHUNK as usize) {
        let (values, observed) = chunk(backend, row, start)?;
        let expected = CoreBackend.fixed_factors(row.partitioning, &values)?;
        let found = compare::fixed_factors(&values, &observed, &expected);
        if found.is_some() {
            return Ok(found);
        }
    }
    let digest =
        |what, observed, expected| Mismatch::digest(what, observed, expected, SpecStage::Factors);
    Ok(digest("outer factors", outer, row.outer_digest)
        .or_else(|| digest("inside factors", inside, row.inside_digest)))
}

type ValuesAndFactors = (Vec<f32>, Vec<[FixedFactor; 2]>);

fn chunk(
    backend: &mut dyn Backend,
    row: &FactorsRow,
    start: u32,
) -> Result<ValuesAndFactors, BackendError> {
    let values: Vec<f32> = binade(row.exponent, start..start + CHUNK).collect();
    let answers = backend.fixed_factors(row.partitioning, &values)?;
    let factors = all_answered(backend, "factors", answers, values.len())?;
    Ok((values, factors))
}

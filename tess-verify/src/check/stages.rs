//! Finds the stage of a backend that goes wrong on a patch.

use crate::backend::{Backend, BackendError, all_answered};
use crate::case::Case;
use crate::check::compare::{Mismatch, SpecStage};
use crate::core_backend::CoreBackend;
use tess_core::{FactorContext, ProcessedFactor};

/// The mismatch with the earliest stage that the backend gets wrong on this patch, when asked for
/// its stages one by one. The stage stays as it is if the backend gets all of them right, or does
/// not answer.
pub(super) fn trace(backend: &mut dyn Backend, case: &Case, mismatch: Mismatch) -> Mismatch {
    let patch = case.patch();
    let processed: Vec<_> =
        patch.processed().factors().into_iter().flat_map(|f| f.iter()).collect();
    // An error is ignored: a backend that has no stages returns one, and one that failed will fail
    // again on its next patch.
    let is_wrong = |agree: Result<bool, BackendError>| agree.is_ok_and(|agree| !agree);
    let stage = if is_wrong(factors_agree(backend, case)) {
        SpecStage::Factors
    } else if is_wrong(contexts_agree(backend, case, &processed)) {
        SpecStage::Context
    } else if is_wrong(locations_agree(backend, &processed)) {
        SpecStage::Location
    } else {
        mismatch.stage
    };
    Mismatch { stage, ..mismatch }
}

fn factors_agree(backend: &mut dyn Backend, case: &Case) -> Result<bool, BackendError> {
    let raw: Vec<f32> = case.factors.iter().collect();
    let partitioning = case.config.partitioning;
    let answers = backend.fixed_factors(partitioning, &raw)?;
    let observed = all_answered(backend, "factors", answers, raw.len())?;
    Ok(observed == CoreBackend.fixed_factors(partitioning, &raw)?)
}

fn contexts_agree(
    backend: &mut dyn Backend,
    case: &Case,
    processed: &[ProcessedFactor],
) -> Result<bool, BackendError> {
    for factor in processed {
        let context = factor.context;
        let answer = backend.contexts(case.config.split, context.parity, &[factor.fixed])?;
        if answer != [context] {
            return Ok(false);
        }
    }
    Ok(true)
}

fn locations_agree(
    backend: &mut dyn Backend,
    processed: &[ProcessedFactor],
) -> Result<bool, BackendError> {
    let contexts: Vec<FactorContext> = processed.iter().map(|factor| factor.context).collect();
    Ok(backend.locations(&contexts)? == CoreBackend.locations(&contexts)?)
}

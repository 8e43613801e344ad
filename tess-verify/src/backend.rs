//! The interface between a comparison and an implementation, stage by stage.

use crate::case::Case;
use std::error::Error;
use tess_core::{
    Config, Domain, FactorContext, FixedFactor, Parity, Partitioning, PatchFactors, SplitOrder,
    Tessellation,
};

/// An implementation of the specification under test.
///
/// Every method takes a batch, in any number, zero included, and answers in the same order. An
/// implementation that gives whole patches alone needs no more than the first three methods: the
/// others answer with an error, and a difference then points to the stage that its output shows.
pub trait Backend: Send {
    /// Its name, as `--backend` takes it: `core`, `simd` or `gpu`.
    fn name(&self) -> &'static str;

    /// Its device here: a CPU level or the name of an adapter.
    fn device(&self) -> String;

    /// Whole patches, all of one domain.
    ///
    /// # Errors
    /// [`BackendError`] if the implementation could not run; never for any factor.
    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation>;

    /// Factor processing (spec section 3) alone: for each value `x` the fixed-point u = 0 factor of
    /// the triangle patch (x, 3, 3; 3), zero if it is culled, and the inside factor of (3, 3, 3;
    /// x).
    ///
    /// Where (x, 3, 3; x) is not culled, its factors are the same (`golden/factor.csv` has those).
    ///
    /// # Errors
    /// As for [`Backend::tessellate`].
    fn fixed_factors(
        &mut self,
        partitioning: Partitioning,
        values: &[f32],
    ) -> Answers<[FixedFactor; 2]> {
        let _ = (partitioning, values);
        Err(whole_patches_alone(self.name()))
    }

    /// Contexts (spec section 4) of fixed-point factors in range.
    ///
    /// # Errors
    /// As for [`Backend::tessellate`].
    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Answers<FactorContext> {
        let _ = (split, parity, factors);
        Err(whole_patches_alone(self.name()))
    }

    /// The 16.16 locations (spec section 5) of all points of each context, one after another.
    ///
    /// # Errors
    /// As for [`Backend::tessellate`].
    fn locations(&mut self, contexts: &[FactorContext]) -> Answers<u32> {
        let _ = contexts;
        Err(whole_patches_alone(self.name()))
    }
}

fn whole_patches_alone(name: &str) -> BackendError {
    BackendError::new(format!("{name} gives whole patches alone, no stages"))
}

/// Answers of an implementation to a batch, one for each element, in their order; or why it could
/// not run.
pub type Answers<T> = Result<Vec<T>, BackendError>;

/// An implementation could not run: no adapter, no such CPU level, a device lost.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct BackendError {
    /// The cause and what would help.
    pub message: String,
    /// The error underneath, if there is one.
    pub source: Option<Box<dyn Error + Send + Sync>>,
}

impl BackendError {
    /// An error with no other underneath, of a text or of what shows as one.
    #[must_use]
    #[expect(clippy::needless_pass_by_value, reason = "for map_err")]
    pub fn new(message: impl ToString) -> Self {
        Self { message: message.to_string(), source: None }
    }

    /// The answer of an implementation that does not have a configuration. A fuzz target leaves
    /// such a case out:
    ///
    /// ```
    /// use tess_verify::BackendError;
    ///
    /// assert!(BackendError::unsupported("no isolines").is_unsupported());
    /// assert!(!BackendError::new("the device is lost").is_unsupported());
    /// ```
    #[must_use]
    pub fn unsupported(message: impl Into<String>) -> Self {
        Self { message: message.into(), source: Some(Box::new(Unsupported)) }
    }

    /// Whether the implementation does not have the configuration: nothing was compared.
    #[must_use]
    pub fn is_unsupported(&self) -> bool {
        self.source.as_deref().is_some_and(|source| source.is::<Unsupported>())
    }
}

/// Why a configuration could not run: there is none in the implementation.
#[derive(Debug, thiserror::Error)]
#[error("the configuration is not supported")]
struct Unsupported;

/// Refuses answers that are more or fewer than were asked for.
pub(crate) fn all_answered<T>(
    backend: &dyn Backend,
    what: &str,
    answers: Vec<T>,
    asked: usize,
) -> Answers<T> {
    if answers.len() == asked {
        return Ok(answers);
    }
    let (name, got) = (backend.name(), answers.len());
    Err(BackendError::new(format!("{name} answered with {got} {what}, {asked} were asked for")))
}

/// Tessellates cases of any configurations, those of equal configuration in one batch.
///
/// # Errors
/// As for [`Backend::tessellate`]; a number of answers that is not the number of patches.
pub(crate) fn tessellate(backend: &mut dyn Backend, cases: &[Case]) -> Answers<Tessellation> {
    let mut groups: Vec<((Config, Domain), Vec<usize>)> = Vec::new();
    for (i, case) in cases.iter().enumerate() {
        let key = (case.config, case.domain());
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, members)) => members.push(i),
            None => groups.push((key, vec![i])),
        }
    }
    let mut outputs = vec![Tessellation::default(); cases.len()];
    for ((config, _), members) in groups {
        let factors: Vec<_> = members.iter().map(|&i| cases[i].factors).collect();
        for (i, output) in members.into_iter().zip(batch(backend, config, &factors)?) {
            outputs[i] = output;
        }
    }
    Ok(outputs)
}

/// Tessellates patches of one configuration.
///
/// # Errors
/// As for [`tessellate`].
pub(crate) fn batch(
    backend: &mut dyn Backend,
    config: Config,
    factors: &[PatchFactors],
) -> Answers<Tessellation> {
    let answers = backend.tessellate(config, factors)?;
    all_answered(backend, "patches", answers, factors.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Whole;

    impl Backend for Whole {
        fn name(&self) -> &'static str {
            "whole"
        }

        fn device(&self) -> String {
            String::new()
        }

        fn tessellate(&mut self, _: Config, _: &[PatchFactors]) -> Answers<Tessellation> {
            Ok(Vec::new())
        }
    }

    #[test]
    fn stages_that_there_are_not_are_errors() {
        let messages = [
            Whole.fixed_factors(Partitioning::Integer, &[]).expect_err("no stage").to_string(),
            Whole.contexts(SplitOrder::Ruler, Parity::Odd, &[]).expect_err("no stage").to_string(),
            Whole.locations(&[]).expect_err("no stage").to_string(),
        ];
        assert_eq!(messages, ["whole gives whole patches alone, no stages"; 3]);
    }

    #[test]
    fn what_is_not_supported_has_a_source() {
        let error = BackendError::unsupported("no isolines");
        assert!(error.is_unsupported() && error.to_string() == "no isolines", "{error}");
        let source = error.source().expect("a source").to_string();
        assert_eq!(source, "the configuration is not supported");
        let other =
            BackendError { source: Some(Box::new(std::fmt::Error)), ..BackendError::new("lost") };
        assert!(!other.is_unsupported(), "another source");
    }
}

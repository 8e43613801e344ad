//! The interface between a comparison and the implementation that it tests, stage by stage.

use crate::case::Case;
use std::error::Error;
use tess_core::{
    Config, Domain, FactorContext, FixedFactor, Parity, Partitioning, PatchFactors, SplitOrder,
    Tessellation,
};

/// An implementation of the specification under test.
///
/// Every method takes a batch of any length, including zero, and returns one answer per element, in
/// order. An implementation that only produces whole patches needs only the first three methods:
/// the others return an error, and a difference then names the stage that the output points to.
pub trait Backend: Send {
    /// The name that `--backend` takes: `core`, `simd` or `gpu`.
    fn name(&self) -> &'static str;

    /// The device it runs on here: a CPU level or the name of an adapter.
    fn device(&self) -> String;

    /// Tessellates whole patches, all of one domain.
    ///
    /// # Errors
    /// [`BackendError`] if the implementation could not run; no factor value is an error.
    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation>;

    /// Runs only factor processing (spec section 3). For each value `x`, returns two fixed-point
    /// factors: the u = 0 factor of the triangle patch (x, 3, 3; 3), or zero if that patch is
    /// culled, and the inside factor of (3, 3, 3; x).
    ///
    /// Where (x, 3, 3; x) is not culled, it has the same two factors; `golden/factor.csv` records
    /// those.
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

    /// The contexts (spec section 4) of fixed-point factors, all in range.
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
    BackendError::new(format!("{name} only produces whole patches, not single stages"))
}

/// The answers to a batch, one per element and in order, or the reason why the implementation could
/// not run.
pub type Answers<T> = Result<Vec<T>, BackendError>;

/// The implementation could not run: no adapter, a CPU level that is missing, a lost device.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct BackendError {
    /// The cause and a remedy.
    pub message: String,
    /// The underlying error, if there is one.
    pub source: Option<Box<dyn Error + Send + Sync>>,
}

impl BackendError {
    /// An error without an underlying one.
    #[must_use]
    #[expect(clippy::needless_pass_by_value, reason = "for map_err")]
    pub fn new(message: impl ToString) -> Self {
        Self { message: message.to_string(), source: None }
    }

    /// The error of an implementation that lacks a configuration. A fuzz target skips such a case:
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

    /// Whether the implementation lacks the configuration, so that nothing was compared.
    #[must_use]
    pub fn is_unsupported(&self) -> bool {
        self.source.as_deref().is_some_and(|source| source.is::<Unsupported>())
    }
}

/// The source of an error that [`BackendError::unsupported`] makes.
#[derive(Debug, thiserror::Error)]
#[error("the configuration is not supported")]
struct Unsupported;

/// Refuses a number of answers other than `asked`.
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

/// Tessellates cases of any configurations; cases of equal configuration go into one batch.
///
/// # Errors
/// As for [`Backend::tessellate`], and if the number of answers is not the number of patches.
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
        assert_eq!(messages, ["whole only produces whole patches, not single stages"; 3]);
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

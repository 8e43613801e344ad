//! Compares units and sums up the results.

use super::units::VALUES;
use super::{Subject, Unit, Units, Work};
use crate::backend::{Answers, Backend, BackendError, all_answered, tessellate};
use crate::case::Case;
use crate::check::Known;
use crate::check::compare::{self, Mismatch, SpecStage};
use crate::check::sequences::bucket;
use crate::check::{Strength, check_case};
use crate::core_backend::CoreBackend;
use crate::generate::Shard;
use crate::names::Named;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use tess_core::{FixedFactor, Parity, Partitioning, SplitOrder, Tessellation};

/// The result of comparing one subject on one backend.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubjectRow {
    /// The subject.
    pub subject: Subject,
    /// The name of the backend.
    pub backend: &'static str,
    /// The number of elements compared: patches, binary32 factors or locations.
    pub compared: u64,
    /// The number of units with a difference that is not known.
    pub mismatches: u64,
    /// The number of those units by the stage that their first difference points to.
    pub stages: BTreeMap<SpecStage, u64>,
    /// The number of patches that differ in a known way.
    pub known: u64,
    /// The first difference, as text.
    pub first: Option<String>,
    /// Whether its patch is right when the backend repeats it by itself, so that earlier work
    /// matters.
    pub passes_alone: bool,
}

/// Compares those units of a subject that are in the shard; returns one row per backend. A patch
/// that differs is not a mismatch if the difference is `known`.
///
/// Pass one list of backends per thread; all lists must have the same backends. `progress` is
/// called from any thread for each unit that all of them have compared.
///
/// # Errors
/// A backend could not run, or there is none.
pub fn verify(
    workers: &mut [Vec<Box<dyn Backend>>],
    subject: Subject,
    shard: Shard,
    known: &Known,
    progress: &(dyn Fn(Progress<'_>) + Sync),
) -> Answers<SubjectRow> {
    if workers.first().is_none_or(Vec::is_empty) {
        return Err(BackendError::new("no backend to verify"));
    }
    let units = Units::of(subject);
    let mine = shard.items(units.count());
    let names: Vec<&'static str> = workers[0].iter().map(|backend| backend.name()).collect();
    let rows: Vec<SubjectRow> =
        names.into_iter().map(|backend| SubjectRow::new(subject, backend)).collect();
    let rows = Mutex::new(rows);
    let (next, done) = (AtomicU64::new(0), AtomicU64::new(0));
    let work = |backends: &mut Vec<Box<dyn Backend>>| -> Result<(), BackendError> {
        let next_unit = || shard.item(next.fetch_add(1, Ordering::Relaxed));
        while let Some(unit) = next_unit().and_then(|number| units.get(number)) {
            for (column, backend) in backends.iter_mut().enumerate() {
                let compared = compare_unit(backend.as_mut(), &unit, known)?;
                rows.lock().unwrap_or_else(PoisonError::into_inner)[column].add(compared);
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress(Progress { done, all: mine, unit: &unit });
        }
        Ok(())
    };
    let results = crate::check::workers::run(workers, work);
    let panicked = || BackendError::new("a backend panicked");
    results.into_iter().try_for_each(|result| result.ok_or_else(panicked)?)?;
    Ok(rows.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// A unit that every backend has compared.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Progress<'a> {
    /// The number of units compared so far.
    pub done: u64,
    /// The number of units to compare.
    pub all: u64,
    /// The unit.
    pub unit: &'a Unit,
}

/// The result of comparing one unit.
struct Compared {
    elements: u64,
    known: u64,
    /// The first difference that is not known, with its stage and text.
    first: Option<(SpecStage, String)>,
    passes_alone: bool,
}

impl SubjectRow {
    fn new(subject: Subject, backend: &'static str) -> Self {
        let (stages, first) = (BTreeMap::new(), None);
        let (compared, mismatches, known, passes_alone) = (0, 0, 0, false);
        Self { subject, backend, compared, mismatches, stages, known, first, passes_alone }
    }

    fn add(&mut self, unit: Compared) {
        self.compared += unit.elements;
        self.known += unit.known;
        if let Some((stage, first)) = unit.first {
            self.mismatches += 1;
            *self.stages.entry(stage).or_default() += 1;
            if self.first.is_none() {
                (self.first, self.passes_alone) = (Some(first), unit.passes_alone);
            }
        }
    }
}

impl Compared {
    /// The result for elements that are not patches, among which no difference can be known.
    fn values(elements: u64, name: &str, mismatch: Option<Mismatch>) -> Self {
        let first = mismatch.map(|mismatch| (mismatch.stage, format!("{name}: {mismatch}")));
        Self { elements, known: 0, first, passes_alone: false }
    }
}

fn compare_unit(
    backend: &mut dyn Backend,
    Unit(work): &Unit,
    known: &Known,
) -> Result<Compared, BackendError> {
    match work {
        Work::Patches(cases) => compare_patches(backend, cases, known),
        Work::Random(unit) => compare_patches(backend, &unit.cases(), known),
        Work::Values { partitioning, first } => compare_values(backend, *partitioning, *first),
        Work::Bucket { split, parity, bucket } => compare_bucket(backend, *split, *parity, *bucket),
    }
}

fn compare_patches(
    backend: &mut dyn Backend,
    cases: &[Case],
    known: &Known,
) -> Result<Compared, BackendError> {
    let observed = tessellate(backend, cases)?;
    let mut expected = Tessellation::default();
    let mut compared = Compared::values(cases.len() as u64, "", None);
    for (case, observed) in cases.iter().zip(&observed) {
        expected.points.clear();
        expected.indices.clear();
        case.patch().emit(&mut expected);
        let mismatch = Mismatch::between(case, observed, &expected);
        if known.excuses(case, mismatch.as_ref().map(|found| found as _)) {
            compared.known += 1;
        } else if let Some(mismatch) = mismatch.filter(|_| compared.first.is_none()) {
            let text = format!("{case}\n  {mismatch}\n  {}", case.command());
            compared.first = Some((mismatch.stage, text));
            compared.passes_alone = check_case(backend, case, Strength::default())?.is_none();
        }
    }
    Ok(compared)
}

fn compare_values(
    backend: &mut dyn Backend,
    partitioning: Partitioning,
    first: u32,
) -> Result<Compared, BackendError> {
    let values: Vec<f32> = (first..=first + (VALUES - 1)).map(f32::from_bits).collect();
    let answers = backend.fixed_factors(partitioning, &values)?;
    let observed = all_answered(backend, "factors", answers, values.len())?;
    let expected = CoreBackend.fixed_factors(partitioning, &values)?;
    let mismatch = compare::fixed_factors(&values, &observed, &expected);
    Ok(Compared::values(u64::from(VALUES), partitioning.name(), mismatch))
}

fn compare_bucket(
    backend: &mut dyn Backend,
    split: SplitOrder,
    parity: Parity,
    integer: u32,
) -> Result<Compared, BackendError> {
    let factors: Vec<FixedFactor> = bucket(parity, integer).collect();
    let contexts = CoreBackend.contexts(split, parity, &factors)?;
    let answers = backend.contexts(split, parity, &factors)?;
    let observed = all_answered(backend, "contexts", answers, factors.len())?;
    let expected = CoreBackend.locations(&contexts)?;
    let locations = backend.locations(&contexts)?;
    let mismatch = compare::contexts(&factors, &observed, &contexts)
        .or_else(|| compare::locations(&factors, &contexts, &locations, &expected));
    let name = format!("{} {}", split.name(), parity.name());
    Ok(Compared::values(expected.len() as u64, &name, mismatch))
}

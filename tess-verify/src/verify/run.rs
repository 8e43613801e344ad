//! Compares units and adds up what was compared.

use super::units::VALUES;
use super::{Plan, Subject, Unit, Units};
use crate::backend::{Backend, BackendError, all_answered};
use crate::case::Case;
use crate::checker::tessellate;
use crate::compare;
use crate::core_backend::CoreBackend;
use crate::names::Named;
use crate::sequences::bucket;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use tess_core::{FixedFactor, Parity, Partitioning, SplitOrder, Tessellation};

/// What was compared of one subject in one backend.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The subject.
    pub subject: Subject,
    /// Name of the backend.
    pub backend: &'static str,
    /// Elements compared: patches, binary32 factors or locations.
    pub compared: u64,
    /// Units in which something differed.
    pub mismatches: u64,
    /// The first difference, as text.
    pub first: Option<String>,
}

/// Compares everything in the plan's shard.
///
/// Give one list of backends for each thread to use, all lists with the same backends. `progress` is
/// called from any thread with the subject, the number of units that are done, and the number of all.
///
/// # Errors
/// A backend that could not run, or no backend at all.
pub fn verify(
    workers: &mut [Vec<Box<dyn Backend>>],
    plan: &Plan,
    progress: &(dyn Fn(Subject, u64, u64) + Sync),
) -> Result<Vec<Row>, BackendError> {
    if workers.first().is_none_or(Vec::is_empty) {
        return Err(BackendError::new("no backend to verify"));
    }
    let mut table = Vec::new();
    for &subject in &plan.subjects {
        table.extend(verify_subject(workers, plan, subject, progress)?);
    }
    Ok(table)
}

fn verify_subject(
    workers: &mut [Vec<Box<dyn Backend>>],
    plan: &Plan,
    subject: Subject,
    progress: &(dyn Fn(Subject, u64, u64) + Sync),
) -> Result<Vec<Row>, BackendError> {
    let units = Units::of(subject);
    let mine = plan.shard.items(units.count());
    let names: Vec<&'static str> = workers[0].iter().map(|backend| backend.name()).collect();
    let rows: Vec<Row> = names
        .into_iter()
        .map(|backend| Row { subject, backend, compared: 0, mismatches: 0, first: None })
        .collect();
    let rows = Mutex::new(rows);
    let (next, done) = (AtomicU64::new(0), AtomicU64::new(0));
    let work = |backends: &mut Vec<Box<dyn Backend>>| -> Result<(), BackendError> {
        let next_unit = || plan.shard.item(next.fetch_add(1, Ordering::Relaxed));
        while let Some(unit) = next_unit().and_then(|number| units.get(number)) {
            for (column, backend) in backends.iter_mut().enumerate() {
                let (compared, difference) = compare_unit(backend.as_mut(), &unit)?;
                let mut rows = rows.lock().unwrap_or_else(PoisonError::into_inner);
                let row = &mut rows[column];
                row.compared += compared;
                if let Some(difference) = difference {
                    row.mismatches += 1;
                    row.first.get_or_insert(difference);
                }
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress(subject, done, mine);
        }
        Ok(())
    };
    let results = crate::workers::run(workers, work);
    let panicked = || BackendError::new("a backend panicked");
    results.into_iter().try_for_each(|result| result.ok_or_else(panicked)?)?;
    Ok(rows.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// How many elements were compared, and the first difference.
type Compared = (u64, Option<String>);

fn compare_unit(backend: &mut dyn Backend, unit: &Unit) -> Result<Compared, BackendError> {
    match unit {
        Unit::Patches(cases) => compare_patches(backend, cases),
        Unit::Random(unit) => compare_patches(backend, &unit.cases()),
        Unit::Values { partitioning, first } => compare_values(backend, *partitioning, *first),
        Unit::Bucket { split, parity, bucket } => compare_bucket(backend, *split, *parity, *bucket),
    }
}

fn compare_patches(backend: &mut dyn Backend, cases: &[Case]) -> Result<Compared, BackendError> {
    let observed = tessellate(backend, cases)?;
    let mut expected = Tessellation::default();
    let mut differences = cases.iter().zip(&observed).filter_map(|(case, observed)| {
        expected.points.clear();
        expected.indices.clear();
        case.patch().emit(&mut expected);
        let mismatch = compare::tessellations(case, observed, &expected)?;
        Some(format!("{case}\n  {mismatch}\n  {}", case.command()))
    });
    Ok((cases.len() as u64, differences.next()))
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
    let difference = mismatch.map(|mismatch| format!("{}: {mismatch}", partitioning.name()));
    Ok((u64::from(VALUES), difference))
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
    let order = split.name();
    let difference = mismatch.map(|mismatch| format!("{order} {}: {mismatch}", parity.name()));
    Ok((expected.len() as u64, difference))
}

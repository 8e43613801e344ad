//! Interleaved runs, and what follows from their times.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "rates and ratios of measurements"
)]

use super::core::CoreRunner;
use super::runner::{Amount, Runner, WorkingSet};
use super::table::{Row, name_of};
use crate::failure::Failure;
use std::fmt;
use std::time::Duration;
use tess_verify::backend::BackendError;
use tess_verify::workloads::Workload;

/// What is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan<'a> {
    /// The patches.
    pub(crate) workload: &'a Workload,
    /// Where the output goes.
    pub(crate) working_set: WorkingSet,
    /// Interleaved samples, at least 1.
    pub(crate) samples: u32,
}

impl fmt::Display for Plan<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", self.workload.name, self.working_set.name())
    }
}

/// Checks the digest, then times backend, fill and core in turn, part by part.
///
/// A part's time is the median over the samples; the workload's is the sum over its parts.
///
/// # Errors
/// The output differs from the model's (exit code 1), or a run failed.
pub(crate) fn measure(runner: &mut dyn Runner, plan: Plan<'_>) -> Result<Row, Failure> {
    let parts = runner.prepare(plan.workload, plan.working_set)?;
    check_digest(runner, plan.workload)?;
    let (mut core, core_parts) = prepared_core(runner, plan)?;
    let mut run = Times::new(parts.len());
    let mut fill = Times::new(parts.len());
    let mut core_run = Times::new(core_parts.len());
    for _ in 0..plan.samples {
        for part in 0..parts.len().max(core_parts.len()) {
            let threads = runner.threads();
            run.take(part, threads, || runner.run(part))?;
            fill.take(part, threads, || runner.fill(part))?;
            core_run.take(part, 1, || core.run(part))?;
        }
    }
    let (amount, seconds) = (parts.into_iter().sum::<Amount>(), run.seconds());
    let core_rate = match &core_parts[..] {
        [] => amount.patches as f64 / seconds,
        parts => parts.iter().copied().sum::<Amount>().patches as f64 / core_run.seconds(),
    };
    Ok(Row {
        workload: plan.workload.name.clone(),
        backend: runner.backend(),
        level: runner.level(),
        working_set: plan.working_set.name(),
        threads: runner.threads(),
        index_type: name_of(runner.index_type()),
        patches_per_s: amount.patches as f64 / seconds,
        triangles_per_s: amount.triangles as f64 / seconds,
        bytes_per_s: amount.bytes as f64 / seconds,
        fill_ratio: fill.seconds() / seconds,
        core_ratio: amount.patches as f64 / seconds / core_rate,
    })
}

fn check_digest(runner: &mut dyn Runner, workload: &Workload) -> Result<(), Failure> {
    let (expected, observed) = (workload.digest(), runner.digest()?);
    if expected == observed {
        return Ok(());
    }
    Err(Failure::different(format!(
        "{} gives digest {observed:016x}, the model {expected:016x}; not timed",
        runner.backend()
    )))
}

/// The core beside another backend; without any parts beside itself.
fn prepared_core(
    runner: &dyn Runner,
    plan: Plan<'_>,
) -> Result<(CoreRunner, Vec<Amount>), Failure> {
    let mut core = CoreRunner::single();
    let parts = match runner.backend() {
        "core" => Vec::new(),
        _ => core.prepare(plan.workload, plan.working_set)?,
    };
    Ok((core, parts))
}

/// The samples of each part, in seconds.
struct Times {
    parts: Vec<Vec<f64>>,
}

impl Times {
    fn new(parts: usize) -> Self {
        Self { parts: vec![Vec::new(); parts] }
    }

    /// Takes one more sample of a part, if there is such a part.
    fn take(
        &mut self,
        part: usize,
        threads: u32,
        mut run: impl FnMut() -> Result<Duration, BackendError>,
    ) -> Result<(), BackendError> {
        if let Some(samples) = self.parts.get_mut(part) {
            samples.push(sample(threads, &mut run)?);
        }
        Ok(())
    }

    /// The sum of the medians.
    fn seconds(&self) -> f64 {
        self.parts.iter().map(|samples| median(samples.clone())).sum::<f64>().max(1e-9)
    }
}

/// The mean time of as many runs as take a fifth of a millisecond for each thread, in seconds.
fn sample(
    threads: u32,
    run: &mut impl FnMut() -> Result<Duration, BackendError>,
) -> Result<f64, BackendError> {
    let long_enough = Duration::from_micros(200) * threads;
    let (mut time, mut runs) = (Duration::ZERO, 0u32);
    while time < long_enough && runs < 10_000 {
        time += run()?;
        runs += 1;
    }
    Ok(time.as_secs_f64() / f64::from(runs))
}

/// The middle value, the lower of two; 0 of none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]).to_bits(), 2.0f64.to_bits(), "odd count");
        assert_eq!(median(vec![4.0, 1.0, 3.0, 2.0]).to_bits(), 2.0f64.to_bits(), "even count");
        assert_eq!(median(vec![]).to_bits(), 0.0f64.to_bits(), "none");
    }
}

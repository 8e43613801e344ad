//! Timing: what a backend must offer to be timed, and how it is measured.

mod core;
mod table;

use crate::backends::{BackendName, not_built_in};
use crate::failure::Failure;
use clap::ValueEnum;
use serde::Serialize;
use std::time::Duration;
use tess_check::backend::BackendError;
use tess_check::workloads::{IndexType, Workload};

pub use table::table;

/// Where a runner's output goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum WorkingSet {
    /// Batches of about 1 MiB into the same buffers again and again
    Cache,
    /// 1 GiB of output, each byte written once
    Stream,
}

impl WorkingSet {
    /// Its name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cache => "cache",
            Self::Stream => "stream",
        }
    }
}

/// What one run of a prepared workload amounts to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Amount {
    /// Patches tessellated.
    pub patches: u64,
    /// Primitives written: triangles, or segments on isolines.
    pub triangles: u64,
    /// Bytes of points and indices written.
    pub bytes: u64,
}

/// An implementation that can be timed.
///
/// [`Runner::run`] and [`Runner::fill`] write the same bytes to the same buffers in the same order
/// of batches; neither allocates. Both give their own time, so that a device can use its clock.
pub trait Runner {
    /// Name of the backend.
    fn backend(&self) -> &'static str;

    /// CPU level or name of the adapter.
    fn level(&self) -> String;

    /// Threads it runs on.
    fn threads(&self) -> u32;

    /// Width of the indices it writes.
    fn index_type(&self) -> IndexType;

    /// Gets everything ready to run a workload in a working set, buffers included.
    ///
    /// # Errors
    /// The implementation cannot run it.
    fn prepare(
        &mut self,
        workload: &Workload,
        working_set: WorkingSet,
    ) -> Result<Amount, BackendError>;

    /// Runs what is prepared, once over the workload's patches, and digests the output as
    /// [`Workload::digest`] does.
    ///
    /// # Errors
    /// The implementation failed.
    fn digest(&mut self) -> Result<u64, BackendError>;

    /// Runs what is prepared and says how long it took.
    ///
    /// # Errors
    /// The implementation failed.
    fn run(&mut self) -> Result<Duration, BackendError>;

    /// Fills the bytes that a run writes and says how long it took.
    ///
    /// # Errors
    /// The device failed.
    fn fill(&mut self) -> Result<Duration, BackendError>;
}

/// What a runner is made for.
#[derive(Clone, Copy, Debug)]
pub struct RunnerOptions {
    /// Threads, at least 1.
    pub threads: u32,
    /// Width of the indices.
    pub index_type: IndexType,
}

/// The runner of a backend.
///
/// # Errors
/// Exit code 3 if the backend is not available, 2 if it does not offer these options.
pub fn runner(name: BackendName, options: RunnerOptions) -> Result<Box<dyn Runner>, Failure> {
    match name {
        BackendName::Core => Ok(Box::new(core::CoreRunner::new(options)?)),
        BackendName::Simd => Err(not_built_in("simd")),
        BackendName::Gpu => Err(not_built_in("gpu")),
    }
}

/// One line of results, with the keys that `--json` prints.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    workload: String,
    backend: &'static str,
    level: String,
    working_set: &'static str,
    threads: u32,
    index_type: &'static str,
    patches_per_s: f64,
    triangles_per_s: f64,
    bytes_per_s: f64,
    fill_ratio: f64,
    core_ratio: f64,
}

/// What is measured.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// The patches.
    pub workload: &'a Workload,
    /// Where the output goes.
    pub working_set: WorkingSet,
    /// Interleaved samples, at least 1.
    pub samples: u32,
}

/// Checks the digest, then times backend, fill and core in turn.
///
/// # Errors
/// The output differs from the model's (exit code 1), or a run failed.
pub fn measure(runner: &mut dyn Runner, plan: Plan<'_>) -> Result<Row, Failure> {
    let amount = runner.prepare(plan.workload, plan.working_set)?;
    check_digest(runner, plan.workload)?;
    let mut core = if runner.backend() == "core" { None } else { Some(prepared_core(plan)?) };
    let repeats = repeats(runner)?;
    let mut samples = Vec::new();
    for _ in 0..plan.samples {
        let run = repeat(repeats, || runner.run())?;
        let fill = repeat(repeats, || runner.fill())?;
        let core_rate = match &mut core {
            Some((core, core_amount)) => core_amount.per_second(core.run()?).patches,
            None => amount.per_second(run).patches,
        };
        samples.push(Sample { run, fill, core_rate });
    }
    Ok(row(runner, plan, amount, &samples))
}

fn check_digest(runner: &mut dyn Runner, workload: &Workload) -> Result<(), Failure> {
    let (expected, observed) = (workload.digest(), runner.digest()?);
    if expected == observed {
        return Ok(());
    }
    Err(Failure::different(format!(
        "{}: {} gives digest {observed:016x}, the model {expected:016x}; not timed",
        workload.name,
        runner.backend()
    )))
}

fn prepared_core(plan: Plan<'_>) -> Result<(core::CoreRunner, Amount), Failure> {
    let options = RunnerOptions { threads: 1, index_type: IndexType::U32 };
    let mut core = core::CoreRunner::new(options)?;
    let amount = core.prepare(plan.workload, plan.working_set)?;
    Ok((core, amount))
}

/// How often a short run is repeated, so that a sample takes about 5 ms.
fn repeats(runner: &mut dyn Runner) -> Result<u32, Failure> {
    const SAMPLE: Duration = Duration::from_millis(5);
    let once = runner.run()?.max(Duration::from_nanos(100));
    let times = SAMPLE.as_nanos().div_ceil(once.as_nanos());
    Ok(u32::try_from(times).unwrap_or(u32::MAX))
}

/// The mean time of several runs.
fn repeat(
    times: u32,
    mut run: impl FnMut() -> Result<Duration, BackendError>,
) -> Result<Duration, BackendError> {
    let mut total = Duration::ZERO;
    for _ in 0..times {
        total += run()?;
    }
    Ok(total / times)
}

/// Neighbouring runs.
#[derive(Clone, Copy, Debug)]
struct Sample {
    run: Duration,
    fill: Duration,
    /// Patches per second of the core.
    core_rate: f64,
}

/// Something per second.
#[derive(Clone, Copy, Debug)]
struct Rates {
    patches: f64,
    triangles: f64,
    bytes: f64,
}

#[expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "rates and ratios of measurements"
)]
impl Amount {
    fn per_second(self, time: Duration) -> Rates {
        let seconds = time.as_secs_f64().max(1e-9);
        let rate = |count: u64| count as f64 / seconds;
        Rates {
            patches: rate(self.patches),
            triangles: rate(self.triangles),
            bytes: rate(self.bytes),
        }
    }
}

#[expect(clippy::float_arithmetic, reason = "rates and ratios of measurements")]
fn row(runner: &dyn Runner, plan: Plan<'_>, amount: Amount, samples: &[Sample]) -> Row {
    let median_of = |figure: &dyn Fn(&Sample) -> f64| median(samples.iter().map(figure).collect());
    let rates = |sample: &Sample| amount.per_second(sample.run);
    Row {
        workload: plan.workload.name.clone(),
        backend: runner.backend(),
        level: runner.level(),
        working_set: plan.working_set.name(),
        threads: runner.threads(),
        index_type: match runner.index_type() {
            IndexType::U16 => "u16",
            IndexType::U32 => "u32",
        },
        patches_per_s: median_of(&|sample| rates(sample).patches),
        triangles_per_s: median_of(&|sample| rates(sample).triangles),
        bytes_per_s: median_of(&|sample| rates(sample).bytes),
        fill_ratio: median_of(&|sample| rates(sample).bytes / amount.per_second(sample.fill).bytes),
        core_ratio: median_of(&|sample| rates(sample).patches / sample.core_rate),
    }
}

/// The middle value, the lower of two; there is at least one.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[(values.len() - 1) / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]).to_bits(), 2.0f64.to_bits(), "odd count");
        assert_eq!(median(vec![4.0, 1.0, 3.0, 2.0]).to_bits(), 2.0f64.to_bits(), "even count");
    }
}

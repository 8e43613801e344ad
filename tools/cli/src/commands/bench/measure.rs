//! Interleaved runs, and the figures derived from their times.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "rates and ratios of measurements"
)]

use super::core::{self, CoreKernel};
use super::cpu::CpuRunner;
use super::runner::{Amount, Description, Runner, WorkingSet};
use super::table::BenchRow;
use crate::args::name_in;
use crate::backends::INDEX_WIDTHS;
use crate::failure::Failure;
use crate::output::form::name;
use std::fmt;
use std::time::Duration;
use tess_simd::Order;
use tess_verify::BackendError;
use tess_workloads::Workload;

/// A measurement to make.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan<'a> {
    /// The patches.
    pub(crate) workload: &'a Workload,
    /// The destination of the output.
    pub(crate) working_set: WorkingSet,
    /// The number of interleaved samples, at least 1.
    pub(crate) samples: u32,
}

impl Plan<'_> {
    /// The name of this runner's row.
    fn name(&self, description: &Description) -> String {
        let order = match description.order {
            Order::Specification => "",
            Order::VertexCache => ", vertex-cache order",
        };
        format!("{}{}{order}", self.workload.name, description.remark)
    }
}

impl fmt::Display for Plan<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", self.workload.name, name(&self.working_set))
    }
}

/// Checks the digest, then times the backend, the fill and the core in turn, part by part. If the
/// backend runs on a separate device, the core is timed first, by itself.
///
/// The time of a part is the median of its samples; the workload's is the sum over its parts.
/// Errors: the output differs from the model's (exit code 1), or a run failed.
pub(crate) fn measure(runner: &mut dyn Runner, plan: Plan<'_>) -> Result<BenchRow, Failure> {
    let description = runner.description().clone();
    let Description { threads, sleeps, is_device, .. } = description;
    let mut core = Core::prepare(&description, plan)?;
    if is_device {
        for _ in 0..plan.samples {
            (0..core.parts.len()).try_for_each(|part| core.take(part))?;
        }
    }
    let parts = runner.prepare(plan.workload, plan.working_set)?;
    check_digest(runner, plan.workload)?;
    let mut run = PartTimes::new(parts.len());
    let mut fill = PartTimes::new(parts.len());
    let in_turn = if is_device { 0 } else { core.parts.len() };
    let take =
        |times: &mut PartTimes, part, run: &mut dyn FnMut() -> Result<Duration, BackendError>| {
            times.take(part, || if sleeps { after_a_pause(run) } else { sample(threads, run) })
        };
    for _ in 0..plan.samples {
        for part in 0..parts.len().max(in_turn) {
            take(&mut run, part, &mut || runner.run(part))?;
            take(&mut fill, part, &mut || runner.fill(part))?;
            if part < in_turn {
                core.take(part)?;
            }
        }
    }
    let (amount, seconds) = (parts.into_iter().sum::<Amount>(), run.seconds());
    let patches_per_s = amount.patches as f64 / seconds;
    Ok(BenchRow {
        workload: plan.name(&description),
        backend: description.backend,
        level: description.level,
        working_set: name(&plan.working_set),
        threads,
        index_type: name_in(INDEX_WIDTHS, &description.index_type),
        patches_per_s,
        triangles_per_s: amount.triangles as f64 / seconds,
        bytes_per_s: amount.bytes as f64 / seconds,
        fill_ratio: fill.seconds() / seconds,
        core_ratio: patches_per_s / core.patches_per_s().unwrap_or(patches_per_s),
    })
}

fn check_digest(runner: &mut dyn Runner, workload: &Workload) -> Result<(), Failure> {
    let Description { order, backend, .. } = *runner.description();
    let (expected, observed) = (workload.digest(order), runner.digest()?);
    if expected == observed {
        return Ok(());
    }
    Err(Failure::different(format!(
        "{backend} gives digest {observed:016x}, the model {expected:016x}; not timed"
    )))
}

/// The core, timed for comparison with another backend. It has no parts if that backend is the
/// core.
struct Core {
    runner: CpuRunner<CoreKernel>,
    parts: Vec<Amount>,
    times: PartTimes,
}

impl Core {
    /// Prepares to run a workload in the working set of the plan. For comparison with a device,
    /// whose memory the core does not use, the working set is `cache`.
    fn prepare(beside: &Description, plan: Plan<'_>) -> Result<Self, Failure> {
        let set = if beside.is_device { WorkingSet::Cache } else { plan.working_set };
        let mut runner = core::runner();
        let parts = match beside.backend {
            "core" => Vec::new(),
            _ => runner.prepare(plan.workload, set)?,
        };
        Ok(Self { runner, times: PartTimes::new(parts.len()), parts })
    }

    /// Takes another sample of a part.
    fn take(&mut self, part: usize) -> Result<(), BackendError> {
        self.times.take(part, || sample(1, &mut || self.runner.run(part)))
    }

    /// Its speed; `None` if it would be compared with itself.
    fn patches_per_s(&self) -> Option<f64> {
        let amount = self.parts.iter().copied().sum::<Amount>();
        (amount.patches > 0).then(|| amount.patches as f64 / self.times.seconds())
    }
}

/// The samples of each part, in seconds.
struct PartTimes {
    parts: Vec<Vec<f64>>,
}

impl PartTimes {
    fn new(parts: usize) -> Self {
        Self { parts: vec![Vec::new(); parts] }
    }

    /// Takes another sample of a part, if the part exists.
    fn take(
        &mut self,
        part: usize,
        sample: impl FnOnce() -> Result<f64, BackendError>,
    ) -> Result<(), BackendError> {
        if let Some(samples) = self.parts.get_mut(part) {
            samples.push(sample()?);
        }
        Ok(())
    }

    /// The sum of the medians.
    fn seconds(&self) -> f64 {
        self.parts.iter().map(|samples| median(samples.clone())).sum::<f64>().max(1e-9)
    }
}

/// The time after which idle threads fall asleep.
const PAUSE: Duration = Duration::from_millis(2);

/// The time of one run after a pause, in seconds.
#[expect(clippy::disallowed_methods, reason = "a pause has no event to wait for")]
fn after_a_pause(
    run: &mut dyn FnMut() -> Result<Duration, BackendError>,
) -> Result<f64, BackendError> {
    std::thread::sleep(PAUSE);
    Ok(run()?.as_secs_f64())
}

/// The mean time of a run, in seconds, over enough runs to take a fifth of a millisecond per
/// thread. With several threads the first run is not timed, because it wakes them.
fn sample(
    threads: u32,
    run: &mut dyn FnMut() -> Result<Duration, BackendError>,
) -> Result<f64, BackendError> {
    let long_enough = Duration::from_micros(200) * threads;
    if threads > 1 {
        run()?;
    }
    let (mut time, mut runs) = (Duration::ZERO, 0u32);
    while time < long_enough && runs < 10_000 {
        time += run()?;
        runs += 1;
    }
    Ok(time.as_secs_f64() / f64::from(runs))
}

/// The median; the lower of two middle values; 0 for an empty list.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A runner that takes a second per part, and half a second to fill its bytes.
    struct Slow {
        digest: u64,
        description: Description,
    }

    impl Slow {
        fn new(digest: u64) -> Self {
            let description = core::runner().description().clone();
            Self { digest, description: Description { backend: "slow", ..description } }
        }
    }

    impl Runner for Slow {
        fn description(&self) -> &Description {
            &self.description
        }

        fn prepare(
            &mut self,
            workload: &Workload,
            _: WorkingSet,
        ) -> Result<Vec<Amount>, BackendError> {
            let patches = workload.patches.len() as u64;
            Ok(vec![Amount { patches, triangles: 2 * patches, bytes: 3 * patches }])
        }

        fn digest(&mut self) -> Result<u64, BackendError> {
            Ok(self.digest)
        }

        fn run(&mut self, _: usize) -> Result<Duration, BackendError> {
            Ok(Duration::from_secs(1))
        }

        fn fill(&mut self, _: usize) -> Result<Duration, BackendError> {
            Ok(Duration::from_millis(500))
        }
    }

    /// The ratios show how much faster the backend is than the others. A wrong result has no
    /// ratios.
    #[test]
    fn ratios_and_digests() {
        let workload = &Workload::named("uniform-1")[0];
        let plan = Plan { workload, working_set: WorkingSet::Cache, samples: 1 };
        let digest = workload.digest(Order::Specification);
        let row = measure(&mut Slow::new(digest), plan).expect("it is right");
        let patches = workload.patches.len() as f64;
        assert_eq!(row.patches_per_s.to_bits(), patches.to_bits(), "a second for all");
        assert_eq!(row.triangles_per_s.to_bits(), (2.0 * patches).to_bits(), "two for each");
        assert_eq!(row.bytes_per_s.to_bits(), (3.0 * patches).to_bits(), "three for each");
        assert_eq!(row.fill_ratio.to_bits(), 0.5f64.to_bits(), "filling takes half the time");
        assert!(row.core_ratio < 0.5, "the core takes no second: {}", row.core_ratio);
        let failure = measure(&mut Slow::new(digest ^ 1), plan).map(|_| ());
        let failure = failure.expect_err("a result that is wrong is not timed");
        assert_eq!(failure.exit as u8, 1, "{failure}");
        assert!(failure.to_string().contains("slow gives digest"), "{failure}");
    }

    #[test]
    fn medians() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]).to_bits(), 2.0f64.to_bits(), "odd count");
        assert_eq!(median(vec![4.0, 1.0, 3.0, 2.0]).to_bits(), 2.0f64.to_bits(), "even count");
        assert_eq!(median(vec![]).to_bits(), 0.0f64.to_bits(), "none");
    }
}

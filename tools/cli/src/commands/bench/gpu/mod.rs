//! The compute shaders, timed by the clock of their device.

use super::BenchCommand;
use super::runner::{Amount, Description, Runner, WorkingSet, totals};
use crate::backends::gpu::{setup_of, split_by_patch};
use crate::failure::Failure;
use fill::Fill;
use std::time::{Duration, Instant};
use tess_core::PatchFactors;
use tess_gpu::layout::factor_words;
use tess_gpu::{Copies, Setup};
use tess_verify::BackendError;
use tess_verify::vectors::Fnv1a;
use tess_wgpu::{Batch, DeviceLimits, Gpu, Outputs, Stopwatch, Tessellator};
use tess_workloads::{Calls, Totals, Workload};

mod fill;

/// How long the device works before a measurement if it has been idle, so that its clock rate is
/// up.
const WARM_UP: Duration = Duration::from_millis(700);
/// The length of a pause after which a device counts as idle.
const IDLE: Duration = Duration::from_millis(5);

/// The number of batches that are submitted together, so that a part is long enough to be timed.
const BATCHES_PER_PART: usize = 64;

/// Everything from factors to draw arguments, on the device.
#[derive(Debug)]
pub(super) struct GpuRunner {
    gpu: Gpu,
    stopwatch: Stopwatch,
    tessellator: Tessellator,
    fill: Fill,
    description: Description,
    copies: Copies,
    workload: Option<(Setup, Vec<PatchFactors>)>,
    batches: Vec<Timed>,
    last_use: Option<Instant>,
}

/// A batch, its amount of work, and the bind groups that fill its bytes.
#[derive(Debug)]
struct Timed {
    batch: Batch,
    amount: Amount,
    fills: Vec<fill::Span>,
}

impl GpuRunner {
    pub(super) fn new(args: &BenchCommand) -> Result<Self, Failure> {
        let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, Stopwatch::FEATURES))
            .map_err(Failure::unavailable)?;
        let stopwatch = Stopwatch::new(&gpu).map_err(|error| {
            Failure::unavailable(format!("{} cannot be measured: {error}", gpu.name()))
        })?;
        let tessellator = Tessellator::new(&gpu.device);
        let fill = Fill::new(&gpu);
        let description = Description {
            backend: "gpu",
            level: gpu.name(),
            threads: 1,
            index_type: args.options.index_type,
            order: args.order,
            remark: if args.no_copies { ", no copies".to_owned() } else { String::new() },
            sleeps: false,
            is_device: true,
        };
        Ok(Self {
            gpu,
            stopwatch,
            tessellator,
            fill,
            description,
            copies: if args.no_copies { Copies::Never } else { Copies::WhereAlike },
            workload: None,
            batches: Vec::new(),
            last_use: None,
        })
    }

    fn timed(
        &mut self,
        setup: Setup,
        patches: &[PatchFactors],
        outputs: (&wgpu::Buffer, &wgpu::Buffer),
        amount: (Totals, u64),
    ) -> Result<Timed, BackendError> {
        let (totals, repeats) = amount;
        let bytes: Vec<u8> = factor_words(patches).into_iter().flat_map(u32::to_le_bytes).collect();
        let bytes = bytes.repeat(usize::try_from(repeats).unwrap_or(1));
        let usage = wgpu::BufferUsages::STORAGE;
        let factors = self.gpu.upload("factors", &bytes, usage).map_err(BackendError::new)?;
        let (points, indices) = outputs;
        let count = u32::try_from(totals.patches * repeats)
            .map_err(|_| BackendError::new("more patches than 32 bits count"))?;
        let batch = self
            .tessellator
            .batch(setup, count, &factors, Outputs::Buffers { points, indices })
            .map_err(BackendError::new)?;
        let spans = [
            (points, 8 * totals.points),
            (indices, u64::from(setup.index_type.bytes()) * totals.indices),
        ];
        Ok(Timed {
            batch,
            amount: (0..repeats).map(|_| Amount::of(&totals, self.description.index_type)).sum(),
            fills: spans
                .into_iter()
                .flat_map(|(buffer, bytes)| self.fill.spans(&self.gpu, buffer, bytes * repeats))
                .collect(),
        })
    }

    /// Runs a part until the device is no longer idle.
    fn warm(&mut self, part: usize) -> Result<(), BackendError> {
        if self.last_use.is_none_or(|last| last.elapsed() > IDLE) {
            let start = Instant::now();
            while start.elapsed() < WARM_UP {
                self.run_part(part)?;
            }
        }
        self.last_use = Some(Instant::now());
        Ok(())
    }

    fn time(&self, work: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<Duration, BackendError> {
        let time = self.stopwatch.time(&self.gpu, work);
        time.map(Duration::from_nanos).map_err(BackendError::new)
    }

    fn run_part(&self, part: usize) -> Result<Duration, BackendError> {
        self.time(|encoder| self.part(part).iter().for_each(|timed| timed.batch.encode(encoder)))
    }

    fn part(&self, part: usize) -> &[Timed] {
        let first = part * BATCHES_PER_PART;
        &self.batches[first..(first + BATCHES_PER_PART).min(self.batches.len())]
    }
}

impl Runner for GpuRunner {
    fn description(&self) -> &Description {
        &self.description
    }

    fn prepare(
        &mut self,
        workload: &Workload,
        working_set: WorkingSet,
    ) -> Result<Vec<Amount>, BackendError> {
        let first = workload.patches.first().ok_or_else(|| BackendError::new("no patches"))?;
        let Description { index_type, order, .. } = self.description;
        let copies = self.copies;
        let setup = setup_of(first.domain(), workload.config, index_type);
        let setup = Setup { copies, order, ..setup };
        let (ranges, repeats) = match (working_set, workload.calls) {
            (WorkingSet::Cache, _) | (_, Calls::Group) => (workload.cache_batches(index_type), 1),
            (WorkingSet::Stream, _) => {
                let whole = std::iter::once(0..workload.patches.len()).collect();
                (whole, workload.stream_repeats(index_type))
            }
        };
        let totals: Vec<_> = ranges.iter().map(|range| totals(workload, range)).collect();
        let most = |figure: fn(&Totals) -> u64| totals.iter().map(figure).max().unwrap_or(0);
        let output = |label, bytes: u64| {
            let bytes = (bytes * repeats).next_multiple_of(16);
            self.gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE).map_err(BackendError::new)
        };
        let points = output("points", 8 * most(|totals| totals.points))?;
        let index_bytes = u64::from(setup.index_type.bytes());
        let indices = output("indices", index_bytes * most(|totals| totals.indices))?;
        self.batches.clear();
        for (range, &totals) in ranges.iter().zip(&totals) {
            let patches = &workload.patches[range.clone()];
            let timed = self.timed(setup, patches, (&points, &indices), (totals, repeats))?;
            self.batches.push(timed);
        }
        self.workload = Some((setup, workload.patches.clone()));
        let parts = self.batches.chunks(BATCHES_PER_PART);
        Ok(parts.map(|part| part.iter().map(|timed| timed.amount).sum()).collect())
    }

    fn digest(&mut self) -> Result<u64, BackendError> {
        let (setup, patches) =
            self.workload.as_ref().ok_or_else(|| BackendError::new("nothing is prepared"))?;
        let output = self.tessellator.tessellate(&self.gpu, *setup, patches);
        let mut digest = Fnv1a::default();
        for patch in split_by_patch(&output.map_err(BackendError::new)?, *setup)? {
            digest.patch(&patch);
        }
        Ok(digest.finish())
    }

    fn run(&mut self, part: usize) -> Result<Duration, BackendError> {
        self.warm(part)?;
        self.run_part(part)
    }

    fn fill(&mut self, part: usize) -> Result<Duration, BackendError> {
        self.warm(part)?;
        self.time(|encoder| {
            self.part(part).iter().for_each(|timed| self.fill.encode(encoder, &timed.fills));
        })
    }
}

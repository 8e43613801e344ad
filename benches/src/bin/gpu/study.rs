//! Measures the GPU's part of `docs/study.md`: the inputs of the study of 2015 as one patch and as
//! 4096 in one batch.

use crate::Result;
use crate::digest::digest;
use crate::groups::batch;
use crate::timing::device_time;
use clap::Args;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tess_benches::median;
use tess_core::Order;
use tess_gpu::{Numbering, Setup};
use tess_wgpu::{Batch, DeviceLimits, Gpu, Stopwatch, Tessellator};
use tess_workloads::Workload;

/// The number of patches in the large batch.
const BATCH: usize = 4096;
/// The time for which each measurement runs.
const LONG_ENOUGH: Duration = Duration::from_millis(700);

/// The adapters to measure.
#[derive(Args, Debug)]
pub(crate) struct StudyArguments {
    /// Measure an adapter in software too, to try the program
    #[arg(long)]
    software: bool,
}

/// Prints a JSON object for each input: microseconds of one patch on the device, with its host and
/// in a frame, nanoseconds per patch of the batch (of all patches for `seed-table/isolines`),
/// triangles per patch, and the device's clock.
pub(crate) fn run(arguments: &StudyArguments) -> Result<()> {
    let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, Stopwatch::FEATURES))?;
    if gpu.info.device_type == wgpu::DeviceType::Cpu && !arguments.software {
        return Err(
            format!("{} is software; the study needs a GPU (or --software)", gpu.name()).into()
        );
    }
    let device = Device::new(gpu)?;
    Workload::named("seed-table").iter().try_for_each(|workload| {
        println!("{}", device.row(workload)?);
        Ok(())
    })
}

/// A device, and the other work of its frames.
struct Device {
    gpu: Gpu,
    stopwatch: Stopwatch,
    /// What a frame does besides: 4096 patches of factor 16.
    other: Batch,
}

impl Device {
    fn new(gpu: Gpu) -> Result<Self> {
        let stopwatch = Stopwatch::new(&gpu)?;
        let other = of_patches(&gpu, &Workload::named("uniform-16").remove(0))?;
        Ok(Self { gpu, stopwatch, other })
    }

    #[expect(clippy::float_arithmetic, reason = "a unit of time, and a time per patch")]
    fn row(&self, workload: &Workload) -> Result<String> {
        check(&self.gpu, workload)?;
        let patches = workload.patches.iter().copied().cycle().take(BATCH).collect();
        let all = of_patches(&self.gpu, &Workload { patches, ..workload.clone() })?;
        let one = of_patches(&self.gpu, workload)?;
        let parts = (BATCH / workload.patches.len()) as u64;
        let batch = self.time(|encoder| all.encode(encoder))? * 1e3 / parts as f64;
        let clock = self.clock(&all)?.map_or("null".to_owned(), |clock| clock.to_string());
        Ok(format!(
            "{{\"workload\":\"{}\",\"triangles\":{},\"device_us\":{:.1},\"host_us\":{:.1},\
             \"frame_us\":{:.1},\"batch_ns\":{batch:.2},\"mhz\":{clock}}}",
            workload.name,
            workload.totals().primitives,
            self.time(|encoder| one.encode(encoder))?,
            self.with_host(&one)?,
            self.in_a_frame(&one)?,
        ))
    }

    /// Microseconds on the device.
    fn time(&self, work: impl Fn(&mut wgpu::CommandEncoder)) -> Result<f64> {
        device_time(&self.gpu, &self.stopwatch, LONG_ENOUGH, work)
    }

    /// Microseconds from encoding until the host knows that the batch is done.
    fn with_host(&self, batch: &Batch) -> Result<f64> {
        let (start, mut times) = (Instant::now(), Vec::new());
        while start.elapsed() < LONG_ENOUGH {
            let begin = Instant::now();
            self.submit(batch)?;
            times.push(begin.elapsed());
        }
        Ok(median(times.split_off(times.len() / 2)))
    }

    fn submit(&self, batch: &Batch) -> Result<()> {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        batch.encode(&mut encoder);
        Ok(self.gpu.run(encoder)?)
    }

    /// Microseconds by which the batch lengthens a frame that works before and after it.
    fn in_a_frame(&self, batch: &Batch) -> Result<f64> {
        let (start, mut times) = (Instant::now(), Vec::new());
        while start.elapsed() < 2 * LONG_ENOUGH {
            let frame = |batch: Option<&Batch>| {
                self.stopwatch.time(&self.gpu, |encoder| {
                    let works = [Some(&self.other), batch, Some(&self.other)];
                    works.into_iter().flatten().for_each(|work| work.encode(encoder));
                })
            };
            let without = frame(None)?;
            times.push(Duration::from_nanos(frame(Some(batch))?.saturating_sub(without)));
        }
        Ok(median(times.split_off(times.len() / 2)))
    }

    /// The clock in MHz that NVIDIA's driver reports while the device works; `None` for other
    /// drivers.
    fn clock(&self, batch: &Batch) -> Result<Option<u32>> {
        let query = ["--query-gpu=clocks.sm", "--format=csv,noheader,nounits", "--id=0"];
        let mut command = Command::new("nvidia-smi");
        let command = command.args(query).stdout(Stdio::piped()).stderr(Stdio::null());
        let Ok(mut asked) = command.spawn() else { return Ok(None) };
        while asked.try_wait()?.is_none() {
            self.submit(batch)?;
        }
        let said = asked.wait_with_output()?.stdout;
        Ok(String::from_utf8_lossy(&said).trim().parse().ok())
    }
}

/// A batch of all patches of a workload.
fn of_patches(gpu: &Gpu, workload: &Workload) -> Result<Batch> {
    let mut tessellator = Tessellator::new(&gpu.device);
    batch(gpu, &mut tessellator, (workload, Numbering::PerPatch), .., &[])
}

/// Checks that the shaders' output is the model's.
fn check(gpu: &Gpu, workload: &Workload) -> Result<()> {
    let first = workload.patches.first().ok_or("no patches")?;
    let setup =
        Setup { numbering: Numbering::PerPatch, ..Setup::new(first.domain(), workload.config) };
    let output = Tessellator::new(&gpu.device).tessellate(gpu, setup, &workload.patches)?;
    if digest(&output, setup) == Some(workload.digest(Order::Specification)) {
        return Ok(());
    }
    Err(format!("{}: the digest is not the model's; not timed", workload.name).into())
}

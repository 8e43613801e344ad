//! Times workloads with edited shaders, stage by stage.

use crate::Result;
use crate::digest::digest;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tess_gpu::layout::factor_words;
use tess_gpu::{Numbering, Setup, Stage};
use tess_testkit::listed::{self, ListedFault};
use tess_wgpu::{Batch, DeviceLimits, Gpu, Outputs, Stopwatch, Tessellator};
use tess_workloads::{IndexWidth, Totals, Workload};

/// The number of runs whose median is taken.
const SAMPLES: usize = 7;

/// The measurements to take.
#[derive(Args, Debug)]
pub(crate) struct AblationArguments {
    /// List of edits; those of one name are one variant of the shaders
    edits: PathBuf,
    /// Workloads of `tess bench`, for example uniform-16
    #[arg(required = true, value_name = "WORKLOAD")]
    workloads: Vec<String>,
    /// How often the patches of a workload are repeated [default: as often as 1 GiB of output
    /// needs]
    #[arg(long, value_name = "N")]
    repeats: Option<u64>,
    /// Use only the first N patches of each workload
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    patches: Option<u32>,
}

/// Prints a line for each workload and variant.
pub(crate) fn run(arguments: &AblationArguments) -> Result<()> {
    // For variants that use them.
    let features = Stopwatch::FEATURES | wgpu::Features::SUBGROUP;
    let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, features))?;
    let stopwatch = Stopwatch::new(&gpu)?;
    let variants = variants(&std::fs::read_to_string(&arguments.edits)?)?;
    println!("{}", gpu.name());
    let mut selected = Vec::new();
    for name in &arguments.workloads {
        let named = Workload::named(name);
        if named.is_empty() {
            return Err(
                format!("no workload is called {name}; `tess bench --help` lists them").into()
            );
        }
        selected.extend(named);
    }
    for workload in &mut selected {
        workload.patches.truncate(arguments.patches.map_or(usize::MAX, |patches| patches as usize));
    }
    for workload in &selected {
        let bench = WorkloadBench::new(&gpu, workload, arguments.repeats)?;
        println!("{}, {} triangles", workload.name, bench.totals.primitives * bench.repeats);
        for (name, edits) in &variants {
            println!("{name:<26} {}", bench.line(&gpu, &stopwatch, edits)?);
        }
    }
    Ok(())
}

/// The edits of each variant of a list; the unedited shaders come first.
fn variants(list: &str) -> Result<Vec<(String, Vec<ListedFault>)>> {
    let mut all = vec![("as they are".to_owned(), Vec::new())];
    for edit in listed::parse(list)? {
        match all.last_mut() {
            Some((name, edits)) if *name == edit.name => edits.push(edit),
            _ => all.push((edit.name.clone(), vec![edit])),
        }
    }
    Ok(all)
}

/// The first edit whose text occurs in no shader.
fn missing(edits: &[ListedFault], setup: Setup) -> Option<&ListedFault> {
    let sources = Stage::ALL.map(|stage| stage.source(setup));
    edits.iter().find(|edit| sources.iter().all(|source| edit.places(source) == 0))
}

/// A workload with the buffers of its working set `stream`.
struct WorkloadBench<'a> {
    workload: &'a Workload,
    setup: Setup,
    totals: Totals,
    repeats: u64,
    digest: u64,
    factors: wgpu::Buffer,
    points: wgpu::Buffer,
    indices: wgpu::Buffer,
}

impl<'a> WorkloadBench<'a> {
    fn new(gpu: &Gpu, workload: &'a Workload, repeats: Option<u64>) -> Result<Self> {
        let first = workload.patches.first().ok_or("no patches")?;
        let numbering = Numbering::PerPatch;
        let setup = Setup { numbering, ..Setup::new(first.domain(), workload.config) };
        let totals = workload.totals();
        let repeats = repeats.unwrap_or_else(|| workload.stream_repeats(IndexWidth::U32));
        let words = factor_words(&workload.patches).repeat(usize::try_from(repeats)?);
        let usage = wgpu::BufferUsages::STORAGE;
        Ok(Self {
            workload,
            setup,
            totals,
            repeats,
            digest: workload.digest(tess_core::Order::Specification),
            factors: gpu.upload("factors", bytemuck::cast_slice(&words), usage)?,
            points: gpu.buffer("points", 8 * totals.points * repeats, usage)?,
            indices: gpu.buffer(
                "indices",
                (4 * totals.indices * repeats).next_multiple_of(8),
                usage,
            )?,
        })
    }

    /// Triangles per second, the time of each stage in microseconds, and whether the bits are
    /// right.
    fn line(&self, gpu: &Gpu, stopwatch: &Stopwatch, edits: &[ListedFault]) -> Result<String> {
        if let Some(ListedFault { name, right, .. }) = missing(edits, self.setup) {
            return Err(format!("{name}: no shader has the text\n{right}").into());
        }
        let edits = edits.to_vec();
        let mut tessellator = Tessellator::with_edit(&gpu.device, move |_, source| {
            edits.iter().fold(source, |source, edit| edit.planted(&source).unwrap_or(source))
        });
        let outputs = Outputs::Buffers { points: &self.points, indices: &self.indices };
        let patches = u32::try_from(self.totals.patches * self.repeats)?;
        let batch = tessellator.batch(self.setup, patches, &self.factors, outputs)?;
        warm_up(gpu, &batch)?;
        let mut whole = Vec::new();
        let mut stages = Vec::new();
        for _ in 0..SAMPLES {
            whole.push(stopwatch.time(gpu, |encoder| batch.encode(encoder))?);
            stages.push(stopwatch.time_stages(gpu, &batch)?);
        }
        let time = median(whole);
        let triangles = self.totals.primitives * self.repeats * 1000 / time.max(1);
        let mut line =
            format!("{:>4}.{} G/s {:>6}", triangles / 1000, triangles / 100 % 10, time / 1000);
        for stage in Stage::ALL {
            let own = |sample: &Vec<(Stage, u64)>| {
                sample.iter().filter(|(other, _)| *other == stage).map(|(_, time)| time).sum()
            };
            let time: u64 = median(stages.iter().map(own).collect());
            write!(line, " {} {}", stage.entry_point(), time / 1000)?;
        }
        let observed = self.observed(gpu, &mut tessellator);
        line += if observed == Some(self.digest) { "" } else { " (wrong results)" };
        Ok(line)
    }

    /// The digest of the workload's output; `None` if the output is not consistent.
    fn observed(&self, gpu: &Gpu, tessellator: &mut Tessellator) -> Option<u64> {
        let output = tessellator.tessellate(gpu, self.setup, &self.workload.patches).ok()?;
        digest(&output, self.setup)
    }
}

/// Works until the device has reached its full clock.
fn warm_up(gpu: &Gpu, batch: &Batch) -> Result<()> {
    let start = Instant::now();
    while start.elapsed() < Duration::from_millis(400) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for _ in 0..8 {
            batch.encode(&mut encoder);
        }
        gpu.run(encoder)?;
    }
    Ok(())
}

fn median(mut values: Vec<u64>) -> u64 {
    values.sort_unstable();
    values.get(values.len() / 2).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

    /// The edits of this crate still occur in the shaders.
    #[test]
    fn edits_are_of_the_shaders() {
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        let variants = variants(include_str!("../../../edits")).expect("edits");
        assert!(variants.len() > 5, "{} variants", variants.len());
        for (name, edits) in &variants {
            assert_eq!(missing(edits, Setup::new(Domain::Quad, config)), None, "{name}");
        }
    }
}

//! Times many meshes as groups of one batch, and as separate batches.

use crate::Result;
use crate::timing::device_time;
use std::slice::SliceIndex;
use std::time::Duration;
use tess_core::PatchFactors;
use tess_gpu::layout::factor_words;
use tess_gpu::{Numbering, Setup};
use tess_wgpu::{Batch, DeviceLimits, Gpu, Outputs, Stopwatch, Tessellator};
use tess_workloads::Workload;

/// The number of meshes.
const MESHES: u32 = 256;
/// The time for which each variant runs.
const LONG_ENOUGH: Duration = Duration::from_millis(700);

/// Prints the device's time for each variant, in microseconds.
pub(crate) fn run() -> Result<()> {
    let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, Stopwatch::FEATURES))?;
    let stopwatch = Stopwatch::new(&gpu)?;
    println!("{}", gpu.name());
    let workload = Workload::named("character").remove(0);
    let count = u32::try_from(workload.patches.len())?;
    let begins: Vec<u32> = (0..MESHES).map(|mesh| mesh * count / MESHES).collect();
    println!("{}: {count} patches in {MESHES} meshes, microseconds", workload.name);
    let mut tessellator = Tessellator::new(&gpu.device);
    let numbering = Numbering::PerBatch;
    for (name, groups) in [("one batch", &[][..]), ("one group", &[0]), ("groups", &begins)] {
        let batch = batch(&gpu, &mut tessellator, (&workload, numbering), .., groups)?;
        println!("{name:<12} {:>9.1}", time(&gpu, &stopwatch, &[batch])?);
    }
    let ends = begins.iter().skip(1).copied().chain([count]);
    let batches = begins.iter().zip(ends).map(|(&begin, end)| {
        let range = begin as usize..end as usize;
        batch(&gpu, &mut tessellator, (&workload, numbering), range, &[])
    });
    let batches = batches.collect::<Result<Vec<_>>>()?;
    println!("{:<12} {:>9.1}", "batches", time(&gpu, &stopwatch, &batches)?);
    Ok(())
}

/// Some of a workload's patches with buffers of their own.
pub(crate) fn batch(
    gpu: &Gpu,
    tessellator: &mut Tessellator,
    (workload, numbering): (&Workload, Numbering),
    range: impl SliceIndex<[PatchFactors], Output = [PatchFactors]>,
    groups: &[u32],
) -> Result<Batch> {
    let patches: &[PatchFactors] = &workload.patches[range];
    let first = patches.first().ok_or("no patches")?;
    let setup = Setup { numbering, ..Setup::new(first.domain(), workload.config) };
    let counts = patches.iter().map(|&raw| tess_core::Patch::new(workload.config, raw).counts());
    let (points, indices) = counts.fold((0, 0), |(points, indices), counts| {
        (points + u64::from(counts.points), indices + u64::from(counts.indices))
    });
    let usage = wgpu::BufferUsages::STORAGE;
    let factors = gpu.upload("factors", bytemuck::cast_slice(&factor_words(patches)), usage)?;
    let points = gpu.buffer("points", 8 * points, usage)?;
    let indices = gpu.buffer("indices", (4 * indices).next_multiple_of(8), usage)?;
    let outputs = Outputs::Buffers { points: &points, indices: &indices };
    let count = u32::try_from(patches.len())?;
    Ok(tessellator.batch_in_groups(setup, count, groups, &factors, outputs)?)
}

/// The median time of these batches, one after another, in microseconds.
fn time(gpu: &Gpu, stopwatch: &Stopwatch, batches: &[Batch]) -> Result<f64> {
    device_time(gpu, stopwatch, LONG_ENOUGH, |encoder| {
        batches.iter().for_each(|batch| batch.encode(encoder));
    })
}

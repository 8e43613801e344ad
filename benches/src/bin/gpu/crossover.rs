//! Finds the batch size above which the GPU is faster than one thread of `tess-simd`.

use crate::Result;
use crate::groups::batch;
use crate::timing::SAMPLES;
use std::time::{Duration, Instant};
use tess_benches::median;
use tess_core::{PatchFactors, QuadFactors, TriangleFactors};
use tess_gpu::Numbering;
use tess_wgpu::{Batch, DeviceLimits, Gpu, Stopwatch, Tessellator};
use tess_workloads::Workload;

pub(crate) fn run() -> Result<()> {
    let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, Stopwatch::FEATURES))?;
    let stopwatch = Stopwatch::new(&gpu)?;
    println!("{}; CPU level {}", gpu.name(), tess_simd::Level::detect());
    for name in ["uniform-1", "uniform-4", "uniform-16", "uniform-64", "character"] {
        let workload = Workload::named(name).remove(0);
        println!("{}: patches, microseconds: CPU, device, device and host", workload.name);
        for exponent in 0..=12 {
            let count = 1usize << exponent;
            let cpu = on_cpu(&workload, count)?;
            let (device, both) = on_gpu(&gpu, &stopwatch, &workload, count)?;
            println!("{count:>6} {cpu:>9.1} {device:>9.1} {both:>9.1}");
        }
    }
    Ok(())
}

/// The median time of one call, in microseconds.
fn on_cpu(workload: &Workload, count: usize) -> Result<f64> {
    let mut tessellator = tess_simd::Tessellator::new(workload.config);
    let mut output = tess_simd::Output::<[f32; 2], u32>::new();
    let (mut quads, mut triangles) = (Vec::<QuadFactors>::new(), Vec::<TriangleFactors>::new());
    for patch in workload.patches.iter().take(count) {
        match *patch {
            PatchFactors::Quad(factors) => quads.push(factors),
            PatchFactors::Triangle(factors) => triangles.push(factors),
            PatchFactors::Isoline(_) => return Err("no isolines here".into()),
        }
    }
    let batch = match quads.is_empty() {
        true => tess_simd::Batch::Triangles(&triangles),
        false => tess_simd::Batch::Quads(&quads),
    };
    let mut times = Vec::new();
    for _ in 0..SAMPLES {
        let start = Instant::now();
        tessellator.tessellate(batch, tess_simd::Numbering::PerPatch, &mut output)?;
        times.push(start.elapsed());
    }
    Ok(median(times))
}

/// The median times of a batch on the device, and from encoding until the host knows that it is
/// done.
fn on_gpu(
    gpu: &Gpu,
    stopwatch: &Stopwatch,
    workload: &Workload,
    count: usize,
) -> Result<(f64, f64)> {
    let mut tessellator = Tessellator::new(&gpu.device);
    let of = (workload, Numbering::PerPatch);
    let batch = batch(gpu, &mut tessellator, of, ..count.min(workload.patches.len()), &[])?;
    let mut device = Vec::new();
    let mut both = Vec::new();
    let start = Instant::now();
    while device.len() < SAMPLES || start.elapsed() < Duration::from_millis(300) {
        let nanoseconds = stopwatch.time(gpu, |encoder| batch.encode(encoder))?;
        device.push(Duration::from_nanos(nanoseconds));
        both.push(on_both(gpu, &batch)?);
    }
    // The second half: by then the device has reached its full clock.
    let later = device.len() / 2;
    Ok((median(device.split_off(later)), median(both.split_off(later))))
}

fn on_both(gpu: &Gpu, batch: &Batch) -> Result<Duration> {
    let start = Instant::now();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    batch.encode(&mut encoder);
    gpu.run(encoder)?;
    Ok(start.elapsed())
}

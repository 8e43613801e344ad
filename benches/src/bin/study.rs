//! Measures the CPU's part of `docs/study.md`: the inputs of the study of 2015, by the model, in
//! one call, and 4096 in one batch.
//!
//! ```text
//! cargo run --release -p tess-benches --bin study
//! ```
//!
//! Each line of output is a JSON object: nanoseconds per patch (of all patches for
//! `seed-table/isolines`), triangles per patch, and the processor's clock, which is measured
//! between the others. Outputs are compared with the model's digest first.
#![expect(clippy::print_stdout, reason = "a program that prints what it measured")]
#![expect(clippy::float_arithmetic, reason = "times are divided")]

use std::hint::black_box;
use std::time::{Duration, Instant};
use tess_benches::{Backend, Result, Written, median};
use tess_simd::Level;
use tess_workloads::Workload;

/// Patches of one batch.
const BATCH: usize = 4096;
/// Samples whose median is taken.
const SAMPLES: usize = 21;
/// The least duration of a sample.
const LONG_ENOUGH: Duration = Duration::from_millis(1);

fn main() -> Result<()> {
    for workload in Workload::named("seed-table") {
        println!("{}", row(&workload)?);
    }
    Ok(())
}

/// The line of one workload.
fn row(workload: &Workload) -> Result<String> {
    let level = Level::detect();
    let single = unlike(workload);
    let all = Workload { patches: repeated(workload), ..workload.clone() };
    let calls = || (0..single.patches.len()).map(|patch| patch..patch + 1);
    let batch = std::iter::once(0..BATCH);
    let mut model = Written::new(&single, calls(), Backend::Core)?;
    let mut call = Written::new(&single, calls(), Backend::Simd(level))?;
    let mut batch = Written::new(&all, batch, Backend::Simd(level))?;
    let mut times = [Vec::new(), Vec::new(), Vec::new()];
    let mut clocks = Vec::new();
    [&mut model, &mut call, &mut batch].into_iter().try_for_each(Written::check)?;
    for _ in 0..SAMPLES {
        for (run, times) in [&mut model, &mut call, &mut batch].into_iter().zip(&mut times) {
            clocks.push(turn());
            times.push(sample(run)?);
        }
    }
    // Of one patch, or of the whole workload if it has many.
    let part = |patches: usize| patches as f64 / workload.patches.len() as f64;
    let [model, call, batch] = times.map(|times| 1e3 * median(times));
    let triangles = workload.totals().primitives;
    Ok(format!(
        "{{\"workload\":\"{}\",\"level\":\"{level}\",\"triangles\":{triangles},\"model_ns\":{:.1},\
         \"call_ns\":{:.1},\"batch_ns\":{:.1},\"ghz\":{:.2}}}",
        workload.name,
        model / part(single.patches.len()),
        call / part(single.patches.len()),
        batch / part(BATCH),
        TURN_CLOCKS as f64 / (1e3 * median(clocks)),
    ))
}

/// The workload so that no patch has the factors of the one before: a single patch takes turns with
/// one whose factors are a half lower, which integer partitioning rounds up to the same.
fn unlike(workload: &Workload) -> Workload {
    let mut unlike = workload.clone();
    if let &[patch] = &workload.patches[..] {
        unlike.patches.push(patch.map(|factor| factor - 0.5));
    }
    unlike
}

/// As many patches as a batch has.
fn repeated(workload: &Workload) -> Vec<tess_core::PatchFactors> {
    workload.patches.iter().copied().cycle().take(BATCH).collect()
}

/// The mean time of a run.
fn sample(run: &mut Written<'_>) -> Result<Duration> {
    let (start, mut runs) = (Instant::now(), 0);
    while runs == 0 || start.elapsed() < LONG_ENOUGH {
        run.run()?;
        runs += 1;
    }
    Ok(start.elapsed() / runs)
}

/// Clocks of one [`turn`].
const TURN_CLOCKS: u64 = 1 << 20;

/// The time of operations that wait for each other and take one clock each. None has a constant,
/// which some processors add without taking a clock.
fn turn() -> Duration {
    let (flipped, added) = black_box((0x9E37_79B9_7F4A_7C15_u64, 0xD1B5_4A32_D192_ED03_u64));
    let start = Instant::now();
    let mut value = black_box(1_u64);
    for _ in 0..TURN_CLOCKS / 8 {
        for _ in 0..4 {
            value = (value ^ flipped).wrapping_add(added);
        }
    }
    black_box(value);
    start.elapsed()
}

//! Times of both forms of a stage.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "times and what they are divided by"
)]

use crate::by_wide;
use crate::work::{Form, Stage, Work};
use std::time::Instant;

/// Samples of each form, which take turns.
const SAMPLES: usize = 2000;
/// Runs in a sample.
const RUNS: usize = 8;

/// A row of the table as JSON: nanoseconds a block, or an edge, the least of all samples; and the median of
/// the ratios of neighbouring samples.
pub(crate) fn row(work: &mut Work, stage: Stage) -> String {
    let units = (RUNS * work.len(stage)) as f64;
    let (mut arrays, mut wide) = (f64::INFINITY, f64::INFINITY);
    let mut ratios: Vec<f64> = Vec::with_capacity(SAMPLES);
    for _ in 0..SAMPLES {
        let times = [Form::Arrays, Form::Wide].map(|form| sample(work, stage, form));
        arrays = arrays.min(times[0]);
        wide = wide.min(times[1]);
        ratios.push(times[1] / times[0]);
    }
    ratios.sort_by(f64::total_cmp);
    let (ratio, level) = (ratios[SAMPLES / 2], work.level());
    let (arrays, wide) = (arrays / units, wide / units);
    let (build, vector, stage) = (by_wide::BUILD, by_wide::VECTOR, stage.name());
    format!(
        "{{\"build\": \"{build}\", \"level\": \"{level}\", \"stage\": \"{stage}\", \"unit\": \"ns\", \
         \"arrays\": \"{arrays:.1}\", \"wide\": \"{wide:.1}\", \"vector\": \"{vector}\", \
         \"wide / arrays\": \"{ratio:.2}\"}}"
    )
}

/// Nanoseconds of some runs.
fn sample(work: &mut Work, stage: Stage, form: Form) -> f64 {
    let start = Instant::now();
    for _ in 0..RUNS {
        work.run(stage, form);
    }
    start.elapsed().as_nanos() as f64
}

//! Times on a device.

use crate::Result;
use std::time::{Duration, Instant};
use tess_benches::median;
use tess_wgpu::{Gpu, Stopwatch};

/// The smallest number of runs whose median is taken.
pub(crate) const SAMPLES: usize = 15;

/// The median time of this work on the device, in microseconds; the work is repeated for the given
/// time.
pub(crate) fn device_time(
    gpu: &Gpu,
    stopwatch: &Stopwatch,
    long_enough: Duration,
    work: impl Fn(&mut wgpu::CommandEncoder),
) -> Result<f64> {
    let mut times = Vec::new();
    let start = Instant::now();
    while times.len() < SAMPLES || start.elapsed() < long_enough {
        times.push(Duration::from_nanos(stopwatch.time(gpu, &work)?));
    }
    // The second half: by then the device has reached its full clock.
    Ok(median(times.split_off(times.len() / 2)))
}

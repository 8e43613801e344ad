//! What the benches of the CPU share: workloads written call by call into buffers that are made
//! once.

mod written;

pub use written::{Backend, Written, first_mebibyte};

use std::time::Duration;

/// The result of a measurement.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The median of these times, in microseconds; 0 without times.
#[must_use]
#[expect(clippy::float_arithmetic, reason = "a unit of time")]
pub fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    times.get(times.len() / 2).map_or(0.0, |time| time.as_secs_f64() * 1e6)
}

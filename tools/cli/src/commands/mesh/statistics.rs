//! The amount of work, and the time of each stage.

use crate::output::counted;
use indicatif::ProgressBar;
use std::fmt;
use std::time::{Duration, Instant};
use tess_mesh::{Stage, Watch};

/// The names of the stages.
const STAGES: [&str; 5] = ["load", "factors", "tessellation", "evaluation", "output"];

/// The counts and times of one run.
#[derive(Debug, Default)]
pub(crate) struct Statistics {
    /// The number of patches.
    pub(crate) patches: usize,
    /// The number of vertices in the result.
    pub(crate) vertices: u64,
    /// The number of triangles in the result.
    pub(crate) triangles: u64,
    /// The bar that shows the number of patches that are done.
    pub(crate) bar: Option<ProgressBar>,
    times: [Duration; STAGES.len()],
}

impl Statistics {
    /// Reads, and adds the time to that of loading.
    pub(crate) fn load<T>(&mut self, part: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = part();
        self.times[0] += start.elapsed();
        result
    }

    /// Ends the output, and adds the time to that of the output.
    pub(crate) fn end<T>(&mut self, part: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = part();
        self.spent(Stage::Output, start.elapsed());
        result
    }
}

impl Watch for Statistics {
    fn spent(&mut self, stage: Stage, time: Duration) {
        // Loading is before the library's stages.
        self.times[1 + stage as usize] += time;
    }

    fn done(&mut self, patches: usize) {
        if let Some(bar) = &self.bar {
            bar.set_position(patches as u64);
        }
    }
}

impl fmt::Display for Statistics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { patches, vertices, triangles, times, .. } = self;
        let patches = counted(*patches as u64, "patch");
        let triangles_there = counted(*triangles, "triangle");
        writeln!(f, "{patches}, {vertices} vertices, {triangles_there}")?;
        let mut line = |name: &str, time: Duration| {
            let seconds = time.as_secs_f64();
            let rate = *triangles as f64 / seconds.max(1e-9) / 1e6;
            writeln!(f, "{name:>12} {:>10.2} ms {rate:>10.2} M triangles/s", seconds * 1e3)
        };
        STAGES.iter().zip(times).try_for_each(|(name, time)| line(name, *time))?;
        line("all", times.iter().sum())
    }
}

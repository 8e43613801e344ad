//! The amount of work, and the time of each stage.

use crate::output::counted;
use std::fmt;
use std::time::{Duration, Instant};

/// The stages, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MeshStage {
    /// Reading the file, checking it and finding neighbours.
    Load,
    /// Factors by rule.
    Factors,
    /// Domain points and indices.
    Tessellation,
    /// Positions, normals and texture coordinates.
    Evaluation,
    /// Writing the file or drawing the picture.
    Output,
}

/// The names of the stages.
const STAGES: [&str; 5] = ["load", "factors", "tessellation", "evaluation", "output"];

/// The counts and times of one run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Statistics {
    /// The number of patches.
    pub(crate) patches: usize,
    /// The number of vertices in the result.
    pub(crate) vertices: u64,
    /// The number of triangles in the result.
    pub(crate) triangles: u64,
    times: [Duration; STAGES.len()],
}

impl Statistics {
    /// Runs a part of a stage, and adds its time to the stage.
    pub(crate) fn time<T>(&mut self, stage: MeshStage, part: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = part();
        self.times[stage as usize] += start.elapsed();
        result
    }
}

impl fmt::Display for Statistics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { patches, vertices, triangles, times } = self;
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

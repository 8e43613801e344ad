//! One patch, stage by stage: what `tess explain` prints as text or, with the feature `serde`, JSON.

mod decisions;
mod factors;
mod placement;
mod point;
mod primitive;
mod structure;
mod text;

use crate::case::Case;
use crate::names::Named;
pub use factors::FactorReport;
pub use point::PointReport;
pub use primitive::PrimitiveReport;
#[cfg(feature = "serde")]
use serde::Serialize;
use structure::{PointRun, Stitch};
use tess_core::ProcessedPatch;

/// Every stage of one patch.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize))]
#[cfg_attr(
    not(feature = "serde"),
    expect(dead_code, reason = "the text repeats them in its command")
)]
pub struct Explanation {
    command: String,
    domain: &'static str,
    partitioning: &'static str,
    output: &'static str,
    split: &'static str,
    /// `culled`, `minimum` or `regular`.
    kind: &'static str,
    decisions: Vec<String>,
    factors: Vec<FactorReport>,
    points: u32,
    primitives: u32,
    indices: u32,
    point_runs: Vec<PointRun>,
    stitches: Vec<Stitch>,
}

impl Explanation {
    /// Explains a patch.
    #[must_use]
    pub fn new(case: &Case) -> Self {
        let (patch, raw, config) = (&case.patch(), &case.factors, case.config);
        let counts = patch.counts();
        Self {
            command: case.command(),
            domain: raw.domain().name(),
            partitioning: config.partitioning.name(),
            output: config.output.name(),
            split: config.split.name(),
            kind: match patch.processed() {
                ProcessedPatch::Culled => "culled",
                ProcessedPatch::Minimum(_) => "minimum",
                ProcessedPatch::Regular(_) => "regular",
            },
            decisions: decisions::decisions(patch, raw),
            factors: factors::reports(patch, raw),
            points: counts.points,
            primitives: counts.primitives,
            indices: counts.indices,
            point_runs: structure::point_runs(patch),
            stitches: structure::stitches(patch),
        }
    }
}

/// A 16.16 or 15.16 number, exactly: hex bits and decimal value.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(Serialize))]
pub(crate) struct Fixed {
    /// The bits.
    pub(crate) bits: u32,
    /// `bits / 65536`, exact.
    pub(crate) value: f64,
}

impl Fixed {
    #[expect(clippy::float_arithmetic, reason = "exact: 32 bits divided by a power of two")]
    const fn new(bits: u32) -> Self {
        Self { bits, value: bits as f64 / 65536.0 }
    }
}

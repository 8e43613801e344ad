//! One patch, stage by stage, as `tess explain` prints it: as text or, with the feature `serde`, as
//! JSON.

mod decisions;
mod factors;
mod placement;
mod point;
mod primitive;
mod structure;
mod text;

use super::Part;
use factors::FactorReport;
pub(crate) use point::PointReport;
pub(crate) use primitive::PrimitiveReport;
use std::fmt;
use structure::{PointRun, Stitch};
use tess_verify::Case;
use tess_verify::{Named, way_of};

/// The origin of one part of a patch, or every stage of the patch: as text, and with the feature
/// `serde` as JSON.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Explanation(PartReport);

#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(untagged))]
enum PartReport {
    Patch(Box<PatchReport>),
    Factor(FactorReport),
    Point(PointReport),
    Primitive(PrimitiveReport),
}

impl Explanation {
    /// Explains a part; `None` if the patch has no such part.
    #[must_use]
    pub fn new(case: &Case, part: Part) -> Option<Self> {
        Some(Self(match part {
            Part::Patch => PartReport::Patch(Box::new(PatchReport::new(case))),
            Part::Factor(k) => PartReport::Factor(FactorReport::new(case, k)?),
            Part::Point(i) => PartReport::Point(PointReport::new(&case.patch(), i)?),
            Part::Primitive(t) => PartReport::Primitive(PrimitiveReport::new(&case.patch(), t)?),
        }))
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            PartReport::Patch(report) => report.fmt(f),
            PartReport::Factor(report) => report.fmt(f),
            PartReport::Point(report) => report.fmt(f),
            PartReport::Primitive(report) => report.fmt(f),
        }
    }
}

/// Every stage of one patch.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(
    not(feature = "serde"),
    expect(dead_code, reason = "the text repeats them in its command")
)]
struct PatchReport {
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

impl PatchReport {
    fn new(case: &Case) -> Self {
        let (patch, raw, config) = (&case.patch(), &case.factors, case.config);
        let counts = patch.counts();
        Self {
            command: case.command(),
            domain: raw.domain().name(),
            partitioning: config.partitioning.name(),
            output: config.output.name(),
            split: config.split.name(),
            kind: way_of(patch),
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

/// A 16.16 or 15.16 number, exact: its bits in hex and its decimal value.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(crate) struct Fixed {
    /// The bits.
    pub(crate) bits: u32,
    /// `bits / 65536`, which is exact.
    pub(crate) value: f64,
}

impl Fixed {
    #[expect(clippy::float_arithmetic, reason = "exact: 32 bits divided by a power of two")]
    const fn new(bits: u32) -> Self {
        Self { bits, value: bits as f64 / 65536.0 }
    }
}

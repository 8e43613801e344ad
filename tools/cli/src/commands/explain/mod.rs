//! `tess explain`: every stage of one patch.

use crate::args::PatchArgs;
use crate::failure::{Exit, Failure};
use crate::output::{self, OutputArgs};
use serde::Serialize;
use std::fmt::{self, Display};
use tess_core::Patch;
use tess_verify::explanation::{Explanation, PointReport, PrimitiveReport};

/// Show every stage of one patch: factors, contexts, counts, rings, stitches
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  tess explain quad --outer 3,4,5,6 --inner 4,7
  tess explain tri --outer 2.5,3,1 --inner 3.25 --partitioning fractional_odd --point 7
  tess explain quad --outer 3,4,5,6 --inner 4,7 --primitive 12 --json")]
pub(crate) struct Args {
    #[command(flatten)]
    patch: PatchArgs,
    /// Explain only where this domain point comes from
    #[arg(long, value_name = "I", conflicts_with = "primitive")]
    point: Option<u32>,
    /// Explain only where this primitive comes from
    #[arg(long, value_name = "T")]
    primitive: Option<u32>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    output: OutputArgs,
}

/// Runs the command.
///
/// # Errors
/// Wrong number of factors, no such point or primitive, an output that cannot be written.
pub(crate) fn run(args: &Args) -> Result<Exit, Failure> {
    let case = args.patch.case()?;
    let patch = case.patch();
    let report = match (args.point, args.primitive) {
        (Some(i), _) => Report::Point(found(PointReport::new(&patch, i), &patch, "point", i)?),
        (_, Some(t)) => {
            Report::Primitive(found(PrimitiveReport::new(&patch, t), &patch, "primitive", t)?)
        }
        (None, None) => Report::Patch(Explanation::new(&case)),
    };
    let text = if args.json { output::json(&report) } else { report.to_string() };
    args.output.write(text.as_bytes())?;
    Ok(Exit::Done)
}

#[derive(Serialize)]
#[serde(untagged)]
enum Report {
    Patch(Explanation),
    Point(PointReport),
    Primitive(PrimitiveReport),
}

impl Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Patch(report) => report.fmt(f),
            Self::Point(report) => report.fmt(f),
            Self::Primitive(report) => report.fmt(f),
        }
    }
}

fn found<T>(report: Option<T>, patch: &Patch, what: &str, number: u32) -> Result<T, Failure> {
    let counts = patch.counts();
    report.ok_or_else(|| {
        Failure::bad_input(format!(
            "there is no {what} {number}: the patch has {} and {}, from 0",
            output::counted(counts.points.into(), "point"),
            output::counted(counts.primitives.into(), "primitive")
        ))
    })
}

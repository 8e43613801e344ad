//! `tess explain`: every stage of one patch.

mod modules;

use crate::args::PatchArgs;
use crate::failure::{Exit, Failure};
use crate::output::{self, OutputArgs, Role, refuse_shared};
use modules::Modules;
use serde::Serialize;
use std::fmt::{self, Display};
use std::path::PathBuf;
use tess_show::{Explanation, Part, Signal, SignalDifference};
use tess_verify::Case;

const OBSERVED: &str = "\
Compare what a circuit gave there, name the stage and signal that differ, and end with 1 if any does

Signals of the patch: points, primitives. Of a point: valid, u, v, last. Of a primitive: valid, size, i0, i1, i2, last. Of a \
factor: culled, fixed, odd, fraction, half_points, points, split, inv_floor, inv_ceil. Values are decimal or, with 0x, hex; \
coordinates and factors are fixed-point numbers.";

const SIGNALS: &str = "\
Also name the module that drives a signal which differs, by a list of the circuit's signals

The list has a line for each signal: its part (patch, factor, point or primitive), stage, name and module, with tabs between them. \
Lines that start with # are comments.";

/// Show every stage of one patch: factors, contexts, counts, rings, stitches
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  tess explain quad --outer 3,4,5,6 --inner 4,7
  tess explain tri --outer 2.5,3,1 --inner 3.25 --partitioning fractional_odd --point 7
  tess explain quad --outer 3,4,5,6 --inner 4,7 --primitive 12 --json
  tess explain quad --outer 3,4,5,6 --inner 4,7 --point 20 --observed u=0x4000,v=0x924a
  tess explain quad --outer 3,4,5,6 --inner 4,7 --observed points=36 --signals stages.tsv")]
pub(crate) struct ExplainCommand {
    #[command(flatten)]
    patch: PatchArgs,
    /// Explain only the origin of this domain point
    #[arg(long, value_name = "I", group = "part")]
    point: Option<u32>,
    /// Explain only the origin of this primitive
    #[arg(long, value_name = "T", group = "part")]
    primitive: Option<u32>,
    /// Explain only the processing of this factor; 0 is the first outer one
    #[arg(long, value_name = "K", group = "part")]
    factor: Option<u32>,
    /// Compare a circuit's values there: name the stage and signal of each difference, and end with
    /// exit code 1 if there is any
    #[arg(long, value_name = "SIGNAL=N,..", value_delimiter = ',', value_parser = observation)]
    #[arg(long_help = OBSERVED)]
    observed: Vec<(String, u32)>,
    /// Also name the module that drives a signal which differs, by a list of the circuit's signals
    #[arg(long, value_name = "FILE", requires = "observed", long_help = SIGNALS)]
    signals: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    output: OutputArgs,
}

/// Parses `SIGNAL=N`.
fn observation(text: &str) -> Result<(String, u32), String> {
    let (signal, value) = text.split_once('=').ok_or("expected SIGNAL=N, such as u=0x4000")?;
    let number = match value.strip_prefix("0x") {
        Some(digits) => u32::from_str_radix(digits, 16),
        None => value.parse(),
    };
    let number =
        number.map_err(|_| format!("`{value}` is not a 32-bit number such as 16384 or 0x4000"))?;
    Ok((signal.to_owned(), number))
}

/// Runs the command. Errors: a wrong number of factors; a factor, point, primitive or signal that
/// does not exist; a list of signals that is wrong or cannot be read; an output that cannot be
/// written.
pub(crate) fn run(args: &ExplainCommand) -> Result<Exit, Failure> {
    if let Some(signals) = &args.signals {
        refuse_shared(&[Role::input("--signals", signals), args.output.role()])?;
    }
    let case = args.patch.case()?;
    let part = args.part();
    let explained = Explained { report: report(&case, part)?, circuit: args.circuit(&case, part)? };
    let text = if args.json { output::json(&explained) } else { explained.to_string() };
    args.output.write(text.as_bytes())?;
    let differs = explained.circuit.is_some_and(|circuit| !circuit.is_empty());
    Ok(if differs { Exit::Different } else { Exit::Done })
}

impl ExplainCommand {
    fn part(&self) -> Part {
        let point = self.point.map(Part::Point).or(self.primitive.map(Part::Primitive));
        point.or(self.factor.map(Part::Factor)).unwrap_or(Part::Patch)
    }

    /// The differences from the observed values, if any were given.
    fn circuit(&self, case: &Case, part: Part) -> Result<Option<Vec<Wrong>>, Failure> {
        if self.observed.is_empty() {
            return Ok(None);
        }
        let modules = self.signals.as_deref().map(Modules::read).transpose()?;
        let observed: Vec<(&str, u32)> =
            self.observed.iter().map(|(signal, value)| (signal.as_str(), *value)).collect();
        let differences = tess_show::compare_signals(case, part, &observed)
            .map_err(|error| Failure::bad_input(format!("--observed: {error}")))?;
        let module = |signal| Some(modules.as_ref()?.of(part, signal)?.to_owned());
        let wrong =
            |difference: SignalDifference| Wrong { module: module(difference.signal), difference };
        Ok(Some(differences.into_iter().map(wrong).collect()))
    }
}

/// A signal that differs from the model, with the module that drives it, if a list names it.
#[derive(Serialize)]
struct Wrong {
    #[serde(flatten)]
    difference: SignalDifference,
    #[serde(skip_serializing_if = "Option::is_none")]
    module: Option<String>,
}

impl Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(module) = &self.module else { return self.difference.fmt(f) };
        let SignalDifference { signal: Signal { stage, name, .. }, observed, expected, .. } =
            self.difference;
        write!(
            f,
            "{name} of stage {stage} (module {module}): observed {observed:#x}, expected {expected:#x}"
        )
    }
}

/// The explanation of a part of a patch.
fn report(case: &Case, part: Part) -> Result<Explanation, Failure> {
    Explanation::new(case, part).ok_or_else(|| {
        let counts = case.patch().counts();
        let there_are = match part {
            Part::Factor(_) => output::counted(case.domain().factors() as u64, "factor"),
            _ => format!(
                "{} and {}",
                output::counted(counts.points.into(), "point"),
                output::counted(counts.primitives.into(), "primitive")
            ),
        };
        Failure::bad_input(format!("there is no {part}: the patch has {there_are}, from 0"))
    })
}

/// A report, with the comparison of a circuit's values.
#[derive(Serialize)]
struct Explained {
    #[serde(flatten)]
    report: Explanation,
    #[serde(rename = "differences", skip_serializing_if = "Option::is_none")]
    circuit: Option<Vec<Wrong>>,
}

impl Display for Explained {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.report.fmt(f)?;
        match self.circuit.as_deref() {
            None => Ok(()),
            Some([]) => writeln!(f, "observed: equal"),
            Some(all) => all.iter().try_for_each(|one| writeln!(f, "differs: {one}")),
        }
    }
}

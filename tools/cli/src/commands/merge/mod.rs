//! `tess merge`: proves from the reports of a campaign that all its shards ran once, and adds them up.

mod again;
mod campaign;
mod read;
mod show;

use crate::coverage_file;
use crate::failure::{Exit, Failure};
use crate::output::{OutputArgs, Role, note, refuse_shared};
use campaign::Campaign;
use std::path::{Path, PathBuf};

/// Prove that all shards of a campaign ran once, and add up what they found
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The reports are those that `tess gen`, `check`, `verify` and `probe` write with --report, a line of JSON each; a
file may have several lines. They must be of one program, one command with the same options, one seed and one
number of shards, and each shard must have ended once. Baselines of one name must have the same cases. Where something
is missing, the commands that make it are printed, ready to paste, if all reports show how (docs/campaigns.md).
The files of an earlier run are removed before a report is read, so a run that ends early leaves none.

Exit code 0: every shard ran once, and all is equal; 1: every shard ran once, and something differs; 2: a shard is
missing, double, interrupted or failed, a report is of another campaign, or no case was compared.

Examples:
  tess merge report-*.jsonl
  tess merge report-*.jsonl --csv shards.csv --junit campaign.xml --coverage coverage.xml
  cat report-*.jsonl | tess merge -")]
pub(crate) struct MergeCommand {
    /// Reports of shards; - is stdin
    #[arg(value_name = "REPORT", required = true)]
    reports: Vec<PathBuf>,
    /// Write a row for each shard to this file, missing ones too, as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a test case for each shard to this file, as `JUnit` XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write the hits of all shards to this file, as UCIS XML; the shards must have run with --coverage
    #[arg(long, value_name = "FILE")]
    coverage: Option<PathBuf>,
}

/// Runs the command. Errors: a file that is no report; files that cannot be read or written; shards without coverage
/// where it is asked for.
pub(crate) fn run(args: &MergeCommand) -> Result<Exit, Failure> {
    refuse_shared(&args.roles())?;
    for path in args.outputs().filter_map(|(_, path)| path) {
        OutputArgs { file: path.to_owned() }.require_writable()?;
    }
    let read = read::reports(&args.reports)?;
    read.absent.iter().for_each(|path| note(&format!("there is no {}", path.display())));
    let campaign = Campaign::of(read.reports)?;
    let is_complete = campaign.is_complete() && read.absent.is_empty();
    let write = |path: &Option<PathBuf>, text: fn(&Campaign) -> String| match path {
        Some(path) => OutputArgs { file: path.clone() }.write(text(&campaign).as_bytes()),
        None => Ok(()),
    };
    write(&args.csv, show::csv)?;
    write(&args.junit, show::junit)?;
    if is_complete {
        if let Some(path) = &args.coverage {
            coverage_file::write(path, &campaign.coverage()?)?;
        }
    } else if args.coverage.is_some() {
        note("no coverage is written: the campaign is not complete");
    }
    OutputArgs { file: PathBuf::from("-") }.write(show::text(&campaign).as_bytes())?;
    Ok(match (is_complete, campaign.sum.mismatches) {
        (false, _) => Exit::BadInput,
        (true, 0) => Exit::Done,
        (true, _) => Exit::Different,
    })
}

impl MergeCommand {
    fn outputs(&self) -> impl Iterator<Item = (&'static str, Option<&Path>)> {
        let outputs =
            [("--csv", &self.csv), ("--junit", &self.junit), ("--coverage", &self.coverage)];
        outputs.into_iter().map(|(option, path)| (option, path.as_deref()))
    }

    fn roles(&self) -> Vec<Role<'_>> {
        let inputs = self.reports.iter().map(|path| Role::input("REPORT", path));
        let outputs = self.outputs().filter_map(|(option, path)| Some(Role::output(option, path?)));
        inputs.chain([Role::stdout()]).chain(outputs).collect()
    }
}

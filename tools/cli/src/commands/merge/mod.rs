//! `tess merge`: proves from the reports of a campaign that all its shards ran once, and adds up
//! their results.

mod campaign;
mod read;
mod show;

use crate::failure::{Exit, Failure};
use crate::output::{OutputArgs, Role, note, refuse_shared};
use campaign::Campaign;
use std::path::PathBuf;

/// Prove that all shards of a campaign ran once, and add up their results
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The reports are those that `tess gen`, `check`, `verify` and `probe` write with --report: one line of JSON each. A file may have several lines.

All reports must agree with the first one: the same program, command, options, seed and number of shards, and for `tess check` the same generated cases. Each shard must have ended once. Baselines of one name must have the same lines.

The JUnit file of an earlier run is removed before a report is read, so a run that ends early leaves none. `tess coverage` adds up the shards' coverage.

Exit code 0: every shard ran once, and all is equal; 1: every shard ran once, and something differs; 2: a shard is missing, duplicated, interrupted or failed, a report is of another campaign, or no case was compared.

Examples:
  tess merge report-*.jsonl
  tess merge report-*.jsonl --junit campaign.xml
  cat report-*.jsonl | tess merge -")]
pub(crate) struct MergeCommand {
    /// Reports of shards; - is stdin
    #[arg(value_name = "REPORT", required = true)]
    reports: Vec<PathBuf>,
    /// Write a test case for each shard to this file, as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

/// Runs the command. Errors: a file that is not a report; files that cannot be read or written.
pub(crate) fn run(args: &MergeCommand) -> Result<Exit, Failure> {
    let inputs = args.reports.iter().map(|path| Role::input("REPORT", path));
    let junit = args.junit.iter().map(|path| Role::output("--junit", path));
    refuse_shared(&inputs.chain([Role::stdout()]).chain(junit).collect::<Vec<_>>())?;
    let junit = args.junit.clone().map(|file| OutputArgs { file });
    junit.iter().try_for_each(OutputArgs::require_writable)?;
    let read = read::reports(&args.reports)?;
    read.absent.iter().for_each(|path| note(&format!("there is no {}", path.display())));
    let campaign = Campaign::of(read.reports)?;
    if let Some(file) = junit {
        file.write(show::junit(&campaign).as_bytes())?;
    }
    OutputArgs { file: PathBuf::from("-") }.write(show::text(&campaign).as_bytes())?;
    let is_complete = campaign.is_complete() && read.absent.is_empty();
    Ok(match (is_complete, campaign.sum.mismatches) {
        (false, _) => Exit::BadInput,
        (true, 0) => Exit::Done,
        (true, _) => Exit::Different,
    })
}

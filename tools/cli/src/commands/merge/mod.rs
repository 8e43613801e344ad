//! `tess merge`: proves from the reports of a campaign that all its shards ran once, on all the
//! cases that were asked, and adds up their results.

mod campaign;
mod cases;
mod read;
mod show;

use crate::failure::{Exit, Failure};
use crate::output::{self, OutputArgs, Role, Trusted, note, refuse_shared};
use crate::threads::start_pool;
use campaign::Campaign;
use cases::Compared;
use std::path::PathBuf;

/// Prove that all shards of a campaign ran once, and add up their results
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The reports are those that `tess gen`, `check`, `verify` and `probe` write with --report: one line of JSON each. A file may have several lines.

All reports must agree with the first one: the same program, command, options and number of shards. Each shard must have ended once. Baselines of one name must have the same lines.

Each report has the number of its cases and a digest of them, to which the shards of a campaign add up. `tess merge` makes the asked cases again, as the first report says, or takes them from --cases, and compares: a shard that saw other cases is named. Where the asked cases cannot be known, it says that the cases were not compared.

An earlier JUnit file is removed before a report is read, so a run that ends early leaves none. `tess coverage` adds up the shards' coverage.

Exit code 0: every shard ran once on the cases asked of it, and all is equal; 1: something differs, or the cases were not compared; 2: a shard is missing, duplicated, unfinished, interrupted or failed, or saw other cases; a report is of another campaign; or no case was compared.

Examples:
  tess merge report-*.jsonl
  tess merge report-*.jsonl --junit campaign.xml
  tess merge report-*.jsonl --cases asked-*.txt
  cat report-*.jsonl | tess merge -")]
pub(crate) struct MergeCommand {
    /// Reports of shards; - is stdin
    #[arg(value_name = "REPORT", required = true)]
    reports: Vec<PathBuf>,
    /// Cases that were asked of all shards together: vector files, or lines that begin with `case`
    #[arg(long, value_name = "FILE", num_args = 1..)]
    cases: Vec<PathBuf>,
    /// Write a test case for each shard to this file, as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

/// Runs the command. Errors: a file that is not a report; files that cannot be read or written.
pub(crate) fn run(args: &MergeCommand) -> Result<Exit, Failure> {
    let inputs = args.reports.iter().map(|path| Role::input("REPORT", path));
    let junit = args.junit.iter().map(|path| Role::output("--junit", path));
    let cases = args.cases.iter().map(|path| Role::input("--cases", path));
    refuse_shared(&inputs.chain(cases).chain([Role::stdout()]).chain(junit).collect::<Vec<_>>())?;
    let junit = args.junit.as_deref().map(Trusted::junit);
    output::begin(&junit.into_iter().collect::<Vec<_>>())?;
    let read = read::reports(&args.reports)?;
    read.absent.iter().for_each(|path| note(&format!("there is no {}", path.display())));
    let campaign = Campaign::of(read.reports)?;
    start_pool();
    let compared = cases::compare(&campaign, cases::given(&args.cases)?);
    if let Some(file) = args.junit.clone() {
        OutputArgs { file }.write(show::junit(&campaign, &compared).as_bytes())?;
    }
    OutputArgs { file: PathBuf::from("-") }.write(show::text(&campaign, &compared).as_bytes())?;
    let is_complete = campaign.is_complete() && read.absent.is_empty();
    Ok(match (is_complete, compared, campaign.sum.mismatches) {
        (false, ..) | (_, Compared::Other(_), _) => Exit::BadInput,
        (true, Compared::Equal(_), 0) => Exit::Done,
        (true, ..) => Exit::Different,
    })
}

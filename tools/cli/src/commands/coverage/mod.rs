//! `tess coverage`: adds up coverage files and reports what is missing.

mod covergroups;

use crate::args::name_of;
use crate::coverage_file;
use crate::failure::{Exit, Failure};
use crate::input::{self, name};
use crate::output::{self, OutputArgs, Role, Trusted, counted, note, refuse_shared};
use std::collections::HashSet;
use std::path::PathBuf;
use tess_core::{Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_verify::cover::{Coverage, Exclusions};
use tess_verify::generate::configurations_among;

/// Add up coverage files and report what is missing
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The files are those written by `--coverage FILE` of `tess gen` and `tess check`, and by tess_model.
The report has a line per group of bins, by stage of the specification, then every hole: a bin that was never hit. docs/verification.md describes the groups.

A device that lacks configurations cannot hit every bin. List those that it has, named as in `tess gen` and separated by commas: bins that no such patch can hit are excluded. --exclude FILE excludes more, one pattern per line: a bin's path or its first parts, where each part may be * for any.
  transition               # a group
  configuration/*/pow2     # all of its bins with this partitioning
An excluded bin that was hit is named, because its exclusion is wrong.

Exit code 0: done; 1: with --complete, a hole or a wrong exclusion; 2: malformed or missing files.

Examples:
  tess coverage coverage.xml
  tess coverage shard-*.xml --merged coverage.xml
  tess coverage coverage.xml --domain tri,quad --partitioning integer --split ruler
  tess coverage coverage.xml --exclude device.txt --complete
  tess coverage --covergroups bindings/uvm/src/tess_covergroups.svh")]
pub(crate) struct CoverageCommand {
    /// Coverage files; - is stdin
    #[arg(value_name = "FILE", required_unless_present = "covergroups")]
    files: Vec<PathBuf>,
    /// Write only the bins, to this file, as the covergroups of `tess_uvm` in SystemVerilog
    #[arg(long, value_name = "FILE", exclusive = true)]
    covergroups: Option<PathBuf>,
    /// Domains that the device has [default: all]
    #[arg(long, value_name = "NAME,..", value_delimiter = ',', value_parser = name_of::<Domain>())]
    domain: Vec<Domain>,
    /// Partitionings that the device has [default: all]
    #[arg(long, value_name = "NAME,..", value_delimiter = ',')]
    #[arg(value_parser = name_of::<Partitioning>())]
    partitioning: Vec<Partitioning>,
    /// Output primitives that the device has [default: all]
    #[arg(long, value_name = "NAME,..", value_delimiter = ',')]
    #[arg(value_parser = name_of::<OutputPrimitive>())]
    output: Vec<OutputPrimitive>,
    /// Split orders that the device has [default: all]
    #[arg(long, value_name = "NAME,..", value_delimiter = ',')]
    #[arg(value_parser = name_of::<SplitOrder>())]
    split: Vec<SplitOrder>,
    /// Exclude the bins that this file names
    #[arg(long, value_name = "FILE")]
    exclude: Option<PathBuf>,
    /// End with exit code 1 if there is a hole, or an excluded bin was hit
    #[arg(long)]
    complete: bool,
    /// Write the sum of the files to this file, as UCIS XML
    #[arg(long, value_name = "FILE")]
    merged: Option<PathBuf>,
    #[command(flatten)]
    report: OutputArgs,
}

/// The largest size of an `--exclude` file in bytes; a list of every bin has 110 kB.
const MAX_EXCLUDE_BYTES: u64 = 1 << 24;

/// Runs the command. Errors: a file that is not a coverage file, or is given twice; a pattern that
/// fits no bin; a place that cannot be written.
pub(crate) fn run(args: &CoverageCommand) -> Result<Exit, Failure> {
    if let Some(file) = args.covergroups.clone() {
        OutputArgs { file }.write(covergroups::text().as_bytes())?;
        return Ok(Exit::Done);
    }
    refuse_shared(&args.roles())?;
    args.refuse_double()?;
    args.report.require_writable()?;
    let merged = args.merged.as_deref().map(Trusted::merged);
    output::begin(&merged.into_iter().collect::<Vec<_>>())?;
    let exclusions = args.exclusions()?;
    let mut sum = Coverage::default();
    for file in &args.files {
        sum.merge(&coverage_file::read_from(file)?);
    }
    if let Some(path) = &args.merged {
        coverage_file::write(path, &sum)?;
    }
    args.report.write(sum.report(&exclusions).as_bytes())?;
    Ok(args.judge(&sum, &exclusions))
}

impl CoverageCommand {
    fn roles(&self) -> Vec<Role<'_>> {
        let read = self.files.iter().map(|file| Role::input("FILE", file));
        let exclude = self.exclude.iter().map(|file| Role::input("--exclude", file));
        let merged = self.merged.iter().map(|file| Role::output("--merged", file));
        read.chain(exclude).chain(merged).chain([self.report.role()]).collect()
    }

    /// Refuses a file that would be counted twice.
    fn refuse_double(&self) -> Result<(), Failure> {
        let mut seen = HashSet::new();
        let mut is_new = |file: &&PathBuf| {
            Role::input("FILE", file).identity().is_none_or(|file| seen.insert(file))
        };
        match self.files.iter().find(|file| !is_new(file)) {
            Some(file) => {
                let message = format!("{} is given twice; its hits count once", name(file));
                Err(Failure::bad_input(message))
            }
            None => Ok(()),
        }
    }

    /// The bins that the device cannot hit.
    fn exclusions(&self) -> Result<Exclusions, Failure> {
        let Self { domain, partitioning, output, split, .. } = self;
        let has = configurations_among(domain, partitioning, output, split);
        let mut exclusions = Exclusions::outside(has);
        if let Some(path) = &self.exclude {
            let text = input::text(path, MAX_EXCLUDE_BYTES);
            let text = text.map_err(|error| Failure::file("read", path, &error))?;
            let read = Exclusions::read(&text);
            exclusions.merge(&read.map_err(|error| {
                Failure::bad_input(format!("--exclude {}: {error}", path.display()))
            })?);
        }
        Ok(exclusions)
    }

    fn judge(&self, sum: &Coverage, exclusions: &Exclusions) -> Exit {
        let holes = sum.holes(exclusions).count() as u64;
        let wrong = (exclusions.bins().count() - exclusions.not_hit(sum).bins().count()) as u64;
        if wrong > 0 {
            note(&format!("{} hit though excluded", counted(wrong, "bin")));
        }
        if self.complete && holes + wrong > 0 { Exit::Different } else { Exit::Done }
    }
}

//! `tess bench`: how fast the backends are on this machine.

mod core;
#[cfg(feature = "gpu")]
mod gpu;
mod measure;
mod parts;
mod runner;
mod simd;
mod table;

use crate::backends::{BackendName, BackendOptions};
use crate::failure::{Exit, Failure};
use crate::output;
use measure::{Plan, measure};
use runner::{RunnerOptions, WorkingSet, runner};
use std::io::Write;
use table::{Row, table};
use tess_verify::workloads::{self, Workload};

/// Time the named workloads against filling the same bytes and against the core
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  tess bench --workload uniform-16 --workload uniform-64
  tess bench --backend simd --working-set cache --json > simd.json
  tess bench --backend simd --cpu-level avx2 --workload terrain

Every result is compared with the model before it is timed. Backend, fill and core run in turn;
a part's time is the median of its samples, a workload's the sum over its parts. Workloads:
uniform-1 to uniform-64, seed-table, terrain, character, worst.")]
pub(crate) struct Args {
    /// Workload or family of workloads; may be repeated [default: all]
    #[arg(long, value_name = "NAME")]
    workload: Vec<String>,
    /// Implementation to time
    #[arg(long, value_name = "NAME", default_value = "core")]
    backend: BackendName,
    #[command(flatten)]
    options: BackendOptions,
    /// Where the output goes; may be repeated [default: both]
    #[arg(long, value_name = "NAME")]
    working_set: Vec<WorkingSet>,
    /// Threads to run on
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    /// Interleaved runs that each median is taken of
    #[arg(long, value_name = "N", default_value_t = 9)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1000))]
    samples: u32,
    /// Print one JSON array of objects
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// An unknown workload, a backend that is not available, a result that differs from the model's.
pub(crate) fn run(args: &Args) -> Result<Exit, Failure> {
    let workloads = find_workloads(&args.workload)?;
    let working_sets = match &args.working_set[..] {
        [] => &[WorkingSet::Cache, WorkingSet::Stream],
        chosen => chosen,
    };
    let level = args.options.level_of(args.backend)?;
    let index_type = args.options.index_type;
    let options = RunnerOptions { level, threads: args.threads, index_type };
    let mut runner = runner(args.backend, options)?;
    if cfg!(debug_assertions) {
        // A closed stderr does not change the result.
        _ = writeln!(std::io::stderr(), "this build has debug assertions; figures need --release");
    }
    let progress = output::progress((workloads.len() * working_sets.len()) as u64, "measurements");
    let mut rows = Vec::new();
    for workload in &workloads {
        for &working_set in working_sets {
            progress.set_message(format!("{}, {}", workload.name, working_set.name()));
            let plan = Plan { workload, working_set, samples: args.samples };
            rows.push(measure(runner.as_mut(), plan)?);
            progress.inc(1);
        }
    }
    progress.finish_and_clear();
    print(&rows, args.json)?;
    Ok(Exit::Done)
}

fn find_workloads(names: &[String]) -> Result<Vec<Workload>, Failure> {
    if names.is_empty() {
        return Ok(workloads::all());
    }
    let mut found = Vec::new();
    for name in names {
        let workloads = workloads::named(name);
        if workloads.is_empty() {
            let known: Vec<_> = workloads::all().into_iter().map(|known| known.name).collect();
            let known = known.join(", ");
            return Err(Failure::bad_input(format!(
                "--workload: there is no workload {name}; there are {known}"
            )));
        }
        found.extend(workloads);
    }
    Ok(found)
}

fn print(rows: &[Row], json: bool) -> Result<(), Failure> {
    let text = if json { output::json(&rows) } else { table(rows) };
    let mut out = output::stdout();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    written.map_err(|error| Failure::bad_input(format!("cannot write results: {error}")))
}

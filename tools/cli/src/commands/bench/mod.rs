//! `tess bench`: the speed of the backends on this machine.

mod core;
mod cpu;
#[cfg(feature = "gpu")]
mod gpu;
mod measure;
mod parts;
mod runner;
mod simd;
mod table;

use crate::args::{ORDERS, choice};
use crate::backends::{BackendName, BackendOptions};
use crate::failure::{Exit, Failure};
use crate::output::{self, note, print};
use measure::{Plan, measure};
use runner::{Runner, WorkingSet};
use table::heading;
use tess_simd::{Level, Order};
use tess_workloads::Workload;

/// Time the named workloads against filling the same bytes and against the core
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  tess bench --workload uniform-16 --workload uniform-64
  tess bench --backend simd --working-set cache --json > simd.json
  tess bench --backend simd --cpu-level avx2 --workload terrain
  tess bench --backend simd --index-order cache --workload uniform-64
  tess bench --backend gpu --no-copies --working-set stream --workload uniform
  tess bench --backend simd --threads 8 --frame 16 --workload terrain

Every result is compared with the model before it is timed. Backend, fill and core run in turn;
a part's time is the median of its samples, a workload's the sum over its parts. A row is printed as
soon as it is measured; rows that could not be measured are left out and named at the end. Workloads:
uniform-1 to uniform-64, seed-table, terrain, character, mosaic, mosaic-even, meshes, single, worst. Those of single have
one patch per call: single/uniform-1 to -8 repeat the same patch, which is faster than any other; single/unlike-1 to -64
have patches of equal output whose factors differ from call to call; and in the scenes, neighbours differ.")]
pub(crate) struct BenchCommand {
    /// Workload or family of workloads; may be repeated [default: all]
    #[arg(long, value_name = "NAME")]
    workload: Vec<String>,
    /// Implementation to time
    #[arg(long, value_name = "NAME", default_value = "core")]
    backend: BackendName,
    #[command(flatten)]
    options: BackendOptions,
    /// Destination of the output; may be repeated [default: both]
    #[arg(long, value_name = "NAME")]
    working_set: Vec<WorkingSet>,
    /// Threads to run on
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    /// One batch of about N MiB per call, each after a pause in which threads fall asleep, as
    /// between frames
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1024))]
    frame: Option<u32>,
    /// Number of interleaved runs per median
    #[arg(long, value_name = "N", default_value_t = 9)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1000))]
    samples: u32,
    /// Make the shaders expand each patch, even if it equals its neighbours
    #[arg(long)]
    no_copies: bool,
    /// Order of the triangles that simd and gpu write
    #[arg(long = "index-order", value_name = "NAME", default_value = "specification")]
    #[arg(value_parser = choice(ORDERS))]
    order: Order,
    /// Print one JSON array of objects
    #[arg(long)]
    json: bool,
}

/// Runs the command. Errors: an unknown workload; an unavailable backend; stdout cannot be written.
pub(crate) fn run(args: &BenchCommand) -> Result<Exit, Failure> {
    let workloads = find_workloads(&args.workload)?;
    let working_sets = match &args.working_set[..] {
        [] => &[WorkingSet::Cache, WorkingSet::Stream],
        chosen => chosen,
    };
    args.options.fit(&[args.backend])?;
    let level = args.options.level()?;
    if args.no_copies && args.backend != BackendName::Gpu {
        return Err(Failure::bad_input("--no-copies goes with --backend gpu"));
    }
    if args.threads != 1 && args.backend != BackendName::Simd {
        return Err(Failure::bad_input(
            "--threads goes with --backend simd; core and gpu run on one thread (--threads 1)",
        ));
    }
    if args.order == Order::VertexCache && args.backend == BackendName::Core {
        return Err(Failure::bad_input("--index-order cache goes with --backend simd or gpu"));
    }
    if args.frame.is_some()
        && (args.backend != BackendName::Simd || working_sets != [WorkingSet::Cache])
    {
        return Err(Failure::bad_input("--frame goes with --backend simd --working-set cache"));
    }
    let mut runner = runner(args, level)?;
    if cfg!(debug_assertions) {
        note("this build has debug assertions; figures need --release");
    }
    let plans: Vec<_> = workloads
        .iter()
        .flat_map(|workload| working_sets.iter().map(move |&set| (workload, set)))
        .map(|(workload, working_set)| Plan { workload, working_set, samples: args.samples })
        .collect();
    measure_all(runner.as_mut(), &plans, args.json)
}

/// Measures and prints row by row. A row that cannot be measured is left out and named at the end;
/// the first such row determines the exit code.
fn measure_all(runner: &mut dyn Runner, plans: &[Plan<'_>], json: bool) -> Result<Exit, Failure> {
    let mut before = if json { "[\n".to_owned() } else { heading(runner.description()) };
    let bar = output::progress(plans.len() as u64, "measurements");
    let mut left_out = Vec::new();
    for plan in plans {
        bar.set_message(plan.to_string());
        match measure(runner, *plan) {
            Ok(row) => {
                print(&bar, &(before + &if json { row.json() } else { row.line() }))?;
                before = if json { ",\n".to_owned() } else { String::new() };
            }
            Err(failure) => left_out.push((plan, failure)),
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    if json {
        print(&bar, if left_out.len() == plans.len() { "[]\n" } else { "\n]\n" })?;
    }
    for (plan, failure) in &left_out {
        note(&format!("left out {plan}: {failure}"));
    }
    Ok(left_out.first().map_or(Exit::Done, |(_, failure)| failure.exit))
}

/// The runner of the backend, with a CPU level that this machine supports. Errors: exit code 3 if
/// the backend is not available.
fn runner(args: &BenchCommand, level: Level) -> Result<Box<dyn Runner>, Failure> {
    match args.backend {
        BackendName::Core => Ok(Box::new(core::runner())),
        BackendName::Simd => simd::runner(args, level),
        #[cfg(feature = "gpu")]
        BackendName::Gpu => Ok(Box::new(gpu::GpuRunner::new(args)?)),
        #[cfg(not(feature = "gpu"))]
        BackendName::Gpu => Err(crate::backends::not_built_in("gpu")),
    }
}

fn find_workloads(names: &[String]) -> Result<Vec<Workload>, Failure> {
    if names.is_empty() {
        return Ok(Workload::all());
    }
    let mut found = Vec::new();
    for name in names {
        let workloads = Workload::named(name);
        if workloads.is_empty() {
            let known: Vec<_> = Workload::all().into_iter().map(|known| known.name).collect();
            let known = known.join(", ");
            return Err(Failure::bad_input(format!(
                "--workload: there is no workload {name}; there are {known}"
            )));
        }
        found.extend(workloads);
    }
    Ok(found)
}

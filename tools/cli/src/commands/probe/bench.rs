//! `tess probe --bench`: compares the fixed-function stage with the compute shaders.

use crate::commands::shaders::{Checks, spirv};
use crate::failure::Failure;
use crate::output::{OutputArgs, json, progress};
use std::fmt::Write;
use tess_probe::{BenchTimes, bench};
use tess_workloads::Workload;

/// The number of runs of each way; the fastest counts.
const RUNS: u32 = 10;
/// The workloads that are timed by default: each has triangles of one domain.
const WORKLOADS: [&str; 3] = ["uniform", "terrain", "character"];

/// Times the workloads of these names, or the default ones, and writes a table or JSON.
pub(super) fn run(
    device: usize,
    names: &[String],
    checks: Checks,
    as_json: bool,
    output: &OutputArgs,
) -> Result<(), Failure> {
    let usual: Vec<String> = WORKLOADS.map(str::to_owned).to_vec();
    let names = if names.is_empty() { &usual } else { names };
    let workloads: Vec<Workload> = names.iter().flat_map(|name| Workload::named(name)).collect();
    if workloads.is_empty() {
        return Err(Failure::bad_input("no workload has this name; tess bench --help lists them"));
    }
    let bar = progress(workloads.len() as u64, "workloads");
    let mut rows = Vec::new();
    for workload in &workloads {
        bar.set_message(workload.name.clone());
        let shaders = |stage, setup| spirv(stage, setup, checks);
        rows.push(bench(device, workload, RUNS, &shaders).map_err(Failure::unavailable)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let text = if as_json { json(&rows) } else { table(&rows) };
    output.write(text.as_bytes())
}

/// Milliseconds, and billions of triangles per second, for tessellation alone and from factors to
/// pixels: of the fixed-function stage, of the compute shaders, and of these in vertex-cache order.
#[expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    reason = "figures for people, of less than 2^53 triangles"
)]
fn table(rows: &[BenchTimes]) -> String {
    let ways = ["fixed ms", "G/s", "ours ms", "G/s", "ordered ms", "G/s"];
    let group = |text: &str| format!("{text:^56}");
    let heads: String =
        ways.chunks_exact(2).map(|way| format!("{:>11} {:>6}", way[0], way[1])).collect();
    let mut text = format!(
        "{:35}{}{}\n{:<14} {:>8} {:>11}{heads}  {heads}\n",
        "",
        group("tessellation alone"),
        group("factors to pixels"),
        "workload",
        "patches",
        "triangles",
    );
    for row in rows {
        let cells = |times: [f64; 3]| -> String {
            let cell = |ms| format!("{ms:>11.4} {:>6.2}", row.triangles as f64 / ms * 1e-6);
            times.map(cell).concat()
        };
        let alone = cells([row.fixed, row.compute, row.ordered]);
        let drawn = cells([row.fixed_drawn, row.compute_drawn, row.ordered_drawn]);
        // Writing to a String cannot fail.
        _ = writeln!(
            text,
            "{:<14} {:>8} {:>11}{alone}  {drawn}",
            row.workload, row.patches, row.triangles
        );
    }
    text
}

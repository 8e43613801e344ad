//! The clocks that isolines and the workloads of `tess bench` take, without back-pressure.

use crate::bench::{self, Variant};
use crate::tools::run;
use crate::verdict::BenchVerdict;
use libtest_mimic::Failed;
use std::path::Path;
use std::process::Command;
use tess_commands::command::workspace;
use tess_verify::Case;
use tess_workloads::{Calls, Workload};

/// The number of points of a workload that is enough; the patches after them are left out.
const POINTS: u64 = 100_000;

/// Four lines of eight segments: no workload of `tess bench` has isolines, and random patches have
/// too few in a row to show a clock that is lost between them.
const ISOLINE: &str = "case isoline integer line ruler 40800000 41000000";

/// The bench's text about streams that offer an element in each clock, from the first element of a
/// patch to its last.
const UNBROKEN: &str = "0 clocks without a point, 0 without a primitive";

/// The head of the table.
const HEAD: &str = "\
| workload | patches | points | primitives | clocks | points per clock | primitives per clock | clocks between patches |
| --- | --- | --- | --- | --- | --- | --- | --- |";

/// The head of the table of transfers.
const TRANSFERS: &str = "\
| workload | `POINTS` 1 | `POINTS` 2 | `POINTS` 4 | points per transfer with 2 | with 4 |
| --- | --- | --- | --- | --- | --- |";

/// Clocks between two patches, and from a patch to its first element, at most.
const BETWEEN: u64 = 8;
const LATENCY: u64 = 30;

/// The clocks that `BUFFERED` adds, once: to the first element of a patch.
const BUFFERS: u64 = 2;

/// Prints latencies, then rows of two tables for each workload; docs/rtl.md has all. No stream
/// stands still within a patch, and no bar is missed. With register stages everything is the same,
/// two clocks later. With several points per clock no workload takes longer.
pub(crate) fn are_those_of_the_document() -> Result<(), Failed> {
    let document = std::fs::read_to_string(workspace().join("docs/rtl.md"))?;
    let variants =
        [Variant::Plain, Variant::Buffered, Variant::Two, Variant::Four].map(bench::bench);
    let [plain, buffered, two, four] = variants;
    let (plain, buffered, two, four) = (plain?, buffered?, two?, four?);
    let ([point, primitive], later) = (latencies(&plain)?, latencies(&buffered)?);
    println!("\nclocks, one patch alone: {point} to a point, {primitive} to a primitive");
    let documented = format!("{point} clocks for a point and {primitive} for a primitive");
    let mut wrong = Vec::new();
    if point.max(primitive) > LATENCY || !document.contains(&documented) {
        wrong.push(documented);
    }
    if later != [point, primitive].map(|clocks| clocks + BUFFERS) {
        wrong.push(format!("with register stages {later:?} clocks"));
    }
    println!("{HEAD}");
    let mut transfers = Vec::new();
    for (name, cases) in workloads()? {
        let stimuli = bench::stimuli(&name.replace('/', "-"), &cases)?;
        let Timed { verdict, between, transfers: one } = timed(&plain, &stimuli, cases.len())?;
        let row = row(&name, verdict, &between);
        println!("{row}");
        if !between.parse().is_ok_and(|clocks: u64| clocks <= BETWEEN) || !document.contains(&row) {
            wrong.push(row);
        }
        let clocks = verdict.clocks + BUFFERS;
        let later = timed(&buffered, &stimuli, cases.len())?;
        let due = Timed { verdict: BenchVerdict { clocks, ..verdict }, between, transfers: one };
        if later != due {
            wrong.push(format!("`{name}` with register stages: {later:?}"));
        }
        let [two, four] = [(&two, 0), (&four, BUFFERS)].map(|(bench, added)| {
            let several = timed(bench, &stimuli, cases.len())?;
            let is_slower = several.verdict.clocks > verdict.clocks + added;
            let same = BenchVerdict { clocks: several.verdict.clocks, ..verdict };
            if is_slower || several.verdict != same {
                return Err(Failed::from(format!("`{name}` with several points: {several:?}")));
            }
            Ok(several.transfers)
        });
        transfers.push(transfers_row(&name, verdict.points, [one, two?, four?]));
    }
    println!("{TRANSFERS}");
    for row in transfers {
        println!("{row}");
        if !document.contains(&row) {
            wrong.push(row);
        }
    }
    let wrong = wrong.join("\n");
    if wrong.is_empty() {
        return Ok(());
    }
    Err(format!("docs/rtl.md says otherwise, or a bar is missed:\n{wrong}").into())
}

/// The most clocks from the acceptance of a patch to its first point and primitive, by bench.
fn latencies(bench: &Path) -> Result<[u64; 2], Failed> {
    let said = run(Command::new(bench).args(["+random=1000", "+alone"]))?;
    BenchVerdict::read(&said, 1000)?;
    let latency = line(&said, "latency: ")?;
    let numbers: Vec<u64> = latency.split(' ').filter_map(|word| word.parse().ok()).collect();
    <[u64; 2]>::try_from(numbers).map_err(|_| latency.into())
}

/// A run without back-pressure.
#[derive(Debug, PartialEq)]
struct Timed {
    verdict: BenchVerdict,
    /// The clocks between patches.
    between: String,
    /// The transfers of points.
    transfers: u64,
}

/// Runs these patches; within patches no clock may be without an element.
fn timed(bench: &Path, stimuli: &str, patches: usize) -> Result<Timed, Failed> {
    let said = run(Command::new(bench).arg(stimuli))?;
    let verdict = BenchVerdict::read(&said, patches as u64)?;
    let within = line(&said, "within patches: ")?;
    if within != UNBROKEN {
        return Err(format!("{}: within patches: {within}", bench.display()).into());
    }
    let between = line(&said, "between patches: at most ")?;
    let clocks = between.strip_suffix(" clocks").ok_or("the clocks between patches")?;
    let transfers = line(&said, "transfers of points: ")?.parse()?;
    Ok(Timed { verdict, between: clocks.to_owned(), transfers })
}

/// Names and patches, with enough points each. Those of `tess bench` that come in batches: the
/// circuit does not know the size of a call.
fn workloads() -> Result<Vec<(String, Vec<Case>)>, Failed> {
    let batches = Workload::all().into_iter().filter(|workload| workload.calls == Calls::Batch);
    let mut all: Vec<_> =
        batches.map(|workload| (workload.name.clone(), beginning(&workload))).collect();
    let patches = POINTS.div_ceil(isolines(1)?[0].patch().counts().points.into());
    all.push(("isolines".to_owned(), isolines(usize::try_from(patches)?)?));
    Ok(all)
}

/// So many patches of isolines.
pub(crate) fn isolines(patches: usize) -> Result<Vec<Case>, String> {
    let isoline = ISOLINE.parse().map_err(|error| format!("`{ISOLINE}`: {error}"))?;
    Ok(vec![isoline; patches])
}

/// The first patches, with enough points together.
fn beginning(workload: &Workload) -> Vec<Case> {
    let mut points = 0;
    let cases = workload.patches.iter().zip(workload.counts());
    let chosen = cases.take_while(|(_, counts)| {
        let is_wanted = points < POINTS;
        points += u64::from(counts.points);
        is_wanted
    });
    chosen.map(|(&factors, _)| Case { config: workload.config, factors }).collect()
}

/// The rest of the first line with this prefix.
fn line<'a>(said: &'a str, prefix: &str) -> Result<&'a str, String> {
    said.lines()
        .find_map(|line| line.strip_prefix(prefix))
        .ok_or_else(|| format!("the bench does not say `{prefix}`:\n{said}"))
}

fn row(name: &str, verdict: BenchVerdict, between: &str) -> String {
    let BenchVerdict { patches, points, primitives, clocks } = verdict;
    let rate = |elements: u64| rate(elements, clocks);
    format!(
        "| `{name}` | {patches} | {points} | {primitives} | {clocks} | {} | {} | {between} |",
        rate(points),
        rate(primitives)
    )
}

/// Elements per clock or transfer, cut off after three digits.
fn rate(elements: u64, clocks: u64) -> String {
    let thousandths = elements * 1000 / clocks.max(1);
    format!("{}.{:03}", thousandths / 1000, thousandths % 1000)
}

fn transfers_row(name: &str, points: u64, [one, two, four]: [u64; 3]) -> String {
    let (of_two, of_four) = (rate(points, two), rate(points, four));
    format!("| `{name}` | {one} | {two} | {four} | {of_two} | {of_four} |")
}

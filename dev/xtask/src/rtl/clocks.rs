//! The clocks that isolines and the workloads of `tess bench` take, without back-pressure.

use super::bench::Bench;
use super::sources;
use crate::command;
use tess_testkit::verdict::BenchVerdict;
use tess_verify::Case;
use tess_verify::workloads::{Calls, Workload};

/// The number of points of a workload that is enough; the patches after them are left out.
const POINTS: u64 = 100_000;

/// Four lines of eight segments, because no workload of `tess bench` that is used here has
/// isolines.
pub(super) const ISOLINE: &str = "case isoline integer line ruler 40800000 41000000";

/// The bench's text about streams that offer an element in each clock, from the first element of a
/// patch to its last.
const UNBROKEN: &str = "0 clocks without a point, 0 without a primitive";

/// The largest numbers of clocks between two patches, and from a patch to its first element.
const BETWEEN: u64 = 8;
const LATENCY: u64 = 30;

/// Prints latencies, then a table row per workload; docs/rtl.md must have both.
///
/// # Errors
/// A patch differs from the model, a stream stalls within a patch, or a number of clocks differs
/// from that in the document.
pub(crate) fn run(bench: &Bench) -> Result<(), String> {
    let document = sources().with_file_name("docs/rtl.md");
    let document = command::read(&document)?;
    let (_, said) = bench.compare(&["+random=1000", "+alone"], 1000)?;
    let latency = line(&said, "latency: ")?;
    println!("\nclocks, one patch alone: {latency}");
    let latencies: Vec<u64> = latency.split(' ').filter_map(|word| word.parse().ok()).collect();
    let [point, primitive] = latencies[..] else { return Err(format!("`{latency}`")) };
    let mut wrong = Vec::new();
    if point.max(primitive) > LATENCY
        || !document
            .contains(&format!("{point} clocks for a point and {primitive} for a primitive"))
    {
        wrong.push(latency.to_owned());
    }
    println!(
        "\n| workload | patches | points | primitives | clocks | points per clock | primitives per clock | clocks between patches |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for (name, cases) in workloads()? {
        let stimuli = bench.stimuli(&name.replace('/', "-"), &cases)?;
        let (verdict, said) = bench.compare(&[&stimuli], cases.len())?;
        let between = line(&said, "between patches: at most ")?.replace(" clocks", "");
        let row = row(&name, verdict, &between);
        println!("{row}");
        let within = line(&said, "within patches: ")?;
        if within != UNBROKEN {
            wrong.push(format!("`{name}`, within patches: {within}"));
        }
        if !between.parse().is_ok_and(|clocks: u64| clocks <= BETWEEN) || !document.contains(&row) {
            wrong.push(row);
        }
    }
    match wrong.is_empty() {
        true => Ok(()),
        false => {
            Err(format!("docs/rtl.md says otherwise, or a bar is missed:\n{}", wrong.join("\n")))
        }
    }
}

/// Names and patches, each with enough points: the workloads of `tess bench` that come in batches,
/// because the circuit does not know the size of a call.
fn workloads() -> Result<Vec<(String, Vec<Case>)>, String> {
    let batches = Workload::all().into_iter().filter(|workload| workload.calls == Calls::Batch);
    let mut all: Vec<_> =
        batches.map(|workload| (workload.name.clone(), beginning(&workload))).collect();
    let isoline: Case = ISOLINE.parse().map_err(|error| format!("`{ISOLINE}`: {error}"))?;
    let patches = POINTS.div_ceil(isoline.patch().counts().points.into());
    let patches = usize::try_from(patches).map_err(|error| error.to_string())?;
    all.push(("isolines".to_owned(), vec![isoline; patches]));
    Ok(all)
}

/// The first patches that together have enough points.
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
    let rate = |elements: u64| {
        let thousandths = elements * 1000 / clocks.max(1);
        format!("{}.{:03}", thousandths / 1000, thousandths % 1000)
    };
    format!(
        "| `{name}` | {patches} | {points} | {primitives} | {clocks} | {} | {} | {between} |",
        rate(points),
        rate(primitives)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_have_three_places() {
        let verdict = BenchVerdict { patches: 1, points: 9, primitives: 8, clocks: 16 };
        let expected = "| `x` | 1 | 9 | 8 | 16 | 0.562 | 0.500 | 3 |";
        assert_eq!(row("x", verdict, "3"), expected, "a row");
    }

    #[test]
    fn a_beginning_has_enough_points() {
        let worst = Workload::named("worst").remove(0);
        let some = beginning(&worst);
        let points: u32 = some.iter().map(|case| case.patch().counts().points).sum();
        assert!(u64::from(points) >= POINTS && some.len() < worst.patches.len(), "{points} points");
    }
}

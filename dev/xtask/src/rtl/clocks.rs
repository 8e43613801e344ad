//! How many clocks the workloads of `tess bench` take, without back-pressure.

use super::bench::Bench;
use super::sources;
use crate::command;
use tess_testkit::verdict::BenchVerdict;
use tess_verify::Case;
use tess_verify::generate::{Calls, Workload};

/// Points of a workload that are enough; what is behind them is left out.
const POINTS: u64 = 100_000;

/// Clocks between two patches, and from a patch to its first element, at most.
const BETWEEN: u64 = 8;
const LATENCY: u64 = 30;

/// Prints latencies, then a row of a table for each workload; both must stand in docs/rtl.md.
///
/// # Errors
/// A patch differs from the model, or a clock from the document.
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
        "\n| workload | patches | points | primitives | clocks | points a clock | primitives a clock | clocks between patches |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    // The circuit does not know how many patches a call has.
    let batches = Workload::all().into_iter().filter(|workload| workload.calls == Calls::Batch);
    for workload in batches {
        let file = workload.name.replace('/', "-");
        let cases = beginning(&workload);
        let stimuli = bench.stimuli(&file, &cases)?;
        let (verdict, said) = bench.compare(&[&stimuli], cases.len())?;
        let between = line(&said, "between patches: at most ")?.replace(" clocks", "");
        let row = row(&workload.name, verdict, &between);
        println!("{row}");
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

/// The rest of the first line that has this prefix.
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

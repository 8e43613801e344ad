//! The table: what `tess probe` finds on each driver, and how long a frame takes.

use super::{Place, Variant, source};
use crate::command::{self, cargo};
use serde::Deserialize;
use std::path::Path;
use std::process::Command;

/// What is asked of each driver: a name for the table, and arguments of `tess probe`.
const QUESTIONS: &[(&str, &[&str])] = &[
    ("level 1", &["--level", "1"]),
    ("level 3, 60000 patches", &["--level", "3", "--count", "60000"]),
    ("level 1, draws of 200000 vertices", &["--level", "1", "--draw-vertices", "200000"]),
];

/// The question whose draws are too long for Mesa as it is.
const LONG: usize = 2;

/// What `tess probe` says of a driver that mixes the vertices of different patches, as one does whose numbers wrap.
const NO_SENSE: &str = "the capture makes no sense";

/// The workloads whose frames are timed, one of each domain of triangles.
const WORKLOADS: &[&str] = &["terrain", "character"];

/// A report of `tess probe --json`, as far as it is used here.
#[derive(Deserialize)]
struct Report {
    rows: Vec<Row>,
}

/// Patches of one configuration: each in one column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
struct Row {
    patches: u64,
    sequence: u64,
    leading: u64,
    order: u64,
    connectivity: u64,
    coordinates: u64,
    culling: u64,
}

impl Row {
    fn sum(rows: &[Self]) -> Self {
        rows.iter().fold(Self::default(), |sum, row| Self {
            patches: sum.patches + row.patches,
            sequence: sum.sequence + row.sequence,
            leading: sum.leading + row.leading,
            order: sum.order + row.order,
            connectivity: sum.connectivity + row.connectivity,
            coordinates: sum.coordinates + row.coordinates,
            culling: sum.culling + row.culling,
        })
    }

    /// As many patches as `other` has, all with other primitives.
    fn all_wrong(other: Self) -> Self {
        Self { patches: other.patches, connectivity: other.patches, ..Self::default() }
    }

    /// The columns of what differs.
    const fn differing(self) -> [u64; 5] {
        [self.leading, self.order, self.connectivity, self.coordinates, self.culling]
    }

    /// Whether no column of what differs is larger than `other`'s.
    fn is_no_worse_than(self, other: Self) -> bool {
        self.patches == other.patches
            && self.differing().iter().zip(other.differing()).all(|(own, other)| *own <= other)
    }
}

/// Times of a workload from `tess probe --bench --json`.
#[derive(Deserialize)]
struct Times {
    workload: String,
    triangles: u64,
    fixed: f64,
    fixed_drawn: f64,
}

/// What was found of one driver.
struct Found {
    variant: Variant,
    answers: Vec<Row>,
    times: Vec<Times>,
}

/// Asks every driver, prints the table, and judges it.
///
/// # Errors
/// A driver fails; a patched one is worse than the unpatched one, or draws long draws otherwise than short ones.
pub(super) fn run(place: &Place) -> Result<(), String> {
    let program = command::program()?;
    let found: Vec<Found> = Variant::ALL
        .into_iter()
        .map(|variant| ask(&program, place, variant))
        .collect::<Result<_, _>>()?;
    println!("\n{}", table(&found));
    judge(&found)
}

/// Runs this project's tests of Vulkan devices on the driver with all patches.
///
/// # Errors
/// A test fails.
pub(super) fn test(place: &Place) -> Result<(), String> {
    let mut tests = cargo("xtask test tess-wgpu/tests tools/probe/tests");
    tests.env("VK_DRIVER_FILES", place.manifest(Variant::WholeDraws));
    command::run(&mut tests)
}

fn ask(program: &Path, place: &Place, variant: Variant) -> Result<Found, String> {
    let manifest = place.manifest(variant);
    if !manifest.exists() {
        return Err(format!(
            "{} is missing: `cargo xtask mesa build` makes it",
            manifest.display()
        ));
    }
    let mut answers = Vec::new();
    for (number, (_, arguments)) in QUESTIONS.iter().enumerate() {
        let row = match probe::<Report>(program, &manifest, arguments) {
            Ok(report) => Row::sum(&report.rows),
            Err(said) if number == LONG && said.contains(NO_SENSE) => Row::all_wrong(answers[0]),
            Err(said) => return Err(said),
        };
        answers.push(row);
    }
    let mut arguments = vec!["--bench"];
    arguments.extend(WORKLOADS.iter().flat_map(|workload| ["--workload", workload]));
    let times = probe(program, &manifest, &arguments)?;
    Ok(Found { variant, answers, times })
}

/// What `tess probe --json` says of a driver. It ends with 1 where patches differ, which is an answer.
fn probe<T: for<'a> Deserialize<'a>>(
    program: &Path,
    manifest: &Path,
    arguments: &[&str],
) -> Result<T, String> {
    let mut command = Command::new(program);
    command.args(["probe", "--json"]).args(arguments).env("VK_DRIVER_FILES", manifest);
    println!("\n$ VK_DRIVER_FILES={} {}", manifest.display(), command::shown(&command));
    let output = command.output().map_err(|error| format!("cannot run `tess probe`: {error}"))?;
    if !matches!(output.status.code(), Some(0 | 1)) {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`tess probe` ended with {}: {said}", output.status));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| format!("`tess probe --json`: {error}"))
}

/// The table, in Markdown.
fn table(found: &[Found]) -> String {
    let mut lines = vec![
        format!("Mesa {}; patches by how they compare with the model:", source::VERSION),
        "| driver | asked | patches | in order | leading | reorder | connected | points | culling |".into(),
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |".into(),
    ];
    for (number, (question, _)) in QUESTIONS.iter().enumerate() {
        for Found { variant, answers, .. } in found {
            let row = answers[number];
            let differing = row.differing().map(|count| count.to_string()).join(" | ");
            let (name, patches, sequence) = (variant.name(), row.patches, row.sequence);
            lines.push(format!("| {name} | {question} | {patches} | {sequence} | {differing} |"));
        }
    }
    lines.push("\n| workload | triangles | driver | discarded, ms | drawn, ms |".into());
    lines.push("| --- | --- | --- | --- | --- |".into());
    for Found { variant, times, .. } in found {
        for Times { workload, triangles, fixed, fixed_drawn } in times {
            let name = variant.name();
            lines.push(format!(
                "| {workload} | {triangles} | {name} | {fixed:.2} | {fixed_drawn:.2} |"
            ));
        }
    }
    lines.join("\n")
}

fn judge(found: &[Found]) -> Result<(), String> {
    let [unpatched, one_patch, whole_draws] = found else {
        return Err(format!("{} drivers were asked, not 3", found.len()));
    };
    for Found { variant, answers, .. } in [one_patch, whole_draws] {
        for (number, (question, _)) in QUESTIONS.iter().enumerate() {
            if !answers[number].is_no_worse_than(unpatched.answers[number]) {
                return Err(format!("{question}: {} is worse than unpatched", variant.name()));
            }
        }
    }
    if whole_draws.answers[LONG] != whole_draws.answers[0] {
        return Err("long draws with all patches differ from short ones".to_owned());
    }
    if unpatched.answers[LONG] == unpatched.answers[0] {
        return Err("long draws are right without patches: the question shows nothing".to_owned());
    }
    println!(
        "\nno patched driver is worse in any column; long draws are right with all patches alone"
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(variant: Variant, answers: [Row; 3]) -> Found {
        Found { variant, answers: answers.to_vec(), times: Vec::new() }
    }

    #[test]
    fn worse_drivers_are_refused() {
        let exact = Row { patches: 10, sequence: 10, ..Row::default() };
        let flushing = Row { sequence: 8, culling: 2, ..exact };
        let wrapping = Row { sequence: 5, connectivity: 5, ..exact };
        let unpatched = || found(Variant::Unpatched, [flushing, flushing, wrapping]);
        let one_patch = |answers| found(Variant::OnePatch, answers);
        let whole_draws = |answers| found(Variant::WholeDraws, answers);
        let good = one_patch([exact, flushing, wrapping]);
        assert_eq!(judge(&[unpatched(), good, whole_draws([exact; 3])]), Ok(()), "better");

        let other = Row { sequence: 8, order: 2, ..exact };
        let bad = one_patch([exact, other, wrapping]);
        assert!(judge(&[unpatched(), bad, whole_draws([exact; 3])]).is_err(), "another column");
        let few = Row { patches: 9, sequence: 9, ..exact };
        let bad = one_patch([few, exact, exact]);
        assert!(
            judge(&[unpatched(), bad, whole_draws([exact; 3])]).is_err(),
            "patches are missing"
        );
        let bad = whole_draws([exact, exact, wrapping]);
        assert!(judge(&[unpatched(), one_patch([exact; 3]), bad]).is_err(), "long draws wrap");
        let right = found(Variant::Unpatched, [flushing; 3]);
        let judged = judge(&[right, one_patch([exact; 3]), whole_draws([exact; 3])]);
        assert!(judged.is_err(), "nothing was wrong before");
    }
}

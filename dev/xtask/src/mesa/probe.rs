//! What `tess probe` says of a driver's Vulkan: how its patches compare with the model, and how long a frame takes.

use super::{Place, Variant};
use crate::command;
use serde::Deserialize;
use std::path::Path;
use std::process::Command;

/// What is asked of each driver: a name for the table, and arguments of `tess probe`.
pub(super) const QUESTIONS: &[(&str, &[&str])] = &[
    ("level 1", &["--level", "1"]),
    ("level 3, 60000 patches", &["--level", "3", "--count", "60000"]),
    ("level 1, draws of 200000 vertices", &["--level", "1", "--draw-vertices", "200000"]),
];

/// The question whose draws are too long for Mesa as it is.
pub(super) const LONG: usize = 2;

/// What `tess probe` says of a driver that mixes the vertices of different patches, as one does whose numbers wrap.
const NO_SENSE: &str = "the capture makes no sense";

/// The workloads whose frames are timed: those of `tess bench` whose frames an unpatched driver draws in seconds.
const WORKLOADS: &[&str] = &[
    "uniform-1",
    "uniform-2",
    "uniform-4",
    "uniform-8",
    "uniform-16",
    "terrain",
    "character",
    "mosaic",
    "mosaic-even",
];

/// How often each driver draws them, in turn; a run's time is that of its fastest frame.
const ROUNDS: usize = 2;

/// A report of `tess probe --json`, as far as it is used here.
#[derive(Deserialize)]
struct ProbeReport {
    rows: Vec<Row>,
}

/// Patches of one configuration: each in one column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub(super) struct Row {
    pub(super) patches: u64,
    pub(super) sequence: u64,
    pub(super) leading: u64,
    pub(super) order: u64,
    pub(super) connectivity: u64,
    pub(super) coordinates: u64,
    pub(super) culling: u64,
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
    pub(super) const fn differing(self) -> [u64; 5] {
        [self.leading, self.order, self.connectivity, self.coordinates, self.culling]
    }

    /// Whether no column of what differs is larger than `other`'s.
    pub(super) fn is_no_worse_than(self, other: Self) -> bool {
        self.patches == other.patches
            && self.differing().iter().zip(other.differing()).all(|(own, other)| *own <= other)
    }
}

/// Times of a workload from `tess probe --bench --json`, in milliseconds.
#[derive(Deserialize)]
pub(super) struct Times {
    pub(super) workload: String,
    pub(super) triangles: u64,
    /// With rasterisation discarded.
    pub(super) fixed: f64,
    pub(super) fixed_drawn: f64,
}

/// The answer to each of [`QUESTIONS`].
pub(super) fn ask(program: &Path, place: &Place, variant: Variant) -> Result<Vec<Row>, String> {
    let mut answers = Vec::new();
    for (number, (_, arguments)) in QUESTIONS.iter().enumerate() {
        let row = match probe::<ProbeReport>(program, place, variant, arguments) {
            Ok(report) => Row::sum(&report.rows),
            Err(said) if number == LONG && said.contains(NO_SENSE) => Row::all_wrong(answers[0]),
            Err(said) => return Err(said),
        };
        answers.push(row);
    }
    Ok(answers)
}

/// The fastest frames of each driver, which take turns: what else the machine does falls on all of them.
pub(super) fn frames(program: &Path, place: &Place) -> Result<Vec<Vec<Times>>, String> {
    let mut arguments = vec!["--bench"];
    arguments.extend(WORKLOADS.iter().flat_map(|workload| ["--workload", workload]));
    let mut fastest: Vec<Vec<Times>> = Variant::ALL.map(|_| Vec::new()).into();
    for _ in 0..ROUNDS {
        for (fastest, variant) in fastest.iter_mut().zip(Variant::ALL) {
            let times = probe::<Vec<Times>>(program, place, variant, &arguments)?;
            for (fastest, times) in fastest.iter_mut().zip(&times) {
                fastest.fixed = fastest.fixed.min(times.fixed);
                fastest.fixed_drawn = fastest.fixed_drawn.min(times.fixed_drawn);
            }
            if fastest.is_empty() {
                *fastest = times;
            }
        }
    }
    Ok(fastest)
}

/// What `tess probe --json` says of a driver. It ends with 1 where patches differ, which is an answer.
fn probe<T: for<'a> Deserialize<'a>>(
    program: &Path,
    place: &Place,
    variant: Variant,
    arguments: &[&str],
) -> Result<T, String> {
    let mut command = Command::new(program);
    command.args(["probe", "--json"]).args(arguments).envs(place.environment(variant));
    println!("\n$ {}, on {}", command::shown(&command), variant.name());
    let output = command.output().map_err(|error| format!("cannot run `tess probe`: {error}"))?;
    if !matches!(output.status.code(), Some(0 | 1)) {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`tess probe` ended with {}: {said}", output.status));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| format!("`tess probe --json`: {error}"))
}

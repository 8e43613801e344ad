//! Pairwise combinations of options: those that are accepted produce the model's result, and the
//! refusal of the others names both options.
//!
//! A run takes 3 ms of processor time, 200 ms with the GPU and 400 ms with a report, so few rows
//! have these two.

mod checks;

use crate::support::{Run, directory, tess};
use serde_json::{Value, json};
use std::fs::write;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_show::{DrawOptions, draw};
use tess_testkit::pairs::Options;
use tess_verify::Case;
use tess_verify::vectors::Listing;

/// Two values that exclude each other, and the words of the message about each.
type Excluded = ((usize, &'static str), (usize, &'static str), [&'static str; 2]);

/// Options by their values, each of which is words of a command line or empty, after the four that
/// make the patch.
struct Crossed {
    values: Vec<Vec<&'static str>>,
    excluded: Vec<Excluded>,
}

/// The beginnings of the values that are expensive to run.
const SELDOM: [&str; 2] = ["--backend gpu", "--report"];

/// Domain, partitioning, output and split order.
const OF_PATCH: [usize; 4] = [3, 4, 4, 2];

impl Crossed {
    fn says(&self, pair: [(usize, usize); 2]) -> Option<[&'static str; 2]> {
        let first = OF_PATCH.len();
        let named = |(option, value): (usize, usize)| {
            option.checked_sub(first).map(|option| (option, self.values[option][value]))
        };
        let [a, b] = pair.map(named);
        let found = self
            .excluded
            .iter()
            .find(|(x, y, _)| [(Some(*x), Some(*y)), (Some(*y), Some(*x))].contains(&(a, b)));
        found.map(|(.., says)| *says)
    }

    fn seldom(&self) -> Vec<(usize, usize)> {
        let all = self.values.iter().zip(OF_PATCH.len()..);
        let all = all.flat_map(|(words, option)| words.iter().zip(0..).map(move |w| (option, w)));
        let dear = all.filter(|(_, (words, _))| SELDOM.iter().any(|dear| words.starts_with(dear)));
        dear.map(|(option, (_, value))| (option, value)).collect()
    }

    /// Calls `taken` with each row that is accepted, and `refused` with each that is not and the
    /// words that its message must contain.
    fn run(
        &self,
        mut taken: impl FnMut(Case, &[&str]),
        mut refused: impl FnMut(Case, &[&str], [&str; 2]),
    ) {
        let counts: Vec<usize> =
            OF_PATCH.into_iter().chain(self.values.iter().map(Vec::len)).collect();
        let options = Options::new(&counts, |a, b| self.says([a, b]).is_some());
        let options = options.seldom(&self.seldom());
        let split = |row: &[usize]| {
            let words = row[OF_PATCH.len()..].iter().zip(&self.values);
            (case(row), words.map(|(value, all)| all[*value]).collect::<Vec<_>>())
        };
        for row in options.rows() {
            let (case, words) = split(&row);
            taken(case, &words);
        }
        for (pair, row) in options.refused() {
            let (case, words) = split(&row);
            refused(case, &words, self.says(pair).expect("the pair is excluded"));
        }
    }
}

/// A patch that no freedom of a device changes.
fn case(row: &[usize]) -> Case {
    let factors = PatchFactors::from_fn(Domain::ALL[row[0]], |i| FACTORS[i]);
    let (partitioning, output) = (Partitioning::ALL[row[1]], OutputPrimitive::ALL[row[2]]);
    Case { config: Config { partitioning, output, split: SplitOrder::ALL[row[3]] }, factors }
}

const FACTORS: [f32; 6] = [3.0, 4.5, 5.0, 6.25, 4.0, 7.0];

/// Whether the options ask for a GPU but the program is built without it, which it must report.
fn is_left_out(run: &Run, words: &[&str]) -> bool {
    let is_left_out =
        !cfg!(feature = "gpu") && words.iter().any(|words| words.starts_with("--backend gpu"));
    if is_left_out {
        run.exits(3).prints_nothing().says("has no gpu backend");
    }
    is_left_out
}

fn is_refused(run: &Run, words: &str, says: [&str; 2]) {
    let is_refused = (run.code, run.stdout.as_str()) == (Some(2), "");
    let is_said = says.iter().all(|says| run.stderr.contains(says));
    assert!(is_refused && is_said, "{words}: {says:?}: {run}");
}

/// How a backend runs. The option `--backend` comes first, and these are its values.
fn of_backends(backends: &[&'static str]) -> Vec<Excluded> {
    let (level, narrow) = ((1, "--cpu-level baseline"), (2, "--index-type u16"));
    let excluded = |&backend: &&'static str| {
        let no_level = !backend.contains("simd");
        let level = no_level.then_some(((0, backend), level, ["--cpu-level", "--backend"]));
        let is_wide = no_level && !backend.contains("gpu");
        let narrow = is_wide.then_some(((0, backend), narrow, ["--index-type", "--backend"]));
        level.into_iter().chain(narrow)
    };
    backends.iter().flat_map(excluded).collect()
}

const BACKENDS: [&[&str]; 3] = [
    &["", "--backend core", "--backend simd", "--backend gpu"],
    &["", "--cpu-level baseline"],
    &["", "--index-type u16", "--index-type u32"],
];

/// The options of backends, followed by others.
fn with_backends(others: &[&[&'static str]]) -> Vec<Vec<&'static str>> {
    BACKENDS.iter().chain(others).map(|values| values.to_vec()).collect()
}

#[test]
fn patches_are_the_models_whatever_the_options() {
    let values = with_backends(&[&[
        "",
        "--format text",
        "--format csv",
        "--format obj",
        "--format json",
        "--format svg",
    ]]);
    let crossed = Crossed { values, excluded: of_backends(BACKENDS[0]) };
    let line = |case: Case, words: &[&str]| format!("{} {}", &case.command()[5..], words.join(" "));
    crossed.run(
        |case, words| {
            let run = tess(&line(case, words));
            if is_left_out(&run, words) {
                return;
            }
            run.exits(0);
            let backend = words[0].split(' ').nth(1).unwrap_or("core");
            let form = words[3].split(' ').nth(1).unwrap_or("text");
            is_model(form, &run.stdout, case, backend, &format!("{case}: {words:?}"));
        },
        |case, words, says| {
            let line = line(case, words);
            is_refused(&tess(&line), &line, says);
        },
    );
}

/// Checks that the output of `tess patch` in this form is the model's result.
fn is_model(form: &str, printed: &str, case: Case, backend: &str, said: &str) {
    let model = Listing::of_model(case);
    let expected = match form {
        "csv" => model.to_csv(backend),
        "obj" => model.to_obj(),
        "svg" => draw(&model, &DrawOptions::default()).to_svg(),
        "json" => {
            let printed: Value = serde_json::from_str(printed).expect("JSON");
            let of = |values: &Value, key: &str| -> Vec<Value> {
                let values = values.as_array().expect("an array");
                values.iter().map(|value| value[key].clone()).collect()
            };
            let points = &model.output.points;
            let coordinates = [("u_bits", 0), ("v_bits", 1)].map(|(key, axis)| {
                let bits = points.iter().map(|p| json!([p.u, p.v][axis].to_bits()));
                (key, bits.collect::<Vec<_>>())
            });
            for (key, bits) in coordinates {
                assert_eq!(of(&printed["points"], key), bits, "{key} of {said}");
            }
            let primitives: Vec<_> = model.primitives().collect();
            assert_eq!(printed["primitives"], json!(primitives), "{said}");
            assert_eq!(printed["backend"], backend, "{said}");
            return;
        }
        _ => model.to_file(backend),
    };
    assert_eq!(printed, expected, "{said}");
}

/// Verifies patches of each configuration: nothing differs.
#[test]
#[ignore = "slow: every configuration by each backend"]
fn backends_are_verified_whatever_the_options() {
    let folder = directory("crossed_runs");
    let path = |name: &str| folder.join(name).display().to_string();
    write(path("known.txt"), KNOWN).expect("written");
    let mut values = with_backends(&[
        &["", "--seed 7"],
        &["--shard 1/40", "--shard 40/40"],
        &["", "--known"],
        &["", "--report"],
    ]);
    // Without the option, the GPU would be verified as well.
    values[0][0] = "--backend simd --backend core";
    let crossed = Crossed { excluded: of_backends(&values[0]), values };
    let line = |words: &[&str]| {
        let words = words.join(" ").replace("--known", &format!("--known {}", path("known.txt")));
        let files = format!("--report {} --junit {}", path("report.jsonl"), path("report.xml"));
        format!("verify --random 1 {}", words.replace("--report", &files))
    };
    let taken = |_: Case, words: &[&str]| {
        let run = tess(&line(words));
        if is_left_out(&run, words) {
            return;
        }
        run.exits(0);
        let rows = run.stdout.lines().filter(|row| row.starts_with("random "));
        let rows: Vec<Vec<_>> = rows.map(|row| row.split_whitespace().collect()).collect();
        assert_eq!(rows.len(), words[0].matches("--backend").count(), "{}", run.stdout);
        // 96 patches in 40 shards.
        let is_equal = |row: &Vec<&str>| ["2", "3"].contains(&row[2]) && row[3] == "0";
        assert!(rows.iter().all(is_equal), "{words:?}: {}", run.stdout);
    };
    crossed.run(taken, |_, words, says| is_refused(&tess(&line(words)), &line(words), says));
}

/// A known deviation that does not occur here.
const KNOWN: &str = "case tri integer point center 40a00000 40a00000 40a00000 40a00000\n";

/// `tess bench` compares digests with the model's before it measures. For a GPU this takes seconds,
/// so it runs once.
#[test]
#[ignore = "slow: it measures each backend"]
fn backends_are_timed_whatever_the_options() {
    let others: [&[&str]; 4] =
        [&["", "--threads 2"], &["", "--frame 2"], &["", "--index-order cache"], &["", "--json"]];
    let mut values = with_backends(&others);
    values[0].retain(|backend| *backend != "--backend gpu");
    let of_simd = [(3, "--threads 2"), (4, "--frame 2"), (5, "--index-order cache")];
    let of_simd = of_simd.into_iter().flat_map(|(at, words)| {
        let name = words.split(' ').next().unwrap_or(words);
        ["", "--backend core"].map(|core| ((0, core), (at, words), [name, "--backend"]))
    });
    let excluded = of_backends(&values[0]).into_iter().chain(of_simd).collect();
    let crossed = Crossed { values, excluded };
    let line = |words: &[&str]| {
        let words = words.join(" ");
        format!("bench --workload uniform-4 --working-set cache --samples 1 {words}")
    };
    let taken = |words: &[&str]| {
        let run = tess(&line(words));
        if !is_left_out(&run, words) {
            run.exits(0).prints("uniform-4");
        }
    };
    let refused =
        |words: &[&str], says: [&str; 2]| is_refused(&tess(&line(words)), &line(words), says);
    crossed.run(|_, words| taken(words), |_, words, says| refused(words, says));
    taken(&["--backend gpu", "--no-copies --index-order cache --index-type u16 --json"]);
    refused(&["--backend gpu", "--threads 2"], ["--backend", "--threads"]);
    refused(&["--backend gpu", "--frame 2"], ["--backend", "--frame"]);
    refused(&["--backend gpu", "--cpu-level baseline"], ["--backend", "--cpu-level"]);
    for backend in ["", "--backend core", "--backend simd"] {
        refused(&[backend, "--no-copies"], ["--backend", "--no-copies"]);
    }
}

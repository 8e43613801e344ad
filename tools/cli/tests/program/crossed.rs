//! Options crossed by pairs: what is taken gives the model's result, and what is refused names both options.

use crate::support::{Run, directory, tess, tess_with_input};
use std::fs::write;
use std::path::Path;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_testkit::pairs::Options;
use tess_verify::case::Case;
use tess_verify::formats;
use tess_verify::vectors::Listing;

/// Two values that exclude each other, and what the message says of each.
type Excluded = ((usize, &'static str), (usize, &'static str), [&'static str; 2]);

/// Options by their values, which are words of a command line or none, behind the four that make the patch.
struct Crossed {
    values: Vec<Vec<&'static str>>,
    excluded: Vec<Excluded>,
}

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

    /// Calls `taken` with each row that is taken, and `refused` with each that is not and what its message says.
    fn run(
        &self,
        mut taken: impl FnMut(Case, &[&str]),
        mut refused: impl FnMut(Case, &[&str], [&str; 2]),
    ) {
        let counts: Vec<usize> =
            OF_PATCH.into_iter().chain(self.values.iter().map(Vec::len)).collect();
        let options = Options::new(&counts, |a, b| self.says([a, b]).is_some());
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
    let factors =
        PatchFactors::from_fn(Domain::ALL[row[0]], |i| [3.0, 4.5, 5.0, 6.25, 4.0, 7.0][i]);
    let (partitioning, output) = (Partitioning::ALL[row[1]], OutputPrimitive::ALL[row[2]]);
    Case { config: Config { partitioning, output, split: SplitOrder::ALL[row[3]] }, factors }
}

fn is_refused(run: &Run, words: &str, says: [&str; 2]) {
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{words}: {}", run.stderr);
    for says in says {
        assert!(run.stderr.contains(says), "{words}: {says} is not in {}", run.stderr);
    }
}

/// How a backend runs: by the number of the option `--backend`, whose value `""` is core.
fn of_backends(at: usize, cores: &[&'static str]) -> Vec<Excluded> {
    let excluded = |core: &&'static str| {
        [("--cpu-level", "--cpu-level baseline", 1), ("--index-type", "--index-type u16", 2)]
            .map(|(name, words, behind)| ((at, *core), (at + behind, words), [name, "--backend"]))
    };
    cores.iter().flat_map(excluded).collect()
}

const BACKENDS: [&[&str]; 3] = [
    &["", "--backend core", "--backend simd"],
    &["", "--cpu-level baseline"],
    &["", "--index-type u16", "--index-type u32"],
];

#[test]
fn patches_are_the_models_whatever_the_options() {
    let forms = ["", "--format text", "--format csv", "--format obj"];
    let crossed = Crossed {
        values: BACKENDS.iter().map(|values| values.to_vec()).chain([forms.to_vec()]).collect(),
        excluded: of_backends(0, &["", "--backend core"]),
    };
    let line = |case: Case, words: &[&str]| format!("{} {}", &case.command()[5..], words.join(" "));
    crossed.run(
        |case, words| {
            let run = tess(&line(case, words));
            let model = Listing::of_model(case);
            let backend = if words[0].ends_with("simd") { "simd" } else { "core" };
            let expected = match words[3] {
                "--format csv" => formats::csv(&model, backend),
                "--format obj" => formats::obj(&model),
                _ => formats::text(&model, backend),
            };
            assert_eq!((run.code, run.stdout), (Some(0), expected), "{case}: {words:?}");
        },
        |case, words, says| {
            let line = line(case, words);
            is_refused(&tess(&line), &line, says);
        },
    );
}

/// A file with the model's answer, or with a wrong one, as listing or as digests.
fn answer(case: Case, kind: &str, is_wrong: bool) -> String {
    let mut answer = Listing::of_model(case);
    if is_wrong {
        let last = answer.output.points.last_mut().expect("a point");
        *last = tess_core::DomainPoint::from_bits(last.u.to_bits() ^ 0x1234, last.v.to_bits());
    }
    if kind == "digests" {
        formats::csv(&answer, "a-device")
    } else {
        formats::text(&answer, "a-device")
    }
}

/// How the backend of a check runs is one option: all but the first exclude what is for the listings of devices.
const CHECKED_BY: [&str; 5] = [
    "",
    "--backend core",
    "--backend simd",
    "--backend simd --cpu-level baseline",
    "--backend simd --index-type u16 --cpu-level baseline",
];

fn of_checks() -> Crossed {
    let own: [&[&str]; 10] = [
        &["listing", "digests"],
        &["", "--order sequence", "--order any"],
        &["", "--points", "--primitives"],
        &["", "--conversion 0.6ulp"],
        &["", "--denormals flush"],
        &["", "--cases cases.txt"],
        &["", "--failures failures.txt"],
        &["", "--coverage coverage.xml --shard 2/3", "--shard 1/1"],
        &["", "--known known.txt"],
        &["", "--report report.jsonl", "--junit report.xml"],
    ];
    let strengths = [(2, "--order sequence"), (2, "--order any"), (3, "--points")];
    let strengths =
        strengths.into_iter().chain([(4, "--conversion 0.6ulp"), (5, "--denormals flush")]);
    let mut excluded = Vec::new();
    for (at, words) in strengths {
        let name = words.split(' ').next().unwrap_or(words);
        for backend in &CHECKED_BY[1..] {
            excluded.push(((0, *backend), (at, words), ["--backend", name]));
        }
        excluded.push(((1, "digests"), (at, words), ["its kind is patches", name]));
    }
    let values = [&CHECKED_BY[..]].iter().chain(&own).map(|values| values.to_vec()).collect();
    Crossed { values, excluded }
}

/// The command line of a check of standard input; its files are in the folder.
fn check(folder: &Path, words: &[&str]) -> String {
    let words = [&words[..1], &words[2..]].concat().join(" ");
    let path = |word: &str| match word.contains(".txt")
        || word.contains(".xml")
        || word.contains(".jsonl")
    {
        true => folder.join(word).display().to_string(),
        false => word.to_owned(),
    };
    format!("check - {}", words.split_whitespace().map(path).collect::<Vec<_>>().join(" "))
}

/// The model's answers are equal and a wrong one is different, whatever the options.
#[test]
fn answers_are_judged_whatever_the_options() {
    let folder = directory("crossed_checks");
    let known = "case tri integer point center 40a00000 40a00000 40a00000 40a00000\n";
    write(folder.join("known.txt"), known).expect("written");
    let mut runs = 0;
    of_checks().run(
        |case, words| {
            write(folder.join("cases.txt"), format!("{case}\n")).expect("written");
            let line = check(&folder, words);
            for (is_wrong, code) in [(false, 0), (true, 1)] {
                let run = tess_with_input(&line, &answer(case, words[1], is_wrong));
                let said = format!("{case}, {}: {line}: {}{}", words[1], run.stdout, run.stderr);
                assert_eq!(run.code, Some(code), "{said}");
                assert!(run.stdout.contains(&format!("1 cases, {code} mismatches")), "{said}");
                runs += 1;
            }
        },
        |case, words, says| {
            write(folder.join("cases.txt"), format!("{case}\n")).expect("written");
            let line = check(&folder, words);
            is_refused(&tess_with_input(&line, &answer(case, words[1], false)), &line, says);
        },
    );
    assert!(runs > 30, "{runs} runs");
}

/// One patch of each configuration, verified and timed: nothing differs.
#[test]
fn backends_are_verified_and_timed_whatever_the_options() {
    let folder = directory("crossed_runs");
    let report = |name: &str| folder.join(name).display().to_string();
    let known = folder.join("known.txt");
    write(&known, "case tri integer point center 40a00000 40a00000 40a00000 40a00000\n")
        .expect("written");
    let of_verify: [&[&str]; 4] = [
        &["", "--seed 7"],
        &["--shard 1/40", "--shard 40/40"],
        &["", "--known"],
        &["", "--report", "--junit"],
    ];
    let mut values: Vec<_> =
        BACKENDS.iter().chain(&of_verify).map(|values| values.to_vec()).collect();
    // Without the option the GPU is verified too.
    values[0][0] = "--backend simd --backend core";
    let crossed = Crossed { values, excluded: of_backends(0, &["--backend core"]) };
    let line = |words: &[&str]| {
        let words = words.join(" ").replace("--known", &format!("--known {}", known.display()));
        let words = words.replace("--report", &format!("--report {}", report("report.jsonl")));
        format!(
            "verify --random 1 {}",
            words.replace("--junit", &format!("--junit {}", report("report.xml")))
        )
    };
    let taken = |_: Case, words: &[&str]| {
        let run = tess(&line(words));
        assert_eq!(run.code, Some(0), "{words:?}: {}{}", run.stdout, run.stderr);
        let row = run.stdout.lines().nth(1).unwrap_or_default().split_whitespace().last();
        assert_eq!(row, Some("0"), "{words:?}: {}", run.stdout);
    };
    crossed.run(taken, |_, words, says| is_refused(&tess(&line(words)), &line(words), says));

    let of_bench: [&[&str]; 4] =
        [&["", "--threads 2"], &["", "--frame 2"], &["", "--order cache"], &["", "--json"]];
    let values = BACKENDS.iter().chain(&of_bench).map(|values| values.to_vec()).collect();
    let cores = ["", "--backend core"];
    let order = |core| ((0, core), (5, "--order cache"), ["--order", "--backend"]);
    let frame = |core| ((0, core), (4, "--frame 2"), ["--frame", "--backend"]);
    let threads = |core| ((0, core), (3, "--threads 2"), ["--threads", "backend core"]);
    let of_simd = [cores.map(order), cores.map(frame), cores.map(threads)].concat();
    let excluded = of_backends(0, &cores).into_iter().chain(of_simd).collect();
    let crossed = Crossed { values, excluded };
    let line = |words: &[&str]| {
        let words = words.join(" ");
        format!("bench --workload uniform-4 --working-set cache --samples 1 {words}")
    };
    let taken = |_: Case, words: &[&str]| {
        // A bench compares digests with the model's before it times.
        let run = tess(&line(words));
        assert_eq!(run.code, Some(0), "{words:?}: {}{}", run.stdout, run.stderr);
        assert!(run.stdout.contains("uniform-4"), "{words:?}: {}", run.stdout);
    };
    crossed.run(taken, |_, words, says| is_refused(&tess(&line(words)), &line(words), says));
}

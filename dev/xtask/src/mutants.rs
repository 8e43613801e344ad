//! Planted faults: `cargo mutants` makes one change at a time, and a test must fail.

mod fault;
mod planted;

use crate::command::{cargo, in_file, read, shown, workspace};
use std::fs;

/// A crate, and the tests that must detect its faults, the fastest pass first. Each pass tries the
/// faults that the one before it missed.
struct Subject {
    package: &'static str,
    passes: &'static [Pass],
}

/// Tests, and the files whose faults they can detect; an empty list stands for all files.
struct Pass {
    tests: &'static str,
    files: &'static [&'static str],
}

const SUBJECTS: &[Subject] = &[
    Subject {
        package: "tess-core",
        passes: &[
            Pass { tests: "-C=--lib -C=--test=golden", files: &[] },
            Pass {
                tests: "-C=--lib -C=--test=output -C=--test=factors -C=--test=stitches -C=--test=cache_order \
                        -C=--test=random_access",
                files: &[],
            },
        ],
    },
    Subject { package: "tess-level", passes: &[Pass { tests: "-C=--test=levels", files: &[] }] },
    Subject {
        package: "tess-simd",
        passes: &[
            // Without `std` the kernels are compiled for only one CPU level.
            Pass {
                tests: "-C=--no-default-features -C=--features=taps,apart -C=--test=baseline -C=--test=kernels",
                files: &[],
            },
            Pass {
                tests: "-C=--features=rayon -C=--test=inside -C=--test=batches",
                files: &[
                    "interface/tessellator",
                    "threads/part",
                    "threads/pool",
                    "threads/sizes",
                    "threads/slices",
                ],
            },
        ],
    },
    Subject {
        package: "tess-gpu",
        passes: &[
            Pass {
                tests: "-C=--all-features -C=--lib -C=--test=plan -C=--test=shaders",
                files: &[],
            },
            // The host side of the shaders, on a device.
            Pass {
                tests: "--test-package=tess-wgpu -C=--all-features -C=--test=batches",
                files: &[],
            },
        ],
    },
    Subject {
        package: "tess-wgpu",
        passes: &[
            Pass { tests: "-C=--all-features -C=--lib -C=--test=batches", files: &[] },
            Pass { tests: "-C=--all-features -C=--test=stage", files: &[] },
        ],
    },
    Subject {
        package: "tess-surface",
        passes: &[Pass { tests: "-C=--all-features -C=--lib -C=--test=surfaces", files: &[] }],
    },
    Subject {
        package: "tess-mesh",
        passes: &[Pass { tests: "-C=--lib -C=--test=readers -C=--test=files", files: &[] }],
    },
    Subject {
        package: "tess-verify",
        passes: &[
            Pass {
                tests: "-C=--all-features -C=--lib -C=--test=strength -C=--test=device -C=--test=captures",
                files: &[],
            },
            Pass { tests: "-C=--all-features -C=--test=levels -C=--test=verify", files: &[] },
        ],
    },
    Subject {
        package: "tess-show",
        passes: &[Pass { tests: "-C=--all-features -C=--lib -C=--test=origin", files: &[] }],
    },
];

/// The list of survivors that change nothing: `TIMES`, the fault and the reason, separated by tabs.
const EQUIVALENT: &str = "dev/faults/survivors.tsv";

/// Plants the faults of `dev/faults`; see [`planted::run`].
pub(crate) fn planted(words: &[&str]) -> Result<(), String> {
    planted::run(words)
}

/// Plants every fault in `package`. `rest` has options for `cargo mutants`, such as a file or a
/// shard. With `--iterate`, faults that an earlier run detected are left out.
///
/// # Errors
/// A survivor is not in [`EQUIVALENT`], or tests fail without a fault.
pub(crate) fn run(package: &str, rest: &[&str]) -> Result<(), String> {
    let subject = SUBJECTS.iter().find(|subject| subject.package == package);
    let subject = subject.ok_or_else(|| format!("no faults are planted in `{package}`"))?;
    let output = workspace().join("target/mutants").join(package);
    fs::create_dir_all(&output).map_err(|error| in_file(&output, &error))?;
    let mut missed = Missed::default();
    for (number, pass) in subject.passes.iter().enumerate() {
        let mut mutants = cargo(&format!("mutants --package {package} {} --output", pass.tests));
        mutants.arg(&output).args(rest);
        for file in pass.files {
            mutants.arg(format!("--file={package}/src/{file}.rs"));
        }
        if number > 0 && !rest.contains(&"--iterate") {
            mutants.arg("--iterate");
        }
        println!("\n$ {}", shown(&mutants));
        let status = mutants.status().map_err(|error| error.to_string())?;
        // 2: some were missed, which the list judges; 3: some never ended, which counts as
        // detected.
        if !matches!(status.code(), Some(0 | 2 | 3)) {
            return Err(format!("`{}` ended with {status}", shown(&mutants)));
        }
        let list = |name: &str| read(&output.join("mutants.out").join(name));
        missed.add(&list("missed.txt")?, &(list("caught.txt")? + &list("timeout.txt")?));
    }
    let listed = listed(&read(&workspace().join(EQUIVALENT))?)?;
    let unlisted = unlisted(&missed.0, listed);
    if unlisted.is_empty() {
        println!("\n{} survivors, all listed in {EQUIVALENT}", missed.0.len());
        return Ok(());
    }
    Err(format!("survivors that {EQUIVALENT} does not list:\n{}", unlisted.join("\n")))
}

/// The faults that no pass detected.
#[derive(Default)]
struct Missed(Vec<String>);

impl Missed {
    /// Adds another pass: the faults that it missed and those that it detected, one per line.
    fn add(&mut self, missed: &str, seen: &str) {
        self.0.retain(|fault| seen.lines().all(|line| line != fault));
        let new: Vec<_> =
            missed.lines().filter(|line| !self.0.iter().any(|old| old == line)).collect();
        self.0.extend(new.into_iter().map(str::to_owned));
    }
}

/// The missed faults that are not in the list, regardless of their lines. Each entry of the list
/// excuses one fault.
fn unlisted(missed: &[String], mut listed: Vec<String>) -> Vec<&str> {
    let is_unlisted = |line: &&str| match listed.iter().position(|name| *name == name_of(line)) {
        Some(at) => {
            listed.swap_remove(at);
            false
        }
        None => true,
    };
    missed.iter().map(String::as_str).filter(is_unlisted).collect()
}

/// The faults of a list, each repeated as often as the list states.
///
/// # Errors
/// A line has another form.
fn listed(list: &str) -> Result<Vec<String>, String> {
    let mut faults = Vec::new();
    for line in list.lines().filter(|line| !line.starts_with('#')) {
        let parts: Vec<&str> = line.split('\t').collect();
        let (times, fault) = match parts[..] {
            [times, fault, reason] if !reason.is_empty() => (times.parse::<usize>().ok(), fault),
            _ => (None, line),
        };
        let times = times.ok_or(format!("{EQUIVALENT}: `{line}` is not TIMES, fault, reason"))?;
        faults.extend(std::iter::repeat_n(fault.to_owned(), times));
    }
    Ok(faults)
}

/// `FILE:LINE:COLUMN: WHAT` without line and column, which change too often.
fn name_of(line: &str) -> String {
    let mut parts = line.splitn(4, ':');
    let file = parts.next().unwrap_or_default();
    format!("{file}:{}", parts.nth(2).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_name_files_and_tests_that_exist() {
        for Subject { package, passes } in SUBJECTS {
            for pass in *passes {
                let other =
                    pass.tests.split(' ').find_map(|word| word.strip_prefix("--test-package="));
                let tested = other.unwrap_or(package);
                let has = |path: &str| workspace().join(tested).join(path).exists();
                let files = pass.files.iter().map(|file| format!("src/{file}.rs"));
                let tests = pass
                    .tests
                    .split_whitespace()
                    .filter_map(|word| Some(format!("tests/{}", word.strip_prefix("-C=--test=")?)));
                for path in files.chain(tests) {
                    assert!(has(&path) || has(&format!("{path}.rs")), "{tested} has no {path}");
                }
            }
        }
    }

    #[test]
    fn each_listed_fault_excuses_one_survivor() {
        let list = "# Survivors\n1\ta.rs: replace * with + in f\tthe factor is 2\n\
                    2\ta.rs: replace | with ^ in f\tno bit is shared\n";
        let list = listed(list).expect("a list");
        let faults =
            |faults: &[&str]| faults.iter().map(|&fault| fault.to_owned()).collect::<Vec<_>>();
        let [times, twice] = ["a.rs:3:9: replace * with + in f", "a.rs:8:9: replace * with + in f"];
        let or = "a.rs:3:9: replace | with ^ in f";
        assert!(unlisted(&faults(&[times, or, or]), list.clone()).is_empty(), "they are listed");
        assert_eq!(unlisted(&faults(&[times, twice]), list.clone()), [twice], "listed once");
        let other = faults(&["a.rs:3:9: replace * with / in f", "b.rs:3:9: replace * with + in f"]);
        assert_eq!(unlisted(&other, list).len(), 2, "another fault, another file");
        assert!(listed("a.rs: replace * with + in f\twhy").is_err(), "no number");
    }

    #[test]
    fn listed_faults_are_of_files_that_exist() {
        let list = read(&workspace().join(EQUIVALENT)).expect("the list");
        for fault in listed(&list).expect("a list") {
            let file = fault.split(':').next().expect("a file");
            assert!(workspace().join(file).is_file(), "{fault}: the file has moved");
        }
    }

    #[test]
    fn a_fault_is_missed_if_no_pass_sees_it() {
        let mut missed = Missed::default();
        missed.add("a.rs: one\na.rs: two\nb.rs: three\n", "a.rs: four\n");
        missed.add("a.rs: two\n", "a.rs: one\n");
        assert_eq!(missed.0, ["a.rs: two", "b.rs: three"], "b.rs is no file of the second pass");
    }
}

//! Planted faults: `cargo mutants` changes one thing at a time and demands that a test fails.

use crate::command::{cargo, shown, workspace};
use std::fs;
use std::path::Path;

/// A crate and the tests that must see its faults, the fastest pass first. Each pass tries what the
/// one before it missed.
struct Subject {
    package: &'static str,
    passes: &'static [&'static str],
}

const SUBJECTS: &[Subject] = &[
    Subject {
        package: "tess-core",
        passes: &["-C=--lib -C=--test=golden", "-C=--lib -C=--test=output"],
    },
    Subject {
        package: "tess-simd",
        // Without `std` the kernels are compiled for one CPU level alone.
        passes: &[
            "-C=--no-default-features -C=--lib -C=--test=baseline",
            "-C=--features=rayon -C=--lib -C=--test=buffers -C=--test=exact",
        ],
    },
];

/// Where the survivors that change nothing are listed, each with its reason.
const EQUIVALENT: &str = "docs/mutants.md";

/// Plants every fault in `package`; `rest` are options for `cargo mutants`, such as a file or a
/// shard. With `--iterate` among them, faults that an earlier run caught are left out.
///
/// # Errors
/// A survivor that `docs/mutants.md` does not list, or tests that fail without a fault.
pub(crate) fn run(package: &str, rest: &[&str]) -> Result<(), String> {
    let subject = SUBJECTS.iter().find(|subject| subject.package == package);
    let subject = subject.ok_or_else(|| format!("no faults are planted in `{package}`"))?;
    let output = workspace().join("target/mutants").join(package);
    fs::create_dir_all(&output).map_err(|error| format!("{}: {error}", output.display()))?;
    for (pass, tests) in subject.passes.iter().enumerate() {
        let mut mutants = cargo(&format!("mutants --package {package} {tests} --output"));
        mutants.arg(&output).args(rest);
        if pass > 0 && !rest.contains(&"--iterate") {
            mutants.arg("--iterate");
        }
        println!("\n$ {}", shown(&mutants));
        let status = mutants.status().map_err(|error| error.to_string())?;
        // 2: some were missed, which the list decides on; 3: some never ended, which is noticed.
        if !matches!(status.code(), Some(0 | 2 | 3)) {
            return Err(format!("`{}` ended with {status}", shown(&mutants)));
        }
    }
    let missed = read(&output.join("mutants.out/missed.txt"))?;
    let unlisted = unlisted(&missed, &read(&workspace().join(EQUIVALENT))?);
    if unlisted.is_empty() {
        println!("\n{} survivors, all listed in {EQUIVALENT}", missed.lines().count());
        return Ok(());
    }
    Err(format!("survivors that {EQUIVALENT} does not list:\n{}", unlisted.join("\n")))
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The missed faults that `list` has too few times, whichever lines they are on.
fn unlisted<'a>(missed: &'a str, list: &str) -> Vec<&'a str> {
    let mut left: Vec<String> = list.lines().filter_map(listed).collect();
    let is_unlisted = |line: &&str| match left.iter().position(|name| *name == name_of(line)) {
        Some(at) => {
            left.swap_remove(at);
            false
        }
        None => true,
    };
    missed.lines().filter(is_unlisted).collect()
}

/// The fault of a row of the list: what its first column has in backquotes.
fn listed(row: &str) -> Option<String> {
    let name = row.strip_prefix("| `")?.split('`').next()?;
    Some(name.replace("\\|", "|"))
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
    fn each_listed_fault_excuses_one_survivor() {
        let list = "# Survivors\n\n| fault | reason |\n| --- | --- |\n\
                    | `a.rs: replace * with + in f` | the factor is 2 |\n\
                    | `a.rs: replace \\| with ^ in f` | no bit is shared |\n";
        let one = "a.rs:3:9: replace * with + in f\na.rs:3:9: replace | with ^ in f\n";
        assert!(unlisted(one, list).is_empty(), "it is listed");
        let two = "a.rs:3:9: replace * with + in f\na.rs:8:9: replace * with + in f\n";
        assert_eq!(unlisted(two, list), ["a.rs:8:9: replace * with + in f"], "listed once");
        let other = "a.rs:3:9: replace * with / in f\nb.rs:3:9: replace * with + in f\n";
        assert_eq!(unlisted(other, list).len(), 2, "another fault, another file");
    }
}

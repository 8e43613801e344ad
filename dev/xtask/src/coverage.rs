//! Line coverage of the tests, crate by crate.

use crate::command::{self, cargo, workspace};
use std::collections::BTreeMap;
use std::fs;

/// The parts of the workspace that the table has a row for.
const CRATES: &[&str] = &[
    "tess-core/",
    "tess-simd/",
    "tess-gpu/",
    "tess-surface/",
    "tess-wgpu/",
    "tess-verify/",
    "bindings/c/",
    "tools/cli/",
    "tools/explorer/",
    "dev/testkit/",
];

/// Runs the tests of the workspace with counters in every line and prints how many lines they reach.
/// Needs cargo-llvm-cov and the compiler's llvm-tools.
///
/// # Errors
/// A tool that is missing, or a test that fails.
pub(crate) fn run() -> Result<(), String> {
    let report = workspace().join("target/coverage.lcov");
    let mut tests = cargo("llvm-cov --no-report --workspace --all-features --exclude xtask");
    command::run(&mut tests).map_err(|error| {
        format!("{error}. Needed: cargo install cargo-llvm-cov; rustup component add llvm-tools")
    })?;
    fs::create_dir_all(workspace().join("target")).map_err(|error| error.to_string())?;
    command::run(cargo("llvm-cov report --lcov --output-path").arg(&report))?;
    let text = fs::read_to_string(&report).map_err(|error| error.to_string())?;
    println!("\n{:<14} {:>7} {:>7}", "crate", "lines", "reached");
    for (name, lines) in tally(&text) {
        let Lines { all, reached } = lines;
        let percent = 100 * reached / all.max(1);
        println!("{name:<14} {all:>7} {reached:>7} {percent:>4} %");
    }
    println!("every line with its count: {}", report.display());
    Ok(())
}

/// Lines that have code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Lines {
    all: u64,
    reached: u64,
}

/// Adds up the sources of each crate; tests and examples do not count.
fn tally(lcov: &str) -> BTreeMap<&'static str, Lines> {
    let mut crates = BTreeMap::<_, Lines>::new();
    let mut current = None;
    for line in lcov.lines() {
        if let Some(file) = line.strip_prefix("SF:") {
            current = CRATES.iter().find(|name| file.contains(&format!("/{name}src/")));
        }
        let Some(name) = current else { continue };
        let lines = crates.entry(name.trim_end_matches('/')).or_default();
        let number = |text: &str| text.parse::<u64>().unwrap_or(0);
        if let Some(count) = line.strip_prefix("LF:") {
            lines.all += number(count);
        } else if let Some(count) = line.strip_prefix("LH:") {
            lines.reached += number(count);
        }
    }
    crates
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_added_up_by_crate() {
        let lcov = "SF:/home/me/tess/tess-core/src/model/place.rs\nDA:3,1\nLF:10\nLH:9\nend_of_record\n\
                    SF:/home/me/tess/tess-core/src/model/row.rs\nLF:5\nLH:5\nend_of_record\n\
                    SF:/home/me/tess/tess-core/tests/output.rs\nLF:50\nLH:1\nend_of_record\n\
                    SF:/home/me/tess/tools/cli/src/output.rs\nLF:4\nLH:1\nend_of_record\n";
        let crates = tally(lcov);
        assert_eq!(crates["tess-core"], Lines { all: 15, reached: 14 }, "without its tests");
        assert_eq!(crates["tools/cli"], Lines { all: 4, reached: 1 }, "a folder deeper");
    }
}

//! Runs every test and says how many there were.

use crate::command::{cargo, shown};
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// What test runners said they did.
#[derive(Default)]
struct Tally {
    passed: u64,
    failed: u64,
    ignored: u64,
}

impl Tally {
    /// Adds a line such as `test result: ok. 3 passed; 0 failed; 1 ignored; ...`.
    fn add_line(&mut self, line: &str) {
        let Some(result) = line.trim_start().strip_prefix("test result: ") else { return };
        let counts = result.split_once(". ").map_or("", |(_, counts)| counts);
        for count in counts.split("; ") {
            let Some((number, what)) = count.split_once(' ') else { continue };
            let number = number.parse::<u64>().unwrap_or(0);
            match what {
                "passed" => self.passed += number,
                "failed" => self.failed += number,
                "ignored" => self.ignored += number,
                _ => {}
            }
        }
    }
}

/// Runs the whole suite; the last line printed is the tally.
pub(crate) fn run() -> Result<(), String> {
    let mut tally = Tally::default();
    let mut broken = Vec::new();
    for mut command in suites() {
        let succeeded = run_counting(&mut command, &mut tally)?;
        if !succeeded {
            broken.push(shown(&command));
        }
    }
    println!("\n{} passed, {} failed, {} skipped", tally.passed, tally.failed, tally.ignored);
    if !broken.is_empty() {
        return Err(format!("these failed: {}", broken.join("; ")));
    }
    if tally.passed == 0 {
        return Err("no test ran".into());
    }
    Ok(())
}

/// The commands that together run every test.
fn suites() -> Vec<Command> {
    vec![cargo("test --workspace --all-features --no-fail-fast")]
}

/// Runs a command, passing its output on; says whether it succeeded.
fn run_counting(command: &mut Command, tally: &mut Tally) -> Result<bool, String> {
    println!("\n$ {}", shown(command));
    let cannot = |error| format!("cannot run `cargo test`: {error}");
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(cannot)?;
    let output = child.stdout.take().ok_or("no output to read")?;
    for line in BufReader::new(output).lines() {
        let line = line.map_err(cannot)?;
        println!("{line}");
        tally.add_line(&line);
    }
    Ok(child.wait().map_err(cannot)?.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tallies_result_lines_alone() {
        let mut tally = Tally::default();
        tally.add_line("test result: FAILED. 3 passed; 2 failed; 1 ignored; 0 measured; 9 filtered out; finished in 0.10s");
        tally
            .add_line("test result: ok. 4 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out");
        tally.add_line("test 7 passed; 7 failed");
        assert_eq!((tally.passed, tally.failed, tally.ignored), (7, 2, 1), "sums");
    }
}

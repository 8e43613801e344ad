//! Runs test commands and counts what they ran.

use crate::command::shown;
use std::fmt;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// Numbers of tests, added up from the lines that test runners print.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
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

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} passed, {} failed, {} skipped", self.passed, self.failed, self.ignored)
    }
}

/// Runs every command, even after one failed, and prints their output and the tally.
///
/// # Errors
/// A command that fails, or that passes without having run a test: a filter which matches nothing
/// must not count as success.
pub(crate) fn run(commands: impl IntoIterator<Item = Command>) -> Result<(), String> {
    let mut all = Tally::default();
    let mut broken = Vec::new();
    for mut command in commands {
        let passed_before = all.passed;
        let succeeded = run_one(&mut command, &mut all)?;
        if !succeeded {
            broken.push(shown(&command));
        } else if all.passed == passed_before {
            broken.push(format!("{} (no test ran)", shown(&command)));
        }
    }
    println!("\n{all}");
    if broken.is_empty() { Ok(()) } else { Err(format!("these failed: {}", broken.join("; "))) }
}

/// Runs a command and passes its output on; whether it succeeded.
fn run_one(command: &mut Command, tally: &mut Tally) -> Result<bool, String> {
    println!("\n$ {}", shown(command));
    let name = shown(command);
    let cannot = |error| format!("cannot run `{name}`: {error}");
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
        assert_eq!(tally, Tally { passed: 7, failed: 2, ignored: 1 }, "sums");
    }

    #[test]
    fn a_command_without_tests_is_a_failure() {
        let says = |text: &str| {
            let mut echo = Command::new("echo");
            echo.arg(text);
            run([echo])
        };
        assert_eq!(says("test result: ok. 1 passed; 0 failed"), Ok(()), "one test");
        let none =
            says("test result: ok. 0 passed; 0 failed; 0 ignored; 0 measured; 9 filtered out");
        assert!(none.is_err_and(|message| message.contains("no test ran")), "none");
    }
}

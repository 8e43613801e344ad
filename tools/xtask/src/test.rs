//! Runs every test and says how many there were.

use crate::command::cargo;
use crate::{explorer, levels, python, tally};

/// What is done where no browser can be had.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Browser {
    /// The tests of the explorer fail.
    Demanded,
    /// They are left out, and the output says so.
    IfThere,
}

/// Runs the whole suite, on every CPU level that this machine should have; the last line printed
/// is the tally.
pub(crate) fn run(browser: Browser) -> Result<(), String> {
    let mut tests = cargo("test --workspace --all-features --no-fail-fast");
    // A test whose tool is missing then fails; elsewhere it is reported as ignored.
    tests.env("CI", "1");
    tests.env(levels::VARIABLE, levels::required().join(","));
    let mut commands = vec![tests, python::tests()?];
    match explorer::lacking() {
        None => commands.push(explorer::tests()?),
        Some(lacking) if browser == Browser::Demanded => return Err(lacking),
        Some(lacking) => {
            println!("\nNOT RUN: the tests of the explorer in a browser. {lacking}");
        }
    }
    tally::run(commands)
}

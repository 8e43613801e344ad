//! Runs every test and says how many there were.

use crate::command::cargo;
use crate::{levels, python, tally};

/// Runs the whole suite, on every CPU level that this machine should have; the last line printed
/// is the tally.
pub(crate) fn run() -> Result<(), String> {
    let mut tests = cargo("test --workspace --all-features --no-fail-fast");
    // A test whose tool is missing then fails; elsewhere it is reported as ignored.
    tests.env("CI", "1");
    tests.env(levels::VARIABLE, levels::required().join(","));
    tally::run([tests, python::tests()?])
}

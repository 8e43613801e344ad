//! Runs every test and says how many there were.

use crate::command::{self, cargo};
use crate::{explorer, levels, python, tally};
use std::process::Command;

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
    // Compiled once, so that nothing else of the suite builds the program with other features.
    command::run(cargo(SUITE).arg("--no-run"))?;
    let program = command::built_program();
    let mut commands = vec![workspace(), python::tests(&program)?];
    match explorer::lacking() {
        None => commands.push(explorer::tests(&program)?),
        Some(lacking) if browser == Browser::Demanded => return Err(lacking),
        Some(lacking) => {
            println!("\nNOT RUN: the tests of the explorer in a browser. {lacking}");
        }
    }
    tally::run(commands)
}

/// The arguments of `cargo` for the tests of the workspace.
const SUITE: &str = "test --workspace --all-features --no-fail-fast";

/// The tests of the workspace.
fn workspace() -> Command {
    let mut tests = cargo(SUITE);
    // A test whose tool is missing then fails; elsewhere it is reported as ignored.
    tests.env("CI", "1");
    // The C interface's libraries are those of this build.
    tests.env("TESS_CAPI_BUILD", SUITE);
    tests.env(levels::VARIABLE, levels::required().join(","));
    // Without it drivers complain on the standard error, once for each device that is opened.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        tests.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    }
    tests
}

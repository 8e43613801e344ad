//! The library behind the program `tess`: [`main`] is all of it that others can call.
//!
//! `commands` has a folder for each command. What they share lies beside it: `args` (a patch on the
//! command line), `backends` (who tessellates it), `formats`, `drawing`, `picture` and `explanation`
//! (what it is shown as), `output` (where results go) and `failure` (how a command ends).

mod args;
mod backends;
mod commands;
mod drawing;
mod explanation;
mod failure;
mod formats;
mod output;
mod picture;

#[cfg(feature = "fuzzing")]
#[doc(hidden)]
pub use commands::fuzzing;

use clap::Parser;
use commands::Command;
use std::io::Write;
use std::process::ExitCode;

/// A bit-exact model of the Direct3D 11 class fixed-function tessellator.
///
/// Results go to stdout, progress and messages to stderr. Exit codes: 0 done or equal,
/// 1 different, 2 bad usage or malformed, short or empty input, 3 backend not available here.
#[derive(Debug, Parser)]
#[command(name = "tess", version, after_help = EXAMPLES)]
struct Program {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  tess patch tri --outer 3,4,5 --inner 4        one patch as a listing
  tess draw tri --outer 17,5,9 --inner 3 -o fan.png
  tess check golden/patches.csv                 4000 recorded patches, compared
  tess bench --workload uniform-16              how fast on this machine";

/// Runs the program on the process's arguments and says how it ended.
#[must_use]
pub fn main() -> ExitCode {
    let command = Program::parse().command;
    match commands::run(&command) {
        Ok(exit) => exit.into(),
        Err(failure) => {
            // Nothing can be done if stderr is closed; the exit code still tells.
            _ = writeln!(std::io::stderr(), "tess: {failure}");
            failure.exit.into()
        }
    }
}

//! Builds every fuzz target and runs each for a while.

use crate::command::{self, workspace};
use crate::setup;
use std::process::Command;

/// Seconds for each target where nobody says how many.
pub(crate) const BRIEFLY: &str = "10";

/// Builds every target under the address sanitizer, the one of the GPU too, and runs each for this
/// many seconds. Without a nightly compiler, which sanitizers need, this fails.
pub(crate) fn run(seconds: &str) -> Result<(), String> {
    run_with(&["--gpu", seconds])
}

/// A few seconds of every target but the one of the GPU, whose build alone takes minutes.
pub(crate) fn run_in_ci() -> Result<(), String> {
    run_with(&["3"])
}

fn run_with(arguments: &[&str]) -> Result<(), String> {
    setup::toolchain("nightly", &[])?;
    setup::subcommand("fuzz")?;
    let mut run = Command::new("sh");
    command::run(run.arg("fuzz/run").args(arguments).current_dir(workspace()))
}

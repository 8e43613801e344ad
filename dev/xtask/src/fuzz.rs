//! Builds every fuzz target, and runs each for a while.

use crate::command::{self, workspace};
use crate::setup;
use std::process::Command;

/// Builds every target with the address sanitizer, and runs each for this many seconds. The GPU's
/// target, whose build takes minutes, is included only with `--gpu`. Sanitizers need a nightly
/// compiler; without one this fails.
pub(crate) fn run(arguments: &[&str]) -> Result<(), String> {
    setup::toolchain("nightly", &[])?;
    setup::subcommand("fuzz")?;
    let mut run = Command::new("sh");
    command::run(run.arg("fuzz/run").args(arguments).current_dir(workspace()))
}

//! Builds every fuzz target and runs each for a while.

use crate::command::{self, workspace};
use crate::setup;
use std::process::Command;

/// Builds every target under the address sanitizer and runs each for this many seconds; that of the
/// GPU, whose build alone takes minutes, too with `--gpu`. Without a nightly compiler, which
/// sanitizers need, this fails.
pub(crate) fn run(arguments: &[&str]) -> Result<(), String> {
    setup::toolchain("nightly", &[])?;
    setup::subcommand("fuzz")?;
    let mut run = Command::new("sh");
    command::run(run.arg("fuzz/run").args(arguments).current_dir(workspace()))
}

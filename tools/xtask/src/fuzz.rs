//! Builds every fuzz target and runs each for a while.

use crate::command::{self, cargo, workspace};
use std::process::{Command, Stdio};

/// Seconds for each target where nobody says how many.
pub(crate) const BRIEFLY: &str = "10";

/// Builds every target under the address sanitizer, the one of the GPU too, and runs each for this
/// many seconds. Without a nightly compiler, which sanitizers need, this fails.
pub(crate) fn run(seconds: &str) -> Result<(), String> {
    set_up()?;
    let mut run = Command::new("sh");
    command::run(run.args(["fuzz/run", "--gpu", seconds]).current_dir(workspace()))
}

/// Installs the nightly compiler and cargo-fuzz where they are missing.
fn set_up() -> Result<(), String> {
    if !succeeds(Command::new("rustup").args(["run", "nightly", "cargo", "--version"])) {
        let mut install = Command::new("rustup");
        install.args(["toolchain", "install", "nightly", "--profile", "minimal"]);
        command::run(&mut install)
            .map_err(|error| format!("fuzz targets need a nightly compiler: {error}"))?;
    }
    if !succeeds(&mut cargo("fuzz --version")) {
        command::run(&mut cargo("install cargo-fuzz --locked"))?;
    }
    Ok(())
}

fn succeeds(command: &mut Command) -> bool {
    command
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

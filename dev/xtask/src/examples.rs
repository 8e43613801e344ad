//! The examples of `tess-wgpu`, a separate workspace with a window system.

use crate::command::{self, workspace};
use std::process::Command;

/// Runs an example; the words are options of `cargo run`, its name, and its own options.
///
/// # Errors
/// It does not compile, or it fails.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    // Paths are relative to the caller's folder.
    command::run(cargo("run")?.args(words).current_dir("."))
}

/// Checks formatting and lints.
///
/// # Errors
/// A check fails.
pub(crate) fn lint() -> Result<(), String> {
    command::run(&mut cargo("fmt --check")?)?;
    command::run(cargo("clippy --all-targets")?.args(["--", "-D", "warnings"]))
}

/// `cargo` with these words in the examples' workspace, which has a target folder of its own and
/// the versions of the main workspace.
///
/// # Errors
/// The versions cannot be copied.
pub(crate) fn cargo(words: &str) -> Result<Command, String> {
    const FOLDER: &str = "tess-wgpu/examples";
    command::lock_versions(&workspace(), FOLDER)?;
    let mut command = command::cargo(words);
    command.arg("--manifest-path").arg(workspace().join(FOLDER).join("Cargo.toml"));
    command.env("CARGO_TARGET_DIR", command::target());
    Ok(command)
}

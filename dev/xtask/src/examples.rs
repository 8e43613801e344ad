//! The examples of `tess-wgpu`, a workspace of its own, which has a window system.

use crate::command::{self, workspace};
use std::process::Command;

/// Runs an example: options of `cargo run`, its name, its own options.
///
/// # Errors
/// It does not compile, or fails.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    // Paths are those of whoever calls.
    command::run(cargo("run")?.args(words).current_dir("."))
}

/// Formatting and lints.
///
/// # Errors
/// One is not kept.
pub(crate) fn lint() -> Result<(), String> {
    command::run(&mut cargo("fmt --check")?)?;
    command::run(cargo("clippy --all-targets")?.args(["--", "-D", "warnings"]))
}

/// `cargo` with these words on their workspace, beside the builds of the others and with their
/// versions.
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

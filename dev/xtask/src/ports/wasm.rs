//! WebAssembly: the libraries compile for a browser, and the tests run in Node.js.

use super::Extent;
use super::cross;
use crate::command::{self, cargo, workspace};
use crate::setup::{self, Need, has_program};
use crate::tally;

const BROWSER: &str = "wasm32-unknown-unknown";
/// A target with files and a standard output, which tests need.
const WASI: &str = "wasm32-wasip1";

/// All tests that need neither threads nor other programs.
const WHOLE: &[&str] =
    &["test --package tess-core", "test --package tess-simd --no-default-features --features std"];

const NODE: Need = Need {
    what: "Node.js, version 20 or later (runs tests in WebAssembly)",
    packages: &["nodejs"],
    is_there: || has_program("node"),
};

/// Checks that everything usable in a browser compiles, then runs the tests of the model and of the
/// CPU backend.
pub(super) fn check(extent: Extent) -> Result<(), String> {
    setup::provide(&[NODE])?;
    setup::target(BROWSER)?;
    setup::target(WASI)?;
    let libraries = ["tess-core", "tess-level", "tess-simd", "tess-gpu", "tess-surface"];
    let libraries = libraries.into_iter().flat_map(|package| ["--package", package]);
    command::run(cargo("check --target").arg(BROWSER).args(libraries))?;
    let script = workspace().join("dev/xtask/src/ports/wasi.mjs");
    let runner = format!("node --no-warnings {}", script.display());
    let commands = if extent == Extent::Brief { cross::BRIEF } else { WHOLE };
    tally::run(commands.iter().map(|arguments| {
        let mut command = cargo(arguments);
        command.env("CARGO_BUILD_TARGET", WASI).env("CARGO_TARGET_WASM32_WASIP1_RUNNER", &runner);
        command
    }))
}

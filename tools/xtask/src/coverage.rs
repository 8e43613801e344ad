//! Line coverage of the tests.

use crate::command::{self, cargo};

/// Runs the tests of the libraries and of the check kit, and prints how many lines of each file they
/// reach. Needs `cargo install cargo-llvm-cov` and `rustup component add llvm-tools`.
///
/// # Errors
/// A tool that is missing, or a test that fails.
pub(crate) fn run() -> Result<(), String> {
    command::run(&mut cargo(
        "llvm-cov --workspace --all-features --exclude xtask --ignore-filename-regex (/tests/|/fuzz/)",
    ))
}

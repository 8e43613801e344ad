//! Miri, an interpreter that detects undefined behaviour.

use super::Extent;
use crate::command;
use crate::setup;
use crate::tally;
use std::process::Command;

/// Arguments of `cargo miri`: short tests, because each step takes a thousand times as long.
const BRIEF: &[&str] = &[
    "test --package tess-core --test output -- the_",
    "test --package tess-capi --test api -- hostile",
];

const WHOLE: &[&str] = &[
    "test --package tess-core --lib",
    "test --package tess-core --test output -- the_",
    "test --package tess-capi --lib --test api",
];

/// Runs tests of the model, and those of the C interface, whose `unsafe` code accesses callers'
/// memory.
pub(super) fn check(extent: Extent) -> Result<(), String> {
    let parts = [("component", "miri"), ("component", "rust-src")];
    setup::toolchain("nightly", &parts)?;
    let commands = if extent == Extent::Brief { BRIEF } else { WHOLE };
    tally::run(commands.iter().map(|arguments| {
        let mut miri = Command::new("cargo");
        miri.args(["+nightly", "miri"]).args(arguments.split_whitespace());
        // Isolation is off, because the tests read files.
        miri.env("MIRIFLAGS", "-Zmiri-disable-isolation").current_dir(command::workspace());
        miri
    }))
}

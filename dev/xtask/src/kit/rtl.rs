//! The circuit in `rtl`: lint, comparison with the model, planted faults and clocks in one command; long comparisons,
//! proofs and costs in others.

mod bench;
mod clocks;
mod cost;
mod long;
mod names;
mod place;
mod proofs;
mod stages;

use crate::setup;
use crate::test;
use bench::Bench;
use std::fmt::Write as _;
use std::path::PathBuf;
use tess_verify::Case;

/// Compares the circuit with the model and plants its faults, as the tests of the C interface do; then clocks.
///
/// # Errors
/// A tool is missing, the lint warns, an element differs, or a planted fault is not found.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[setup::VERILATOR, setup::SYSTEMC])?;
    test::run(&["bindings/c/tests/foreign.rs", "rtl_"])?;
    clocks::run(&Bench::built()?)
}

/// Compares for hours, and goes on where an earlier run has stopped.
///
/// # Errors
/// As for [`run`].
pub(crate) fn long() -> Result<(), String> {
    long::run(&Bench::built()?)
}

/// Proves the handshakes and the placement.
///
/// # Errors
/// A tool is missing, a proof fails, or one holds although a fault is planted.
pub(crate) fn prove() -> Result<(), String> {
    proofs::run()
}

/// Synthesizes the circuit and prints what it costs.
///
/// # Errors
/// A tool is missing or fails.
pub(crate) fn synthesize() -> Result<(), String> {
    cost::run()
}

/// Places and routes the circuit, and prints the clock that it reaches.
///
/// # Errors
/// A tool cannot be had or fails, or the clock is not reached.
pub(crate) fn place() -> Result<(), String> {
    place::run()
}

/// Writes the lists of sources anew.
///
/// # Errors
/// One cannot be written.
pub(crate) fn write_names() -> Result<(), String> {
    names::write()
}

/// The folder of the circuit.
fn sources() -> PathBuf {
    crate::command::workspace().join("rtl")
}

/// Cases as the bench reads them, one a line.
fn lines(cases: &[Case]) -> String {
    let mut text = String::new();
    for case in cases {
        let line = case.to_string();
        // Writing to a String does not fail.
        _ = writeln!(text, "{}", line.strip_prefix("case ").unwrap_or(&line));
    }
    text
}

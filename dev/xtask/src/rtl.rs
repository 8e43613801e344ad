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

/// Runs the command; `None` if there is no such command.
pub(crate) fn run(words: &[&str]) -> Option<Result<(), String>> {
    Some(match *words {
        ["rtl"] => compare(),
        ["rtl", "--long"] => Bench::built().and_then(|bench| long::run(&bench)),
        ["rtl", "--prove"] => proofs::run(),
        ["rtl", "--synth"] => cost::run(),
        ["rtl", "--place"] => place::run(),
        ["rtl", "--names"] => names::write(),
        _ => return None,
    })
}

/// Compares the circuit with the model and plants its faults, as the tests of the C interface do; then clocks.
///
/// # Errors
/// A tool is missing, the lint warns, an element differs, or a planted fault is not found.
fn compare() -> Result<(), String> {
    setup::provide(&[setup::VERILATOR, setup::SYSTEMC])?;
    test::run(&["bindings/c/tests/foreign.rs", "rtl_"])?;
    clocks::run(&Bench::built()?)
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

//! The circuit in `rtl`: one command for lint, ports, comparison with the model, planted faults and
//! clocks; others for long comparisons, proofs, gates and costs.

mod bench;
mod budgets;
mod clocks;
mod cost;
mod gates;
mod long;
mod names;
mod place;
mod ports;
mod proofs;
mod stages;

use crate::command;
use crate::setup;
use bench::{Bench, Design};
use std::fmt::Write as _;
use std::path::PathBuf;
use tess_verify::Case;

/// Runs the command; `None` if it does not exist.
pub(crate) fn run(words: &[&str]) -> Option<Result<(), String>> {
    Some(match *words {
        ["rtl"] => compare(),
        ["rtl", "--long"] => Bench::built(Design::Sources).and_then(|bench| long::run(&bench)),
        ["rtl", "--prove"] => proofs::run().and_then(|()| gates::run()),
        ["rtl", "--synth"] => cost::run(),
        ["rtl", "--place"] => place::run(),
        ["rtl", "--names"] => names::write(),
        _ => return None,
    })
}

/// Checks the ports, compares the circuit with the model and plants its faults, as the tests of the
/// C interface do, and finally counts clocks.
///
/// # Errors
/// A tool is missing, the lint warns, an output depends on an input, an element differs, or a
/// planted fault is not detected.
fn compare() -> Result<(), String> {
    setup::provide(&[setup::VERILATOR, setup::SYSTEMC, setup::YOSYS])?;
    ports::run()?;
    // Only this package is built, because the workspace has twice as much to compile. A test fails
    // if its tool is missing.
    let mut tests = command::cargo(bench::CAPI);
    tests.args(["--", "rtl_"]).env("TESS_CAPI_BUILD", bench::CAPI).env("CI", "1");
    command::run(&mut tests)?;
    clocks::run(&Bench::built(Design::Sources)?)
}

/// The folder of the circuit.
fn sources() -> PathBuf {
    command::workspace().join("rtl")
}

/// Cases in the form that the bench reads, one per line.
fn lines(cases: &[Case]) -> String {
    let mut text = String::new();
    for case in cases {
        let line = case.to_string();
        // Writing to a String does not fail.
        _ = writeln!(text, "{}", line.strip_prefix("case ").unwrap_or(&line));
    }
    text
}

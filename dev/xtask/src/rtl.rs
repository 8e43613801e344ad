//! The circuit in `rtl`: lint, ports, comparison with the model, planted faults and clocks in one
//! command; long comparisons, proofs and gates, and costs in others.

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

/// Runs the command; `None` if there is no such command.
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
/// C interface do; then clocks.
///
/// # Errors
/// A tool is missing, the lint warns, an output depends on an input, an element differs, or a
/// planted fault is not found.
fn compare() -> Result<(), String> {
    setup::provide(&[setup::VERILATOR, setup::SYSTEMC, setup::YOSYS])?;
    ports::run()?;
    // Only this package: the workspace has twice as many to compile. A test whose tool is missing
    // fails.
    let mut tests = command::cargo(bench::CAPI);
    tests.args(["--", "rtl_"]).env("TESS_CAPI_BUILD", bench::CAPI).env("CI", "1");
    command::run(&mut tests)?;
    clocks::run(&Bench::built(Design::Sources)?)
}

/// The folder of the circuit.
fn sources() -> PathBuf {
    command::workspace().join("rtl")
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

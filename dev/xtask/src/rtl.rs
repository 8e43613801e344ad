//! The circuit in `rtl`: one command for lint, ports, comparison with the model, planted faults and
//! clocks; others for long comparisons, proofs, gates and costs.

mod bench;
mod budgets;
mod cost;
mod gates;
mod lint;
#[cfg(feature = "kit")]
mod long;
mod names;
mod place;
mod ports;
mod proofs;
#[cfg(feature = "kit")]
mod stages;
mod uvm;

use crate::command;
use crate::setup;
use std::path::PathBuf;

/// The arguments of `cargo` that build the tests of the C interface, and with them the library that
/// benches link. Only this package: the workspace has twice as many to compile. The benches call no
/// batches, whose kernels would take half of the build's time if they were optimised.
const CAPI: &str = "test --package tess-capi --all-features --test foreign \
                    --config profile.dev.package.tess-simd.opt-level=0";

/// Runs the command; `None` if it does not exist.
pub(crate) fn run(words: &[&str]) -> Option<Result<(), String>> {
    Some(match *words {
        ["rtl"] => compare(),
        #[cfg(feature = "kit")]
        ["rtl", "--long"] => long::run(),
        ["rtl", "--prove"] => proofs::run().and_then(|()| gates::run()),
        ["rtl", "--synth"] => cost::run(),
        ["rtl", "--place"] => place::run(),
        ["rtl", "--names"] => names::write(),
        _ => return None,
    })
}

/// Checks the sources' style and the ports, then runs the circuit's tests of the C interface:
/// comparisons with the model, planted faults, clocks, and, if `UVM_HOME` names a UVM, the UVM
/// package.
///
/// # Errors
/// A tool is missing, the lint warns, an output depends on an input, an element or a number of
/// clocks differs, or a planted fault is not found.
pub(crate) fn compare() -> Result<(), String> {
    setup::provide(&[setup::VERILATOR, setup::SYSTEMC, setup::YOSYS])?;
    lint::run()?;
    ports::run()?;
    // A test whose tool is missing fails.
    let mut tests = command::cargo(CAPI);
    tests.args(["--", "--ignored", "_on_request", "--skip", "uvm_"]);
    command::run(tests.env("TESS_CAPI_BUILD", CAPI).env("CI", "1"))?;
    uvm::run()
}

/// The folder of the circuit.
fn sources() -> PathBuf {
    command::workspace().join("rtl")
}

//! Compares the circuit with the model as a netlist of library cells, whose registers hold
//! arbitrary values at power-up.
//!
//! The netlist has register stages at its ports and padded AXI4-Stream words, so these are tested
//! here too.

use crate::bench::{self, stimuli};
use crate::clocks::isolines;
use crate::tools::{self, CELLS, YOSYS};
use std::time::Instant;
use tess_commands::setup;

/// The options for random values in all registers at power-up.
const POWER_UP: [&str; 2] = ["+verilator+rand+reset+2", "+verilator+seed+7"];
const PATCHES: usize = 200;

/// Builds the netlist and its bench. Then compares random patches after resets, and isolines
/// without a lost clock.
///
/// # Errors
/// A tool or the cell library is missing, an element differs, or the register stages lose clocks.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[YOSYS, CELLS])?;
    let folder = bench::folder();
    tools::run(bench::script(&folder)?.args(["--gates", "--build"]))?;
    let bench = folder.join("gates/bench/Vtb_tess");
    let began = Instant::now();
    let random = ["+random=200", "+gaps", "+resets=20", POWER_UP[0], POWER_UP[1]];
    let (verdict, _) = bench::compare(&bench, &random, PATCHES)?;
    println!("gates: {verdict}, {:.1} s", began.elapsed().as_secs_f32());
    let stimuli = stimuli("isolines-200", &isolines(PATCHES)?)?;
    let (_, said) = bench::compare(&bench, &[&stimuli, POWER_UP[0]], PATCHES)?;
    for expected in [
        "between patches: at most 0 clocks",
        "within patches: 0 clocks without a point, 0 without a primitive",
    ] {
        if !said.lines().any(|line| line == expected) {
            return Err(format!("with register stages, not `{expected}`:\n{said}"));
        }
    }
    println!("gates: {PATCHES} isoline patches, no clock lost with register stages");
    Ok(())
}

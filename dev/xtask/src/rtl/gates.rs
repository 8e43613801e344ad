//! The circuit as a netlist of library cells, with registers that hold anything at power-up,
//! against the model.
//!
//! The netlist has register stages at its ports and padded AXI4-Stream words, so those are compared
//! here too.

use super::bench::Bench;
use crate::setup;
use std::time::Instant;

/// Random values in all registers at power-up.
const POWER_UP: [&str; 2] = ["+verilator+rand+reset+2", "+verilator+seed+7"];
const PATCHES: usize = 200;
/// Four lines of eight segments.
const ISOLINE: &str = "isoline integer line ruler 40800000 41000000\n";

/// Builds the netlist and its bench; then random patches after resets, and isolines without a clock
/// lost.
///
/// # Errors
/// A tool or the library of cells is missing, an element differs, or the register stages lose
/// clocks.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[setup::YOSYS, setup::CELLS])?;
    let bench = Bench::built(&["--gates"], "gates/bench")?;
    let began = Instant::now();
    let random = ["+random=200", "+gaps", "+resets=20", POWER_UP[0], POWER_UP[1]];
    let (verdict, _) = bench.compare(&random, PATCHES)?;
    println!("gates: {verdict}, {:.1} s", began.elapsed().as_secs_f32());
    let stimuli = bench.stimuli("isolines", &ISOLINE.repeat(PATCHES))?;
    let (_, said) = bench.compare(&[&stimuli, POWER_UP[0]], PATCHES)?;
    for expected in
        ["between patches: at most 0 clocks", "within patches: 0 clocks without a point"]
    {
        if !said.contains(expected) {
            return Err(format!("with register stages, not `{expected}`:\n{said}"));
        }
    }
    println!("gates: {PATCHES} isoline patches, no clock lost with register stages");
    Ok(())
}

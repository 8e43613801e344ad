//! The ports of the circuit: no output may depend on an input in the same clock, except on the
//! reset.
//!
//! Yosys selects the logic between the outputs and the registers that feed them, and the inputs in
//! it.

use super::proofs::{self, Planted};
use crate::command;
use std::path::Path;
use std::process::Command;

/// The planted faults that the check must detect, each with the variant that has it: with register
/// stages at the ports (`BUFFERED`) or without.
pub(super) const FAULTS: [(&str, bool); 2] = [
    ("a patch waits until the one before is taken from the front end", false),
    ("the buffer of one entry is ready only for an element that is offered", true),
];

/// Checks the design with and without register stages, then that each fault is detected.
///
/// # Errors
/// Yosys fails, an output depends on an input, or a fault is not detected.
pub(crate) fn run() -> Result<(), String> {
    let folder = proofs::folder();
    for buffered in [false, true] {
        proofs::copy(Planted::Nothing, true)?;
        let inputs = inputs_of_outputs(&folder, buffered)?;
        if !inputs.is_empty() {
            let inputs = inputs.join(", ");
            return Err(format!("an output depends on these inputs in the same clock: {inputs}"));
        }
    }
    println!("\nno output depends on an input in the same clock, except on the reset");
    for (fault, buffered) in FAULTS {
        proofs::copy(Planted::Fault(fault), true)?;
        let inputs = inputs_of_outputs(&folder, buffered)?;
        if inputs.is_empty() {
            return Err(format!("no output depends on an input, though {fault}"));
        }
        println!("    {} found if {fault}, as it must", inputs.join(", "));
    }
    Ok(())
}

/// The inputs of `tess_axis` in the design in `folder`, other than clock and reset, on which an
/// output depends.
fn inputs_of_outputs(folder: &Path, buffered: bool) -> Result<Vec<String>, String> {
    let script = format!(
        "read_verilog -sv -I . {}; chparam -set BUFFERED {} tess_axis; hierarchy -top tess_axis; proc; flatten; \
         opt_clean; select -set outputs o:*_tvalid o:*_tready o:*_tdata o:*_tlast; select -assert-count 9 @outputs; \
         select -set inputs i:*_tvalid i:*_tready i:*_tdata; select -assert-count 5 @inputs; \
         tee -o inputs.txt select -list @outputs %cie* @inputs %i",
        proofs::design(folder)?.join(" "),
        u8::from(buffered),
    );
    command::quiet_output(Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder))?;
    let list = command::read(&folder.join("inputs.txt"))?;
    Ok(list.lines().filter_map(|line| line.strip_prefix("tess_axis/")).map(str::to_owned).collect())
}

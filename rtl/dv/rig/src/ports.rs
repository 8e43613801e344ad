//! The ports of the circuit: no output may depend on an input in the same clock, except on the
//! reset.
//!
//! Yosys selects the logic between the outputs and the registers that feed them, and the inputs in
//! it.

use crate::proofs::{self, Planted};
use std::path::Path;
use std::process::Command;
use tess_commands::command;

/// The variants of the design: the parameters of each.
const VARIANTS: [&str; 6] = [
    PLAIN,
    BUFFERED,
    LABELLED,
    "-set BUFFERED 1 -set TAG 13 -set BASE 30",
    "-set POINTS 4",
    "-set BUFFERED 1 -set TAG 13 -set BASE 30 -set POINTS 4",
];
const PLAIN: &str = "-set BUFFERED 0";
const BUFFERED: &str = "-set BUFFERED 1";
const LABELLED: &str = "-set TAG 13 -set BASE 30";

/// The planted faults that the check must detect, each with the variant that has it.
pub(crate) const FAULTS: [(&str, &str); 3] = [
    ("a patch waits until the one before is taken from the front end", PLAIN),
    ("the buffer of one entry is ready only for an element that is offered", BUFFERED),
    ("the place of a tag that leaves is free in the same clock", LABELLED),
];

/// Checks each variant of the design, then that each fault is detected.
///
/// # Errors
/// Yosys fails, an output depends on an input, or a fault is not detected.
pub(crate) fn run() -> Result<(), String> {
    let folder = proofs::folder();
    for variant in VARIANTS {
        proofs::copy(Planted::Nothing, true)?;
        let inputs = inputs_of_outputs(&folder, variant)?;
        if !inputs.is_empty() {
            let inputs = inputs.join(", ");
            return Err(format!("an output depends on these inputs in the same clock: {inputs}"));
        }
    }
    unused_parameters_are_free(&folder)?;
    println!("\nno output depends on an input in the same clock, except on the reset");
    for (fault, variant) in FAULTS {
        proofs::copy(Planted::Fault(fault), true)?;
        let inputs = inputs_of_outputs(&folder, variant)?;
        if inputs.is_empty() {
            return Err(format!("no output depends on an input, though {fault}"));
        }
        println!("    {} found if {fault}, as it must", inputs.join(", "));
    }
    Ok(())
}

/// Checks that tags, numbered points and lanes cost nothing without their parameters.
///
/// # Errors
/// Yosys fails, or finds a cell of them; or it finds none although they are used.
fn unused_parameters_are_free(folder: &Path) -> Result<(), String> {
    let used = [(PLAIN, true), (BUFFERED, true), (LABELLED, false), ("-set POINTS 2", false)];
    for (variant, is_free) in used {
        let script = format!(
            "read_verilog -sv -I . {}; chparam {variant} tess_axis; hierarchy -top tess_axis; proc; opt_clean; \
             tee -o cells.txt select -list *tess_tags*/t:* *tess_base*/t:* *tess_lane*/t:*",
            proofs::design(folder)?.join(" "),
        );
        command::quiet_output(
            Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder),
        )?;
        let cells = command::read(&folder.join("cells.txt"))?;
        // Yosys warns of a module that the design does not have.
        let is_cell = |line: &str| !line.is_empty() && !line.starts_with("Warning: ");
        if cells.lines().any(is_cell) == is_free {
            return Err(format!("cells of tags, sums and lanes with {variant}:\n{cells}"));
        }
    }
    println!("tags, numbered points and lanes have no cells without their parameters");
    Ok(())
}

/// The inputs of `tess_axis` in the design in `folder`, other than clock and reset, on which an
/// output depends.
fn inputs_of_outputs(folder: &Path, variant: &str) -> Result<Vec<String>, String> {
    let script = format!(
        "read_verilog -sv -I . {}; chparam {variant} tess_axis; hierarchy -top tess_axis; proc; flatten; \
         opt_clean; select -set outputs o:*_tvalid o:*_tready o:*_tdata o:*_tkeep o:*_tlast; select -assert-count 10 @outputs; \
         select -set inputs i:*_tvalid i:*_tready i:*_tdata; select -assert-count 5 @inputs; \
         tee -o inputs.txt select -list @outputs %cie* @inputs %i",
        proofs::design(folder)?.join(" "),
    );
    command::quiet_output(Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder))?;
    let list = command::read(&folder.join("inputs.txt"))?;
    Ok(list.lines().filter_map(|line| line.strip_prefix("tess_axis/")).map(str::to_owned).collect())
}

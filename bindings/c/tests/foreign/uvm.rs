//! The package `tess_uvm` in Verilator, with a stub of UVM.

use super::tools::{build_folder, crate_folder, libraries, output, run, text};
use libtest_mimic::Failed;
use std::process::Command;
use tess_verify::case::Case;

/// The planted differences, and what the scoreboard says of each.
const FAULTS: [(u32, &str); 6] = [
    (1, "point 3: observed ("),
    (2, "index 4: observed "),
    (3, "number of points: observed "),
    (4, "1 expected and 0 observed results have no partner"),
    (5, "number of coordinates: observed "),
    (6, "the result is of case "),
];

/// It compiles; equal results pass, and each planted difference is reported.
pub(crate) fn compiles_and_runs() -> Result<(), Failed> {
    let folder = build_folder().join("uvm");
    let mut script = Command::new(crate_folder().join("../uvm/scripts/verilator"));
    script.env("TESS_LIBRARY", libraries()?.archive).env("TESS_VERILOG_BUILD", &folder);
    let said = run(&mut script)?;
    let equal = "8 compared, 0 mismatches, 0 errors";
    if !said.lines().any(|line| line == equal) || !said.lines().any(|line| line == "PASS") {
        return Err(format!("not said: {equal}, PASS; but:\n{said}").into());
    }
    let unordered = run(Command::new(folder.join("Vtb_uvm")).arg("+unordered"))?;
    if !unordered.lines().any(|line| line == equal) {
        return Err(format!("results from the last to the first:\n{unordered}").into());
    }
    for (fault, report) in FAULTS {
        let output = output(Command::new(folder.join("Vtb_uvm")).arg(format!("+fault={fault}")))?;
        let said = text(&output.stdout);
        let reported =
            said.lines().any(|line| line.starts_with("UVM_ERROR") && line.contains(report));
        // The case can be pasted, but where no result of a patch is wrong.
        let case = said.lines().find(|line| line.starts_with("case "));
        let is_case = fault == 4 || case.is_some_and(|line| line.parse::<Case>().is_ok());
        if output.status.success() || !reported || !is_case {
            return Err(format!("fault {fault} was not reported as `{report}`:\n{said}").into());
        }
    }
    Ok(())
}

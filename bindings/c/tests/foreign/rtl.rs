//! The circuit in `rtl/` against the model, in Verilator, with the script that its users run.

use super::tools::{build_folder, crate_folder, libraries, output, run, text};
use libtest_mimic::Failed;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;
use tess_verify::generate::{GenLevel, Selection};

/// The planted faults: number, the stage and the signal that are named first.
const FAULTS: &[(u32, &str, &str)] = &[
    (1, "factors", "fixed"),
    (2, "factors", "fixed"),
    (3, "factors", "fixed"),
    (4, "points", "v"),
    (5, "points", "v"),
    (6, "connect", "i0"),
    (7, "connect", "i0"),
    (8, "connect", "i1"),
    (9, "connect", "i2"),
    (10, "points", "u"),
    (11, "counts", "points"),
    (12, "counts", "points"),
];

/// Lints the design and builds the bench, once.
fn bench() -> Result<PathBuf, String> {
    static BUILT: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    BUILT.get_or_init(build).clone()
}

fn build() -> Result<PathBuf, String> {
    let folder = build_folder().join("rtl");
    let mut script = Command::new(crate_folder().join("../../rtl/run"));
    script.env("TESS_LIBRARY", libraries()?.archive).env("TESS_VERILOG_BUILD", &folder);
    let said = run(script.args(["+random=100", "+resets=10"]))?;
    verdict(&said, 100)?;
    Ok(folder.join("Vtb_tess"))
}

/// Whether the bench said that it compared at least this many patches, and none differs.
fn verdict(said: &str, patches: u64) -> Result<(), String> {
    let tally = said.lines().find(|line| line.ends_with(" clocks, 0 mismatches"));
    let compared = tally.and_then(|line| line.split(' ').next()?.parse::<u64>().ok());
    if said.lines().any(|line| line == "PASS") && compared.is_some_and(|count| count >= patches) {
        return Ok(());
    }
    Err(format!("not said that {patches} patches are equal:\n{said}"))
}

/// Level 1, then random patches, with random gaps and back-pressure.
pub(crate) fn equals_model() -> Result<(), Failed> {
    let mut lines = String::new();
    let mut count = 20_000;
    for case in Selection::level(GenLevel::One, 1).cases() {
        let case = case.to_string();
        writeln!(lines, "{}", case.strip_prefix("case ").ok_or("a case line")?)?;
        count += 1;
    }
    let file = build_folder().join("rtl-level-1.txt");
    std::fs::write(&file, lines)?;
    let stimuli = format!("+stimuli={}", file.display());
    let mut bench = Command::new(bench()?);
    let said = run(bench.args([&stimuli, "+random=20000", "+gaps", "+resets=100"]))?;
    Ok(verdict(&said, count)?)
}

/// Each planted fault makes the bench fail, naming the stage, the signal, both values and the patch.
pub(crate) fn faults_are_caught() -> Result<(), Failed> {
    for (fault, stage, signal) in FAULTS {
        let arguments = [format!("+fault={fault}"), "+random=20000".into(), "+gaps".into()];
        let output = output(Command::new(bench()?).args(arguments))?;
        let said = text(&output.stdout);
        let first = said.lines().find(|line| line.starts_with("MISMATCH"));
        let named = first.is_some_and(|line| {
            line.contains(&format!("stage={stage} signal={signal} "))
                && line.contains(" observed=0x")
                && line.contains(" expected=0x")
        });
        if output.status.success() || !named || !said.contains("    case ") {
            return Err(
                format!("fault {fault} was not reported as {stage}, {signal}:\n{said}").into()
            );
        }
    }
    Ok(())
}

/// A stimulus file that is empty, or names what the specification does not, is an error.
pub(crate) fn stimuli_are_checked() -> Result<(), Failed> {
    for (name, lines, complaint) in [
        ("empty", "", ": no patches"),
        ("name", "tri integer triangles ruler 3f800000 3f800000 3f800000 3f800000\n", "no name"),
        ("short", "tri integer line ruler 3f800000\n", "patch 0 lacks factors"),
    ] {
        let file = build_folder().join(format!("rtl-{name}.txt"));
        std::fs::write(&file, lines)?;
        let stimuli = format!("+stimuli={}", file.display());
        let output = output(Command::new(bench()?).arg(stimuli))?;
        let said = text(&output.stdout) + &text(&output.stderr);
        if output.status.success() || !said.contains(complaint) {
            return Err(format!("stimuli `{name}`: {}\n{said}", output.status).into());
        }
    }
    Ok(())
}

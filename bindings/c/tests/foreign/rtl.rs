//! The circuit in `rtl/` against the model, in Verilator, with the script that its users run.

use super::tools::{build_folder, crate_folder, libraries, output, run, text};
use libtest_mimic::Failed;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;
use tess_verify::generate::{GenLevel, Selection};

/// Lints the design and builds the bench, once.
fn bench() -> Result<PathBuf, String> {
    static BUILT: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    BUILT.get_or_init(build).clone()
}

fn build() -> Result<PathBuf, String> {
    let folder = build_folder().join("rtl");
    let mut script = Command::new(crate_folder().join("../../rtl/dv/run"));
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
    let said = run(bench.args([&stimuli, "+random=20000", "+gaps", "+resets=800", "+covered"]))?;
    Ok(verdict(&said, count)?)
}

/// Each planted fault makes the bench fail, naming the stage, the signal, both values and the patch.
pub(crate) fn faults_are_caught() -> Result<(), Failed> {
    let folder = build_folder().join("rtl");
    let mut script = Command::new(crate_folder().join("../../rtl/dv/run"));
    script.env("TESS_LIBRARY", libraries()?.archive).env("TESS_VERILOG_BUILD", &folder);
    run(script.args(["--faults", "--build"]))?;
    let bench = || {
        let mut bench = Command::new(folder.join("faults/Vtb_tess"));
        bench.args(["+random=20000", "+gaps", "+resets=200"]);
        bench
    };
    verdict(&run(&mut bench())?, 20_000)?;
    let planter = crate_folder().join("../../rtl/dv/plant.py");
    for line in run(Command::new("python3").arg(planter).arg("--list"))?.lines() {
        let words: Vec<&str> = line.split('\t').collect();
        let [number, _, _, seen_by, _] = words[..] else {
            return Err(format!("not NUMBER KIND MODULE SEEN NAME: {line}").into());
        };
        // Lost clocks are judged by `cargo xtask rtl`.
        if seen_by == "clocks" {
            continue;
        }
        let (kind, seen_by) = seen_by
            .strip_prefix("assertion ")
            .map_or(("MISMATCH", seen_by), |by| ("ASSERTION", by));
        let (stage, signal) = seen_by.split_once(' ').ok_or("not STAGE SIGNAL")?;
        let output = output(bench().arg(format!("+fault={number}")))?;
        let said = text(&output.stdout);
        let is_named = |line: &&str| line.starts_with("MISMATCH") || line.starts_with("ASSERTION");
        let first = said.lines().find(is_named).unwrap_or_default();
        let is_whole = kind == "ASSERTION"
            || [" observed=0x", " expected=0x"].iter().all(|word| first.contains(word))
                && said.contains("    case ");
        let named = first.starts_with(&format!("{kind} stage={stage} signal={signal} "));
        if output.status.success() || !named || !is_whole {
            return Err(format!("fault {line} was not reported:\n{said}").into());
        }
    }
    Ok(())
}

/// Single stages equal the model at the ends of their ranges.
pub(crate) fn stages_equal_model() -> Result<(), Failed> {
    let mut script = Command::new(crate_folder().join("../../rtl/dv/run"));
    script.env("TESS_LIBRARY", libraries()?.archive);
    script.env("TESS_VERILOG_BUILD", build_folder().join("rtl"));
    let said = run(script.args(["--stages", "+first=4194177", "+factors=128"]))?;
    if !said.lines().any(|line| line.ends_with(" places, 0 processed factors, 0 mismatches")) {
        return Err(format!("no tally:\n{said}").into());
    }
    let bench = build_folder().join("rtl/stages/Vtb_stages");
    run(Command::new(&bench).args(["+bits=3f7ff800", "+words=4096"]))?;
    Ok(())
}

/// The `SystemC` modules of the circuit and of the model give the same streams; with another split order they do not.
pub(crate) fn systemc_modules_are_equal() -> Result<(), Failed> {
    let folder = build_folder().join("systemc");
    let mut script = Command::new(crate_folder().join("../systemc/run"));
    script.env("TESS_LIBRARY", libraries()?.archive).env("TESS_VERILOG_BUILD", &folder);
    let said = run(&mut script)?;
    if !said.lines().any(|line| line.starts_with("300 patches, ") && line.ends_with(" equal")) {
        return Err(format!("no tally:\n{said}").into());
    }
    let output = output(Command::new(folder.join("compare")).arg("--fault"))?;
    let said = text(&output.stdout);
    if output.status.code() != Some(1) || !said.contains("MISMATCH stream=points element=") {
        return Err(format!("another split order was not found: {}\n{said}", output.status).into());
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

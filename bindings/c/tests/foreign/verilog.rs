//! The Verilog placer against the model, in Verilator.

use super::tools::{build_folder, crate_folder, libraries, output, repository, run, text};
use libtest_mimic::Failed;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;
use tess_core::fixed_point::{HALF, ONE};
use tess_core::{FactorContext, FixedFactor, Parity, SplitOrder};
use tess_testkit::circuit;

/// The planted faults of `rtl/dv/circuit.faults`, and the stage and the signal that must be named.
const FAULTS: &[(&str, &str, &str)] = &[
    ("a half is cut off, not rounded up", "factor_context", "fraction"),
    ("mirroring forgets the parity of the edge", "place_position", "position"),
    ("the blend is cut off, not rounded", "place_blend", "half_location"),
];

/// Builds the bench once, with the script that its users run, which also lints the design.
fn bench() -> Result<PathBuf, String> {
    static BUILT: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    BUILT.get_or_init(build).clone()
}

fn build() -> Result<PathBuf, String> {
    let folder = build_folder().join("verilog");
    let mut script = Command::new(crate_folder().join("verilog/run"));
    script.env("TESS_LIBRARY", libraries()?.archive).env("TESS_VERILOG_BUILD", &folder);
    let said = run(&mut script)?;
    if said.lines().any(|line| line == "PASS") {
        Ok(folder.join("Vtb_placer"))
    } else {
        Err(format!("the bench ended without a verdict:\n{said}"))
    }
}

pub(crate) fn equals_model() -> Result<(), Failed> {
    let said = run(Command::new(bench()?).arg("+random=0"))?;
    let (factors, vectors) = level_1();
    let expected = format!("{factors} factors, {vectors} vectors, 0 mismatches");
    if said.lines().any(|line| line == expected) && said.lines().any(|line| line == "PASS") {
        Ok(())
    } else {
        Err(format!("not said: {expected}; but:\n{said}").into())
    }
}

/// How many factors and points level 1 has.
fn level_1() -> (u32, u32) {
    let mut counts = (0, 0);
    for bits in (2..=128).flat_map(|halves| [halves * HALF - 1, halves * HALF, halves * HALF + 1]) {
        let odd = (ONE..=63 * ONE).contains(&bits).then_some(Parity::Odd);
        let even = bits == ONE || (2 * ONE..=64 * ONE).contains(&bits);
        for parity in odd.into_iter().chain(even.then_some(Parity::Even)) {
            for split in SplitOrder::ALL {
                counts.0 += 1;
                counts.1 += FactorContext::new(FixedFactor::from_bits(bits), parity, split).points;
            }
        }
    }
    counts
}

/// Each planted fault makes the bench fail, naming the stage and signal, both values, the factor.
pub(crate) fn faults_are_caught() -> Result<(), Failed> {
    let folder = build_folder().join("verilog-faults");
    let design = folder.join("design");
    circuit::plant(&repository(), &design, None)?;
    let list = circuit::faults(&repository())?;
    let mut script = Command::new(crate_folder().join("verilog/run"));
    script.env("TESS_LIBRARY", libraries()?.archive).env("TESS_VERILOG_BUILD", &folder);
    run(script.env("TESS_RTL", &design).arg("+random=0"))?;
    for (fault, stage, signal) in FAULTS {
        let (number, _) = list.iter().find(|(_, one)| one.name == *fault).ok_or("no such fault")?;
        let mut bench = Command::new(folder.join("Vtb_placer"));
        let output = output(bench.arg(format!("+fault={number}")))?;
        let said = text(&output.stdout);
        let wrong: Vec<&str> = said.lines().filter(|line| line.starts_with("MISMATCH")).collect();
        let named = |line: &&str| {
            line.contains(&format!("stage={stage} signal={signal} observed=0x"))
                && line.contains(" expected=0x")
        };
        let all_named = !wrong.is_empty() && wrong.iter().all(named);
        let factor_named = said.lines().any(|line| line.trim_start().starts_with("factor=0x"));
        if output.status.success() || !all_named || !factor_named {
            return Err(
                format!("fault {fault} was not reported as {stage}, {signal}:\n{said}").into()
            );
        }
    }
    Ok(())
}

/// A stimulus file is run whole; an empty or malformed one is an error.
pub(crate) fn stimuli_are_checked() -> Result<(), Failed> {
    for (name, words, passes, complaint) in [
        ("three", "11020000\n01010001 // odd\n00400000\n", true, ": 3 factors"),
        ("empty", "", false, ": no stimuli"),
        ("digit", "21020000\n", false, "word 0, 21020000, is no stimulus"),
        ("range", "01010000\n01400000\n", false, "word 1, 01400000, is no stimulus"),
    ] {
        let file = build_folder().join(format!("{name}.hex"));
        std::fs::write(&file, words)?;
        let stimuli = format!("+stimuli={}", file.display());
        let output = output(Command::new(bench()?).arg("+random=0").arg(stimuli))?;
        let said = text(&output.stdout);
        if output.status.success() != passes || !said.contains(complaint) {
            let status = output.status;
            return Err(format!("stimuli `{name}` ended with {status}:\n{said}").into());
        }
    }
    Ok(())
}

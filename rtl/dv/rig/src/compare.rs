//! The circuit against the model in Verilator, its planted faults, and the `SystemC` modules.

use crate::bench::{self, Variant, bench, library, script, stimuli};
use crate::clocks::{self, isolines};
use crate::faults;
use crate::tools::{build_folder, output, run, said, text};
use crate::verdict::BenchVerdict;
use libtest_mimic::{Arguments, Failed, Trial};
use std::process::Command;
use std::time::Instant;
use tess_commands::command::workspace;
use tess_testkit::listed::ListedFault;
use tess_verify::Case;
use tess_verify::generate::{GenLevel, Selection};

/// Random patches that find every fault, and those by whose clocks the slow ones are found.
const ALL: [&str; 4] = ["+random=20000", "+gaps", "+resets=200", POWER_UP];
const TIMED: [&str; 1] = ["+random=500"];
/// Registers without reset hold anything at first.
const POWER_UP: &str = "+verilator+rand+reset+2";

type Test = fn() -> Result<(), Failed>;

const TESTS: &[(&str, Test)] = &[
    ("equals_model", equals_model),
    ("buffered_equals_model", buffered_equals_model),
    ("two_points_equal_model", two_points_equal_model),
    ("four_points_equal_model", four_points_equal_model),
    ("clocks_are_those_of_the_document", clocks::are_those_of_the_document),
    ("faults_are_caught", faults_are_caught),
    ("stages_equal_model", stages_equal_model),
    ("stages_faults_are_caught", stages_faults_are_caught),
    ("systemc_modules_are_equal", systemc_modules_are_equal),
    ("stimuli_are_checked", stimuli_are_checked),
];

/// Runs the comparisons, or those whose names contain this word.
///
/// # Errors
/// One fails, or there is none.
pub(crate) fn chosen(word: Option<&str>) -> Result<(), String> {
    let trials = TESTS.iter().map(|&(name, test)| Trial::test(name, test)).collect();
    let arguments = Arguments { filter: word.map(str::to_owned), ..Arguments::default() };
    let conclusion = libtest_mimic::run(&arguments, trials);
    match (conclusion.num_failed, conclusion.num_passed) {
        (0, 0) => Err(format!("no comparison has `{}` in its name", word.unwrap_or_default())),
        (0, _) => Ok(()),
        (failed, _) => Err(format!("{failed} comparisons failed")),
    }
}

/// Level 1, then random patches, with random gaps and back-pressure.
fn equals_model() -> Result<(), Failed> {
    equals(Variant::Plain, "level-1")
}

/// The same for the other variants.
fn buffered_equals_model() -> Result<(), Failed> {
    equals(Variant::Buffered, "level-1-buffered")
}

fn two_points_equal_model() -> Result<(), Failed> {
    equals(Variant::Two, "level-1-two")
}

fn four_points_equal_model() -> Result<(), Failed> {
    equals(Variant::Four, "level-1-four")
}

fn equals(variant: Variant, name: &str) -> Result<(), Failed> {
    let cases: Vec<Case> = Selection::level(GenLevel::One, 1).cases().collect();
    let stimuli = stimuli(name, &cases)?;
    let mut bench = Command::new(bench(variant)?);
    bench.args([&stimuli, "+random=20000", "+gaps", "+resets=4000", "+covered", POWER_UP]);
    let said = run(&mut bench)?;
    BenchVerdict::read(&said, 20_000 + cases.len() as u64)?;
    Ok(())
}

/// Each planted fault makes the bench fail, naming the stage, the signal, both values and the
/// patch; or it costs clocks.
fn faults_are_caught() -> Result<(), Failed> {
    let variants = [Variant::Plain, Variant::Buffered, Variant::Four];
    for variant in variants {
        let mut script = script(&bench::folder())?;
        run(script.arg("--faults").args(variant.options()).arg("--build"))?;
    }
    let plain = |fault: usize, arguments: &[&str]| planted(Variant::Plain, fault, arguments);
    let isolines = stimuli("isolines-100", &isolines(100)?)?;
    let timed = [isolines.as_str(), TIMED[0]];
    for variant in variants {
        BenchVerdict::read(&run(&mut planted(variant, 0, &ALL))?, 20_000)?;
    }
    let clocks = BenchVerdict::read(&run(&mut plain(0, &timed))?, 600)?.clocks;
    for (number, fault) in faults::listed()? {
        let began = Instant::now();
        let ListedFault { name, tests: seen_by, filters: words, .. } = &fault;
        // The first word may select the variant.
        let (variant, seen_by, words) = match (seen_by.as_str(), &words[..]) {
            ("buffered", [seen_by, words @ ..]) => (Variant::Buffered, seen_by.as_str(), words),
            ("four", [seen_by, words @ ..]) => (Variant::Four, seen_by.as_str(), words),
            (seen_by, words) => (Variant::Plain, seen_by, words),
        };
        let (is_seen, said) = if seen_by == "proof" {
            continue; // `cargo xtask rtl --prove` plants it
        } else if seen_by == "clocks" {
            let said = run(&mut plain(number, &timed))?;
            (BenchVerdict::read(&said, 600)?.clocks > clocks, said)
        } else {
            let output = output(&mut planted(variant, number, &ALL))?;
            let said = text(&output.stdout);
            let is_named = names(&said, seen_by, words).ok_or("`seen by` names no signal")?;
            (!output.status.success() && is_named, said)
        };
        let seen_by = format!("{seen_by} {}", words.join(" "));
        if !is_seen {
            return Err(format!("fault {number}, {name}: not seen by {seen_by}:\n{said}").into());
        }
        let seconds = began.elapsed().as_secs_f32();
        println!("  {number:>2} {}: {name}: {}, {seconds:.1} s", fault.folder, seen_by.trim_end());
    }
    Ok(())
}

/// The bench of a variant with all planted faults, of which it has this one.
fn planted(variant: Variant, fault: usize, arguments: &[&str]) -> Command {
    let folder = bench::folder().join("faults/bench").join(variant.folder());
    let mut bench = Command::new(folder.join("Vtb_tess"));
    bench.arg(format!("+fault={fault}")).args(arguments);
    bench
}

/// Whether the first report of a bench is what a list's `seen by` says; `None` if that is not
/// `[assertion] STAGE SIGNAL`.
fn names(said: &str, seen_by: &str, words: &[String]) -> Option<bool> {
    let (kind, stage, signal) = match (seen_by, words) {
        ("assertion", [stage, signal]) => ("ASSERTION", stage.as_str(), signal),
        (stage, [signal]) => ("MISMATCH", stage, signal),
        _ => return None,
    };
    let is_report = |line: &&str| line.starts_with("MISMATCH") || line.starts_with("ASSERTION");
    let first = said.lines().find(is_report).unwrap_or_default();
    let is_whole = kind == "ASSERTION"
        || [" observed=0x", " expected=0x"].iter().all(|word| first.contains(word))
            && said.contains("    case ");
    Some(is_whole && first.starts_with(&format!("{kind} stage={stage} signal={signal} ")))
}

/// Single stages equal the model: every context, the places of the factors about 1, 2, 3, 63 and
/// 64, and 4096 patterns about 1; `tess_placer` at each integer and half, their neighbours, and
/// 2011 more factors.
fn stages_equal_model() -> Result<(), Failed> {
    let folder = bench::folder();
    run(script(&folder)?.args(["--stages", "--build"]))?;
    let compare = |arguments: &[&str], tally: &str| {
        let tally = format!("{tally}, 0 mismatches");
        let said = run(Command::new(folder.join("stages/Vtb_stages")).args(arguments))?;
        let is_said = said.lines().any(|line| line == tally);
        if is_said { Ok(()) } else { Err(format!("not said `{tally}`:\n{said}")) }
    };
    for (first, tally) in [
        (0x1_0000, "258 contexts, 1026 places"),
        (0x1_FFC0, "384 contexts, 1660 places"),
        (0x2_FFC0, "512 contexts, 2556 places"),
        (0x3E_FFC0, "386 contexts, 24960 places"),
        (0x3F_FF81, "256 contexts, 16640 places"),
    ] {
        let first = format!("+first={first}");
        compare(&[&first, "+factors=128"], &format!("{tally}, 0 processed factors"))?;
    }
    let all = ["+first=65536", "+factors=4128769", "+contexts"];
    compare(&all, "16252934 contexts, 0 places, 0 processed factors")?;
    compare(&["+bits=3f7ff800", "+words=4096"], "0 contexts, 0 places, 65536 processed factors")?;
    for (first, stride, factors, tally) in [
        (0x1_0000, 0x8000, 127, "502 contexts, 17128 places"),
        (0x1_0001, 0x8000, 126, "496 contexts, 17112 places"),
        (0x1_7FFF, 0x8000, 126, "496 contexts, 17112 places"),
        (0x1_0000, 2053, 2011, "7920 contexts, 273104 places"),
    ] {
        let [first, stride, factors] = [("first", first), ("stride", stride), ("factors", factors)]
            .map(|(n, v)| format!("+{n}={v}"));
        let tally = format!("{tally}, 0 processed factors");
        compare(&["+placer", &first, &stride, &factors], &tally)?;
    }
    Ok(())
}

/// Faults of `tess_placer`'s three stages are named, and nothing that follows from them.
fn stages_faults_are_caught() -> Result<(), Failed> {
    let folder = bench::folder();
    run(script(&folder)?.args(["--faults", "--stages", "--build"]))?;
    let list = faults::listed()?;
    for (fault, report) in [
        ("a half is cut off, not rounded up", "stage=factor_context signal=fraction "),
        ("mirroring forgets the parity of the edge", "stage=place_position signal=position "),
        ("the blend is cut off, not rounded", "stage=place_blend signal=half_location "),
    ] {
        let (number, _) = list.iter().find(|(_, one)| one.name == fault).ok_or("no such fault")?;
        let mut bench = Command::new(folder.join("faults/bench/stages/Vtb_stages"));
        bench.args(["+placer", "+first=65537", "+stride=32768", "+factors=126"]);
        let output = output(bench.arg(format!("+fault={number}")))?;
        let said = text(&output.stdout);
        let mut reports = said.lines().filter_map(|line| line.strip_prefix("MISMATCH ")).peekable();
        let is_named = reports.peek().is_some() && reports.all(|line| line.starts_with(report));
        if output.status.success() || !is_named {
            return Err(format!("fault {fault} was not reported as {report}:\n{said}").into());
        }
    }
    Ok(())
}

/// The `SystemC` modules of the circuit and of the model give the same streams; with another split
/// order they do not.
fn systemc_modules_are_equal() -> Result<(), Failed> {
    let folder = build_folder().join("systemc");
    let mut script = Command::new(workspace().join("bindings/systemc/run"));
    script.env("TESS_LIBRARY", library()?).env("TESS_VERILOG_BUILD", &folder);
    let said = run(&mut script)?;
    let tally = "300 patches, 24 of domain 3, 20113 points, 22327 primitives equal";
    if !said.lines().any(|line| line == tally) {
        return Err(format!("not said `{tally}`:\n{said}").into());
    }
    let output = output(Command::new(folder.join("compare")).arg("--fault"))?;
    let said = text(&output.stdout);
    if output.status.code() != Some(1) || !said.contains("MISMATCH stream=points element=") {
        return Err(format!("another split order was not found: {}\n{said}", output.status).into());
    }
    Ok(())
}

/// A stimulus file that is empty, or names what the specification does not, is an error.
fn stimuli_are_checked() -> Result<(), Failed> {
    for (name, lines, complaint) in [
        ("empty", "", ": no patches"),
        ("name", "tri integer triangles ruler 3f800000 3f800000 3f800000 3f800000\n", "no name"),
        ("short", "tri integer line ruler 3f800000\n", "patch 0 lacks factors"),
    ] {
        let file = build_folder().join(format!("rtl-{name}.txt"));
        std::fs::write(&file, lines)?;
        let stimuli = format!("+stimuli={}", file.display());
        let output = output(Command::new(bench(Variant::Plain)?).arg(stimuli))?;
        let said = said(&output);
        if output.status.success() || !said.contains(complaint) {
            return Err(format!("stimuli `{name}`: {}\n{said}", output.status).into());
        }
    }
    Ok(())
}

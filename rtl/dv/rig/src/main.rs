//! The rig of the circuit in `rtl`. It uses the product as an outsider does: the model's cases, the
//! patches that benches time, and the C library, which the benches in `SystemVerilog` link.
//!
//! ```text
//! what a change must pass     own (this crate's lints and tests), lint, ports, compare, clocks, uvm
//! what takes longer           long (with stages), proofs, gates
//! what it costs               cost (Yosys), place (nextpnr, with budgets)
//! the design's files          names (lists of sources), faults (copies with planted faults)
//! what all of them use        bench (builds benches), verdict (reads what they say), tools
//! ```
//!
//! A command returns `Err(message)` on failure. Tools come from Debian or `PyPI`.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program talks to its user")]

mod bench;
mod budgets;
mod clocks;
mod compare;
mod cost;
mod faults;
mod gates;
mod lint;
mod long;
mod names;
mod own;
mod place;
mod ports;
mod proofs;
mod stages;
mod tools;
mod uvm;
mod verdict;

use std::process::ExitCode;
use tess_commands::setup::{self, NO_INSTALL, VERILATOR, YES};
use tools::{SYSTEMC, YOSYS};

const USAGE: &str = "\
usage: rtl/dv/rig/run [--yes | --no-install] [WORD...]
       cargo xtask rtl [WORD...]

  (none)  check this program, the circuit's style and ports, lint it and compare its variants with the model in Verilator:
          level 1, random patches under back-pressure, single stages; plant its faults; print clocks for the workloads of
          `tess bench` and isolines; with UVM_HOME, the UVM package
  --only WORD
          only the comparisons whose names contain the word
  --long  compare level 2, 10 million random patches and every input of single stages, which takes hours and continues
          where it stopped
  --prove prove handshakes and placement, and compare the netlist as gates
  --synth print the circuit's cost
  --place print the clock that it reaches, with three seeds and all parameters, and the time that each port leaves; an hour
  --plant FOLDER [NUMBER]
          write the design to FOLDER with every fault of rtl/dv/circuit.faults, which a simulation selects with
          `+fault=NUMBER`, or with one fault; print their numbers
  --names write the lists of sources for Bender and FuseSoC again

  A missing program is installed, on a terminal after a question, which `--yes` answers. With `--no-install` it is listed,
  and what needs it fails.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let is_consent = |word: &&str| [YES, NO_INSTALL].contains(word);
    let (consent, words): (Vec<&str>, Vec<&str>) =
        arguments.iter().map(String::as_str).partition(is_consent);
    setup::consent(consent.last().copied());
    match run(&words) {
        Some(Ok(())) => ExitCode::SUCCESS,
        Some(Err(message)) => {
            eprintln!("rig: {message}");
            ExitCode::FAILURE
        }
        None => {
            eprintln!("{USAGE}");
            ExitCode::from(2)
        }
    }
}

/// Runs the command; `None` if it does not exist.
fn run(words: &[&str]) -> Option<Result<(), String>> {
    Some(match *words {
        [] => everything(),
        ["--only", word] => only(word),
        ["--long"] => long::run(),
        ["--prove"] => proofs::run().and_then(|()| gates::run()),
        ["--synth"] => cost::run(),
        ["--place"] => place::run(),
        ["--names"] => names::write(),
        ["--plant", folder] => faults::write(folder.as_ref(), None),
        ["--plant", folder, number] => faults::write(folder.as_ref(), Some(number)),
        ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            Ok(())
        }
        _ => return None,
    })
}

/// Everything that a change must pass; the UVM package only if `UVM_HOME` names a UVM.
///
/// # Errors
/// A tool is missing, a lint warns, an output depends on an input, an element or a number of clocks
/// differs, or a planted fault is not found.
fn everything() -> Result<(), String> {
    setup::provide(&[VERILATOR, SYSTEMC, YOSYS])?;
    own::run()?;
    lint::run()?;
    ports::run()?;
    compare::chosen(None)?;
    uvm::check()
}

/// The comparisons whose names contain this word.
///
/// # Errors
/// As for [`everything`], or there is none.
fn only(word: &str) -> Result<(), String> {
    setup::provide(&[VERILATOR, SYSTEMC])?;
    compare::chosen(Some(word))
}

//! Development commands. `cargo xtask` lists them.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program talks to its user")]

mod ci;
mod command;
mod coverage;
mod fuzz;
mod mutants;
mod setup;
mod test;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask <command>

  test    set up what the tests need, then run every test of the workspace
  ci      what the continuous integration runs: formatting, lints, documentation,
          features, the fuzz targets' oracles on their seeds, `fuzz`, then `test`
  setup   only set up: a Vulkan driver, C and C++ compilers, Verilator
  fuzz [SECONDS]
          build every fuzz target and run each, for 10 seconds unless said
  mutants PACKAGE [OPTION...]
          plant faults in tess-core or tess-simd; fails if one survives the tests and
          docs/mutants.md does not list it (needs cargo-mutants; takes an hour)
  coverage
          line coverage of the tests (needs cargo-llvm-cov)";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let result = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["test"] => setup::run().and_then(|()| test::run()),
        ["ci"] => setup::run().and_then(|()| ci::run()),
        ["setup"] => setup::run(),
        ["fuzz"] => setup::run().and_then(|()| fuzz::run(fuzz::BRIEFLY)),
        ["fuzz", seconds] => setup::run().and_then(|()| fuzz::run(seconds)),
        ["mutants", package, ref rest @ ..] => mutants::run(package, rest),
        ["coverage"] => coverage::run(),
        ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

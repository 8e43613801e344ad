//! Development commands. `cargo xtask` lists them.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program talks to its user")]

mod ci;
mod command;
mod setup;
mod test;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask <command>

  test    set up what the tests need, then run every test of the workspace
  ci      what the continuous integration runs: formatting, lints, documentation,
          features, the fuzz targets' oracles on their seeds, then `test`
  setup   only set up: a Vulkan driver, C and C++ compilers, Verilator";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let result = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["test"] => setup::run().and_then(|()| test::run()),
        ["ci"] => setup::run().and_then(|()| ci::run()),
        ["setup"] => setup::run(),
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

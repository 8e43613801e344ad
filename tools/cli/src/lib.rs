//! The library behind the program `tess`.
//!
//! One module per command (`patch_command`, ...), and what they share: [`args`] (a patch on the
//! command line), [`backends`] (who tessellates it), [`output`] (where results go) and
//! [`failure`] (how a command ends).

pub mod args;
pub mod backends;
pub mod bench;
pub mod bench_command;
pub mod check_command;
pub mod draw;
pub mod draw_command;
pub mod explain;
pub mod explain_command;
pub mod failure;
pub mod formats;
pub mod gen_command;
pub mod mesh;
pub mod mesh_command;
pub mod output;
pub mod patch_command;
pub mod picture;
pub mod strength;
pub mod verify_command;

use clap::{Parser, Subcommand};
use failure::{Exit, Failure};
use std::io::Write;
use std::process::ExitCode;

/// A bit-exact model of the Direct3D 11 class fixed-function tessellator.
///
/// Results go to stdout, progress and messages to stderr. Exit codes: 0 done or equal,
/// 1 different, 2 bad usage or malformed, short or empty input, 3 backend not available here.
#[derive(Debug, Parser)]
#[command(name = "tess", version, after_help = EXAMPLES)]
struct Program {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  tess patch tri --outer 3,4,5 --inner 4        one patch as a listing
  tess draw tri --outer 17,5,9 --inner 3 -o fan.png
  tess check golden/patches.csv                 4000 recorded patches, compared
  tess bench --workload uniform-16              how fast on this machine";

#[derive(Debug, Subcommand)]
enum Command {
    Patch(patch_command::Args),
    Explain(explain_command::Args),
    Draw(draw_command::Args),
    Check(check_command::Args),
    Bench(bench_command::Args),
    Mesh(mesh_command::Args),
    Gen(gen_command::Args),
    Verify(verify_command::Args),
}

/// Runs the program on the process's arguments and says how it ended.
#[must_use]
pub fn main() -> ExitCode {
    let command = Program::parse().command;
    match run(&command) {
        Ok(exit) => exit.into(),
        Err(failure) => {
            // Nothing can be done if stderr is closed; the exit code still tells.
            _ = writeln!(std::io::stderr(), "tess: {failure}");
            failure.exit.into()
        }
    }
}

fn run(command: &Command) -> Result<Exit, Failure> {
    match command {
        Command::Patch(args) => patch_command::run(args),
        Command::Explain(args) => explain_command::run(args),
        Command::Draw(args) => draw_command::run(args),
        Command::Check(args) => check_command::run(args),
        Command::Bench(args) => bench_command::run(args),
        Command::Mesh(args) => mesh_command::run(args),
        Command::Gen(args) => gen_command::run(args),
        Command::Verify(args) => verify_command::run(args),
    }
}

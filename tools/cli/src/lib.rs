//! The library behind the program `tess`. Its only public function is [`main`].
//!
//! `commands` has a folder per command. The modules that commands share are next to it: `args` (a
//! patch on the command line), `backends` (the implementations that tessellate it), `campaign` (the
//! part of the work, and its report), `formats` (the forms of a result), `input` (what is read),
//! `output` and `coverage_file` (where results go) and `failure` (how a command ends). Drawings and
//! explanations are made by `tess-verify`.

mod args;
mod backends;
mod campaign;
mod commands;
mod comparison;
mod coverage_file;
mod failure;
mod formats;
mod input;
mod output;
mod threads;

use campaign::Invocation;
use clap::{Arg, ArgAction, CommandFactory, FromArgMatches, Parser};
use commands::Command;
use failure::{Exit, Failure};
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// A bit-exact model of the Direct3D 11 class fixed-function tessellator.
///
/// Results go to stdout, progress and messages to stderr. Exit codes: 0 done or equal,
/// 1 different, 2 bad usage or malformed, short or empty input, 3 backend not available here,
/// 141 the reader of stdout left early.
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

/// Runs the program with the process's arguments, and returns how it ended.
pub fn main() -> ExitCode {
    let mut program = command_line();
    let words: Vec<OsString> = std::env::args_os().collect();
    let asked = program.try_get_matches_from_mut(&words).and_then(|matches| {
        let text = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
        let invocation = Invocation::new(text, &program, &matches);
        Program::from_arg_matches(&matches).map(|asked| (asked.command, invocation))
    });
    let ended = match asked {
        Ok((command, invocation)) => commands::run(&command, &invocation),
        Err(error) if error.use_stderr() => error.exit(),
        Err(help) => show(&help),
    };
    output::ending::leave_to_signal();
    match ended {
        Ok(exit) => exit.into(),
        Err(failure) => {
            if !failure.message.is_empty() {
                output::note(&failure.message);
            }
            failure.exit.into()
        }
    }
}

/// Prints the text for `--help` or `--version`. Errors: stdout cannot be written.
fn show(help: &clap::Error) -> Result<Exit, Failure> {
    let written = help.print().and_then(|()| io::stdout().flush());
    written.map(|()| Exit::Done).map_err(|error| Failure::write(Path::new("-"), error))
}

/// The command line. A negative number is always a value, possibly a wrong one, and never an
/// option: the error names the value instead of advising `-- -1`.
fn command_line() -> clap::Command {
    let numbers = |arg: Arg| match arg.get_action() {
        ArgAction::Set | ArgAction::Append => arg.allow_negative_numbers(true),
        _ => arg,
    };
    let program = Program::command().mut_subcommand("patch", commands::without_patch_if_cases);
    program.mut_subcommands(move |command| command.mut_args(numbers))
}

//! Runs programs in the repository; each one is printed before it runs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The folder of the repository, which is that of the root workspace's `Cargo.toml`.
pub fn workspace() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().nth(2).unwrap_or(own).to_path_buf()
}

/// The folder of the root workspace's builds.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace().join("target"), PathBuf::from)
}

/// The message of an error with a file.
pub fn in_file(path: &Path, error: &dyn std::fmt::Display) -> String {
    format!("{}: {error}", path.display())
}

/// The text of a file.
///
/// # Errors
/// It cannot be read.
pub fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| in_file(path, &error))
}

/// `cargo` with these arguments, split at spaces, in the root workspace.
pub fn cargo(arguments: &str) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments.split_whitespace()).current_dir(workspace());
    command
}

/// The interpreter that the variable `PYTHON` names, or the system's.
pub fn python() -> Command {
    Command::new(std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into()))
}

/// The command as a person would type it.
pub fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_name().unwrap_or_default();
    let mut line = program.to_string_lossy().into_owned();
    for argument in command.get_args() {
        line.push(' ');
        line.push_str(&argument.to_string_lossy());
    }
    line
}

/// Runs a command to its end.
///
/// # Errors
/// It cannot be run, or ends with anything but success.
pub fn run(command: &mut Command) -> Result<(), String> {
    println!("\n$ {}", shown(command));
    let status =
        command.status().map_err(|error| format!("cannot run `{}`: {error}", shown(command)))?;
    if status.success() { Ok(()) } else { Err(format!("`{}` ended with {status}", shown(command))) }
}

/// Runs a command, and returns its standard output.
///
/// # Errors
/// It cannot be run, or ends with anything but success; or the output is no text.
pub fn output(command: &mut Command) -> Result<String, String> {
    said(command.stderr(Stdio::inherit()))
}

/// As [`output()`], with the standard error only in the message of a failure.
///
/// # Errors
/// As for [`output()`].
pub fn quiet_output(command: &mut Command) -> Result<String, String> {
    said(command.stderr(Stdio::piped()))
}

fn said(command: &mut Command) -> Result<String, String> {
    let output =
        command.output().map_err(|error| format!("cannot run `{}`: {error}", shown(command)))?;
    if !output.status.success() {
        let stderr = String::from_utf8_lossy(&output.stderr);
        let message = format!("`{}` ended with {}\n{stderr}", shown(command), output.status);
        return Err(message.trim_end().to_owned());
    }
    String::from_utf8(output.stdout).map_err(|error| format!("`{}`: {error}", shown(command)))
}

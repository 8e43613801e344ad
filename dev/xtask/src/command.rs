//! Runs programs in the workspace; each one is printed before it runs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The folder of the workspace's `Cargo.toml`.
pub(crate) fn workspace() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().nth(2).unwrap_or(own).to_path_buf()
}

/// The folder of the workspace's builds.
pub(crate) fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace().join("target"), PathBuf::from)
}

/// Builds the program `tess`, and returns its path.
pub(crate) fn program() -> Result<PathBuf, String> {
    run(&mut cargo("build --package tess-program"))?;
    Ok(built_program())
}

/// The path at which builds of the program `tess` and of its tests put it.
pub(crate) fn built_program() -> PathBuf {
    target().join("debug").join(format!("tess{}", std::env::consts::EXE_SUFFIX))
}

/// Cargo's own folder, which has the sources of dependencies.
///
/// # Errors
/// There is no home directory.
pub(crate) fn cargo_home() -> Result<PathBuf, String> {
    let own = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = own.or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    home.ok_or_else(|| "neither CARGO_HOME nor a home directory".into())
}

/// Compiler flags, separated as cargo expects them: `first`, and those that remove this machine's
/// folders from panic messages, so that builds have the same bytes everywhere.
///
/// # Errors
/// There is no home directory.
pub(crate) fn flags_without_folders(first: &str) -> Result<String, String> {
    let without = |folder: &Path| format!("--remap-path-prefix={}/=", folder.display());
    let mut flags = vec![first.to_owned(), without(&workspace())];
    for registry in fs::read_dir(cargo_home()?.join("registry/src")).into_iter().flatten().flatten()
    {
        flags.push(without(&registry.path()));
    }
    Ok(flags.join("\u{1f}"))
}

/// The message of an error with a file.
pub(crate) fn in_file(path: &Path, error: &dyn std::fmt::Display) -> String {
    format!("{}: {error}", path.display())
}

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| in_file(path, &error))
}

/// `cargo` with these arguments, split at spaces, in the workspace.
pub(crate) fn cargo(arguments: &str) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments.split_whitespace()).current_dir(workspace());
    command
}

/// `cargo xtask` with these words, in a process that has the feature `kit`.
pub(crate) fn with_kit(words: &[&str]) -> Command {
    let mut command = cargo("run --quiet --package xtask --features kit --");
    command.args(words);
    command
}

/// Gives a separate workspace the versions of the lock file at `root`. Cargo adds missing entries
/// to its copy, and removes superfluous ones.
///
/// # Errors
/// The file cannot be copied.
pub(crate) fn lock_versions(root: &Path, separate: &str) -> Result<(), String> {
    let (from, to) = (root.join("Cargo.lock"), root.join(separate).join("Cargo.lock"));
    let time = |path: &Path| fs::metadata(path).and_then(|file| file.modified()).ok();
    if time(&to) < time(&from) {
        fs::copy(&from, &to).map_err(|error| in_file(&to, &error))?;
    }
    Ok(())
}

/// The interpreter that the variable `PYTHON` names, or the system's.
pub(crate) fn python() -> Command {
    Command::new(std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into()))
}

/// The command as a person would type it.
pub(crate) fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_name().unwrap_or_default();
    let mut line = program.to_string_lossy().into_owned();
    for argument in command.get_args() {
        line.push(' ');
        line.push_str(&argument.to_string_lossy());
    }
    line
}

/// Runs a command to its end. Anything but success is an error.
pub(crate) fn run(command: &mut Command) -> Result<(), String> {
    println!("\n$ {}", shown(command));
    let status =
        command.status().map_err(|error| format!("cannot run `{}`: {error}", shown(command)))?;
    if status.success() { Ok(()) } else { Err(format!("`{}` ended with {status}", shown(command))) }
}

/// Runs a command, and returns its standard output.
pub(crate) fn output(command: &mut Command) -> Result<String, String> {
    said(command.stderr(Stdio::inherit()))
}

/// As [`output()`], with the standard error only in the message of a failure.
pub(crate) fn quiet_output(command: &mut Command) -> Result<String, String> {
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

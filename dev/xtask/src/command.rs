//! Runs programs in the workspace; each one is printed before it runs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
pub(crate) use tess_commands::command::{
    cargo, in_file, output, python, quiet_output, read, run, shown, target, workspace,
};

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

/// `cargo xtask` with these words, in a process that has the feature `pictures`.
pub(crate) fn with_pictures(words: &[&str]) -> Command {
    let mut command = cargo("run --quiet --package xtask --features pictures --");
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

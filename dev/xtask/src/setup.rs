//! Sets up the programs that commands need in addition to Rust.

mod needs;

use crate::command;
pub(crate) use needs::{ICARUS, NODE, VULKAN, XVFB, Z3};
use std::process::{Command, Stdio};
pub(crate) use tess_commands::setup::{
    NO_INSTALL, Need, PYTHON, YES, consent, has_program, installs, option, provide,
};

/// Provides everything that the tests need.
pub(crate) fn run() -> Result<(), String> {
    provide(&[needs::COMPARISONS, needs::BEYOND].concat())
}

/// Provides what the tests of `cargo xtask test` need.
pub(crate) fn for_comparisons() -> Result<(), String> {
    provide(needs::COMPARISONS)
}

/// The purpose of a need of this name that the machine lacks; `None` if it is there.
///
/// # Errors
/// There is no need of this name.
pub(crate) fn missing(name: &str) -> Result<Option<&'static str>, String> {
    let need = match name {
        "vulkan" => VULKAN,
        _ => return Err(format!("no need is called `{name}`; there is `vulkan`")),
    };
    Ok((!(need.is_there)()).then_some(need.what))
}

/// Installs a Rust toolchain (`stable`, `nightly`, `1.89.0`) if it is missing, with these parts:
/// each is a `component` or a `target`.
pub(crate) fn toolchain(name: &str, parts: &[(&str, &str)]) -> Result<(), String> {
    let mut list = rustup(&["toolchain", "list"]);
    let known = command::output(&mut list).map_err(|error| {
        format!("{error}. Toolchains other than the current one need rustup: https://rustup.rs")
    })?;
    if !known.lines().any(|line| line.starts_with(name)) {
        command::run(&mut rustup(&["toolchain", "install", name, "--profile", "minimal"]))?;
    }
    for &(word, wanted) in parts {
        let mut list = rustup(&[word, "list", "--installed", "--toolchain", name]);
        let installed = command::output(&mut list)?;
        if !installed.lines().any(|line| line.starts_with(wanted)) {
            command::run(&mut rustup(&[word, "add", "--toolchain", name, wanted]))?;
        }
    }
    Ok(())
}

/// Adds the standard library for `target` to the toolchain that runs this program.
pub(crate) fn target(target: &str) -> Result<(), String> {
    let current = std::env::var("RUSTUP_TOOLCHAIN").map_err(|_| {
        format!("the target {target} needs a compiler from rustup: https://rustup.rs")
    })?;
    toolchain(&current, &[("target", target)])
}

fn rustup(arguments: &[&str]) -> Command {
    let mut rustup = Command::new("rustup");
    rustup.args(arguments);
    rustup
}

/// Installs a cargo subcommand if it is missing; compiling it takes minutes.
pub(crate) fn subcommand(name: &str) -> Result<(), String> {
    if has_subcommand(name) {
        return Ok(());
    }
    // It is built without optimisation, because an optimised build would take longer than all of
    // its runs here.
    command::run(&mut command::cargo(&format!("install cargo-{name} --locked --debug")))
}

/// Whether `cargo NAME` is installed.
pub(crate) fn has_subcommand(name: &str) -> bool {
    command::cargo(&format!("{name} --version"))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_need_that_does_not_exist_is_an_error() {
        assert!(missing("vulkan").is_ok(), "one that exists");
        assert!(missing("vulcan").is_err_and(|error| error.contains("`vulcan`")), "it is named");
    }
}

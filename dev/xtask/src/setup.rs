//! Sets up the programs that commands need in addition to Rust.

mod needs;

use crate::command;
pub(crate) use needs::{CELLS, ICARUS, NODE, PYTHON, SYSTEMC, VERILATOR, YOSYS};
use std::path::Path;
use std::process::{Command, Stdio};

/// Something that a command needs from the system.
#[derive(Clone, Copy)]
pub(crate) struct Need {
    /// Its name, and its purpose.
    pub(crate) what: &'static str,
    /// The Debian packages that provide it.
    pub(crate) packages: &'static [&'static str],
    pub(crate) is_there: fn() -> bool,
}

/// Provides everything that the tests need.
pub(crate) fn run() -> Result<(), String> {
    provide(&[needs::COMPARISONS, needs::BEYOND].concat())
}

/// Provides what the tests of `cargo xtask test` need.
pub(crate) fn for_comparisons() -> Result<(), String> {
    provide(needs::COMPARISONS)
}

/// Installs missing programs if the system allows it.
///
/// # Errors
/// Something is missing and cannot be installed; the message tells what to install.
pub(crate) fn provide(needs: &[Need]) -> Result<(), String> {
    let missing: Vec<&Need> = needs.iter().filter(|need| !(need.is_there)()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let packages: Vec<&str> = missing.iter().flat_map(|need| need.packages).copied().collect();
    let wanted: Vec<&str> = missing.iter().map(|need| need.what).collect();
    println!("missing: {}", wanted.join("; "));
    let by_hand = format!(
        "missing: {}. On Debian or Ubuntu: sudo apt-get install {}",
        wanted.join("; "),
        packages.join(" ")
    );
    if !Path::new("/usr/bin/apt-get").exists() {
        return Err(by_hand);
    }
    install(&packages).map_err(|error| format!("{error}. {by_hand}"))?;
    match missing.iter().find(|need| !(need.is_there)()) {
        Some(need) => Err(format!("still missing after its packages are installed: {}", need.what)),
        None => Ok(()),
    }
}

fn install(packages: &[&str]) -> Result<(), String> {
    command::run(apt().arg("update").arg("-q"))?;
    command::run(apt().args(["install", "-y", "-q", "--no-install-recommends"]).args(packages))
}

/// `apt-get`, through `sudo` (which must not ask) unless this is root.
fn apt() -> Command {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|id| id.stdout == b"0\n");
    let mut command = if is_root {
        Command::new("apt-get")
    } else {
        let mut sudo = Command::new("sudo");
        sudo.args(["-n", "apt-get"]);
        sudo
    };
    command.env("DEBIAN_FRONTEND", "noninteractive");
    command
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

/// Whether a folder in `PATH` has this file.
pub(crate) fn has_program(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}

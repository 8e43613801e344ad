//! Runs `tess mesh` on model files; programs that share nothing with it judge the results:
//! tools/cli/tests/models.

use crate::command::{self, in_file, target, workspace};
use crate::explorer::npm;
use crate::setup::{self, NODE, PYTHON};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The packages of the virtual environment.
const PACKAGES: &[&str] = &["numpy>=1.24", "pillow>=10", "pygltflib>=1.16,<2", "scipy>=1.10"];

/// The viewer whose pictures of inputs and outputs are compared.
const VIEWER: &str = "f3d>=3,<5";

/// Khronos' validator for glTF files.
const VALIDATOR: &str = "gltf-validator@2.0.0-dev.3.10";

/// Judges the outputs for small models of every kind, which a script makes.
///
/// # Errors
/// A file cannot be read, an output is wrong, or the judges cannot be installed.
pub(crate) fn of_every_kind() -> Result<(), String> {
    command::run(&mut judge_made(&command::program()?)?)
}

/// Makes small models of every kind, and gives the command that judges what this program `tess`
/// makes of them.
///
/// # Errors
/// The judges cannot be installed.
pub(crate) fn judge_made(program: &Path) -> Result<Command, String> {
    let made = folder().join("made");
    if made.exists() {
        fs::remove_dir_all(&made).map_err(|error| in_file(&made, &error))?;
    }
    let mut judge = judge(program)?;
    command::run(command::python().arg(scripts().join("make.py")).arg(&made))?;
    judge.arg(&made).arg("--made");
    Ok(judge)
}

/// Judges the outputs for all models in these folders.
///
/// # Errors
/// An output is wrong, or the judges cannot be installed.
pub(crate) fn run(folders: &[&str]) -> Result<(), String> {
    let mut judge = judge(&command::program()?)?;
    let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", VIEWER];
    command::run(Command::new(python()).args(pip))?;
    command::run(judge.arg("--pictures").args(folders))
}

/// The interpreter of the virtual environment.
fn python() -> PathBuf {
    folder().join("venv/bin/python")
}

/// The command that judges what this program makes, without its folders.
fn judge(program: &Path) -> Result<Command, String> {
    setup::provide(&[PYTHON, NODE])?;
    let environment = folder().join("venv");
    let (python, done) = (python(), environment.join("done"));
    if fs::read_to_string(&done).ok().as_deref() != Some(PACKAGES.join(" ").as_str()) {
        command::run(command::python().args(["-m", "venv", "--clear"]).arg(&environment))?;
        let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
        command::run(Command::new(&python).args(pip).args(PACKAGES))?;
        fs::write(&done, PACKAGES.join(" ")).map_err(|error| in_file(&done, &error))?;
    }
    let modules = folder().join("validator");
    fs::create_dir_all(&modules).map_err(|error| in_file(&modules, &error))?;
    if !modules.join("node_modules/gltf-validator").exists() {
        command::run(npm(&modules).arg(VALIDATOR))?;
    }
    let mut judge = Command::new(python);
    judge.arg("-B").arg(scripts().join("judge.py")).arg(program).arg("--validator").arg(modules);
    Ok(judge)
}

fn scripts() -> PathBuf {
    workspace().join("tools/cli/tests/models")
}

fn folder() -> PathBuf {
    Path::new(&target()).join("models")
}

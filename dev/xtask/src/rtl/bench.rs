//! The bench of the circuit in Verilator. `rtl/dv/run` builds it; this module runs it and reads its
//! verdict.

use super::{CAPI, sources};
use crate::command::{self, cargo, in_file, target};
use crate::{install, setup};
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_testkit::verdict::BenchVerdict;

/// A program that Verilator built, and its folder.
pub(crate) struct Bench {
    program: PathBuf,
    pub(crate) folder: PathBuf,
}

/// The library that benches link, from the same build as the tests.
///
/// # Errors
/// It does not compile.
pub(crate) fn library() -> Result<PathBuf, String> {
    let mut build = cargo(CAPI);
    build.args(["--no-run", "--message-format=json-render-diagnostics"]);
    let messages = command::output(&mut build)?;
    let mut files = messages.lines().filter_map(install::artifacts).flatten();
    let found = files.find(|path| path.extension().is_some_and(|end| end == "a"));
    found.ok_or_else(|| format!("`cargo {CAPI}` builds no libtess_capi.a"))
}

impl Bench {
    /// Has `rtl/dv/run` lint the design and build the bench, with these options and in this folder
    /// of the tests' benches, so that the same sources are not compiled twice.
    ///
    /// # Errors
    /// A tool is missing, the lint warns, or a build fails.
    pub(crate) fn built(options: &[&str], folder: &str) -> Result<Self, String> {
        setup::provide(&[setup::VERILATOR])?;
        let all = target().join("tmp/rtl");
        let folder = all.join(folder);
        let mut script = Command::new(sources().join("dv/run"));
        script.args(options).arg("--build");
        script.env("TESS_LIBRARY", library()?).env("TESS_VERILOG_BUILD", &all);
        command::run(&mut script)?;
        Ok(Self { program: folder.join("Vtb_tess"), folder })
    }

    /// Writes patches, one a line, to a file of this name; the argument that has the bench read it.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(crate) fn stimuli(&self, name: &str, lines: &str) -> Result<String, String> {
        let file = self.folder.join(format!("{name}.txt"));
        std::fs::write(&file, lines).map_err(|error| in_file(&file, &error))?;
        Ok(format!("+stimuli={}", file.display()))
    }

    /// Runs the bench, which must find everything equal in at least `patches` patches; returns its
    /// output.
    ///
    /// # Errors
    /// Something differs; the error has the bench's output.
    pub(crate) fn compare(
        &self,
        arguments: &[&str],
        patches: usize,
    ) -> Result<(BenchVerdict, String), String> {
        let (succeeded, said) = output(&self.program, arguments)?;
        match BenchVerdict::read(&said, patches as u64) {
            Ok(verdict) if succeeded => Ok((verdict, said)),
            _ => Err(format!("`{}` {}:\n{said}", self.program.display(), arguments.join(" "))),
        }
    }
}

/// Runs a bench to its end; returns whether it succeeded, and its output.
pub(crate) fn output(program: &Path, arguments: &[&str]) -> Result<(bool, String), String> {
    let output = Command::new(program).args(arguments).output();
    let output = output.map_err(|error| in_file(program, &error))?;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok((output.status.success(), said + &String::from_utf8_lossy(&output.stderr)))
}

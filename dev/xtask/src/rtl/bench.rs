//! The bench of the circuit in Verilator: `rtl/dv/run` builds it, and runs here read its verdict.

use super::{lines, sources};
use crate::command::{self, cargo, in_file, target};
use crate::setup;
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_testkit::verdict::BenchVerdict;
use tess_verify::Case;

/// The program that Verilator built, and where its files lie.
pub(crate) struct Bench {
    program: PathBuf,
    pub(crate) folder: PathBuf,
}

/// The library that benches link, built with the features that the workspace's tests have.
pub(crate) fn library() -> Result<PathBuf, String> {
    command::run(&mut cargo("build --package tess-capi --lib --all-features"))?;
    Ok(target().join("debug").join("libtess_capi.a"))
}

impl Bench {
    /// Lints the design and builds the bench.
    ///
    /// # Errors
    /// A tool is missing, the lint warns, or a build fails.
    pub(crate) fn built() -> Result<Self, String> {
        setup::provide(&[setup::VERILATOR])?;
        let folder = target().join("rtl");
        let mut script = Command::new(sources().join("dv/run"));
        script.arg("--build").env("TESS_LIBRARY", library()?).env("TESS_VERILOG_BUILD", &folder);
        command::run(&mut script)?;
        Ok(Self { program: folder.join("Vtb_tess"), folder })
    }

    /// Writes cases to a file of this name, and gives the argument that has the bench read it.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(crate) fn stimuli(&self, name: &str, cases: &[Case]) -> Result<String, String> {
        let file = self.folder.join(format!("{name}.txt"));
        std::fs::write(&file, lines(cases)).map_err(|error| in_file(&file, &error))?;
        Ok(format!("+stimuli={}", file.display()))
    }

    /// Runs the bench, which must find everything equal, at least so many `patches`; gives what it printed too.
    ///
    /// # Errors
    /// Something differs: what the bench printed.
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

/// Runs a bench to its end, whatever that is: whether it succeeded, and what it printed.
pub(crate) fn output(program: &Path, arguments: &[&str]) -> Result<(bool, String), String> {
    let output = Command::new(program).args(arguments).output();
    let output = output.map_err(|error| in_file(program, &error))?;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok((output.status.success(), said + &String::from_utf8_lossy(&output.stderr)))
}

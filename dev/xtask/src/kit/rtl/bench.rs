//! The bench of the circuit in Verilator: `rtl/dv/run` builds it, and runs here read its verdict.

use super::{lines, sources};
use crate::command::{self, cargo, in_file, target};
use crate::setup;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_verify::Case;

/// The program that Verilator built, and where its files lie.
pub(crate) struct Bench {
    program: PathBuf,
    pub(crate) folder: PathBuf,
}

/// What a run compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Verdict {
    pub(crate) patches: u64,
    pub(crate) points: u64,
    pub(crate) primitives: u64,
    pub(crate) clocks: u64,
}

impl Verdict {
    /// The verdict in what a bench prints: equal, and the tally before it.
    fn read(said: &str) -> Option<Self> {
        let tally = said.lines().find_map(|line| line.strip_suffix(" clocks, 0 mismatches"))?;
        let passed = said.lines().any(|line| line == "PASS");
        let number = |word: &str| word.split(' ').next()?.parse::<u64>().ok();
        let numbers: Vec<u64> = tally.split(", ").filter_map(number).collect();
        match numbers[..] {
            [patches, points, primitives, clocks] if passed => {
                Some(Self { patches, points, primitives, clocks })
            }
            _ => None,
        }
    }

    /// Whether at least so many patches were compared.
    ///
    /// # Errors
    /// Fewer were.
    pub(crate) fn demand(&self, patches: u64) -> Result<(), String> {
        if self.patches >= patches {
            return Ok(());
        }
        Err(format!("the bench compared {} patches, not {patches}", self.patches))
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { patches, points, primitives, clocks } = self;
        write!(
            f,
            "{patches} patches, {points} points, {primitives} primitives equal, in {clocks} clocks"
        )
    }
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

    /// Runs the bench to its end, whatever that is; gives what it printed.
    ///
    /// # Errors
    /// It cannot be run.
    pub(crate) fn output(&self, arguments: &[&str]) -> Result<(bool, String), String> {
        output(&self.program, arguments)
    }

    /// Runs the bench, which must find everything equal.
    ///
    /// # Errors
    /// Something differs: what the bench printed.
    pub(crate) fn compare(&self, arguments: &[&str]) -> Result<Verdict, String> {
        self.compare_aloud(arguments).map(|(verdict, _)| verdict)
    }

    /// As [`Self::compare`], with what the bench printed.
    ///
    /// # Errors
    /// As for [`Self::compare`].
    pub(crate) fn compare_aloud(&self, arguments: &[&str]) -> Result<(Verdict, String), String> {
        let (succeeded, said) = self.output(arguments)?;
        match Verdict::read(&said).filter(|_| succeeded) {
            Some(verdict) => Ok((verdict, said)),
            None => Err(format!("`{}` {}:\n{said}", self.program.display(), arguments.join(" "))),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_needs_the_tally_and_pass() {
        let tally = "7 patches, 60 points, 50 primitives, 90 clocks, 0 mismatches";
        let expected = Verdict { patches: 7, points: 60, primitives: 50, clocks: 90 };
        assert_eq!(Verdict::read(&format!("{tally}\nPASS\n")), Some(expected), "equal");
        assert_eq!(Verdict::read(tally), None, "without PASS");
        let different = tally.replace(", 0 mism", ", 3 mism");
        assert_eq!(Verdict::read(&format!("{different}\nPASS\n")), None, "mismatches");
        assert!(expected.demand(7).is_ok() && expected.demand(8).is_err(), "fewer patches");
    }
}

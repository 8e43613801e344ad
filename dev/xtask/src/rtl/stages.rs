//! Compares single stages for every input of a range: context and place by factor, factor
//! processing by binary32 pattern.

use super::bench::{library, output};
use super::sources;
use crate::command;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The factors from 1 to 64 in 15.16.
const FACTORS: Range<u32> = 0x1_0000..0x40_0001;
/// The binary32 patterns of the binades from 1 to 64.
const BINADES: Range<u32> = 0x3F80_0000..0x4280_0000;

/// The inputs of one run of the bench.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Inputs {
    /// 15.16 factors: the first one, and their number.
    Factors(u32, u32),
    /// binary32 patterns: the first one, and their number.
    Words(u32, u32),
}

impl Inputs {
    fn arguments(self) -> [String; 2] {
        match self {
            Self::Factors(first, count) => [format!("+first={first}"), format!("+factors={count}")],
            Self::Words(first, count) => [format!("+bits={first:x}"), format!("+words={count}")],
        }
    }
}

/// Every input, in ranges that take about a minute each.
pub(crate) fn all() -> Vec<Inputs> {
    let cut = |range: Range<u32>, size: u32| {
        let end = range.end;
        range.step_by(size as usize).map(move |first| (first, size.min(end - first)))
    };
    let words = cut(BINADES, 1 << 20).map(|(first, count)| Inputs::Words(first, count));
    words.chain(cut(FACTORS, 1 << 16).map(|(first, count)| Inputs::Factors(first, count))).collect()
}

/// The bench of the stages.
pub(crate) struct Stages(PathBuf);

impl Stages {
    /// Builds the bench in a folder below this one.
    ///
    /// # Errors
    /// Verilator fails.
    pub(crate) fn built(folder: &Path) -> Result<Self, String> {
        let mut script = Command::new(sources().join("dv/run"));
        script.args(["--stages", "--build"]);
        script.env("TESS_LIBRARY", library()?).env("TESS_VERILOG_BUILD", folder);
        command::run(&mut script)?;
        Ok(Self(folder.join("stages/Vtb_stages")))
    }

    /// Compares a range, and returns a description of what was compared.
    ///
    /// # Errors
    /// Something differs; the error has the bench's output.
    pub(crate) fn compare(&self, inputs: Inputs) -> Result<String, String> {
        let arguments = inputs.arguments();
        let (succeeded, said) = output(&self.0, &arguments.each_ref().map(String::as_str))?;
        let tally = said.lines().find(|line| line.ends_with(", 0 mismatches"));
        match tally.filter(|_| succeeded && said.lines().any(|line| line == "PASS")) {
            Some(tally) => Ok(format!("stages {}: {tally}", arguments.join(" "))),
            None => Err(format!("{} {}:\n{said}", self.0.display(), arguments.join(" "))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_cover_every_input_once() {
        let (mut factors, mut words) = (FACTORS.start, BINADES.start);
        for inputs in all() {
            let (next, first, count) = match inputs {
                Inputs::Factors(first, count) => (&mut factors, first, count),
                Inputs::Words(first, count) => (&mut words, first, count),
            };
            assert_eq!(*next, first, "no gap");
            *next += count;
        }
        assert_eq!((factors, words), (FACTORS.end, BINADES.end), "to the ends");
    }
}

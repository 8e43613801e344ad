//! Compares single stages for every input of a range: context and place by factor, factor
//! processing by binary32 pattern.

use crate::bench;
use crate::tools::{output, said};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_commands::command;

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

impl Inputs {
    /// The line with which the bench ends when everything is equal.
    fn tally(self) -> String {
        let (contexts, places, words) = match self {
            // Two places of the factor, with a frame and without, in four partitionings.
            Self::Words(_, count) => (0, 0, 16 * u64::from(count)),
            Self::Factors(first, count) => {
                let factors = first..first + count;
                let points: Vec<u64> = factors.flat_map(points).collect();
                // Both split orders.
                (2 * points.len() as u64, 2 * points.iter().sum::<u64>(), 0)
            }
        };
        format!("{contexts} contexts, {places} places, {words} processed factors, 0 mismatches")
    }
}

/// The points of an edge with this 15.16 factor, for each parity that the factor may have
/// (sections 3 and 14.1).
fn points(factor: u32) -> impl Iterator<Item = u64> {
    const ONE: u32 = 1 << 16;
    let points = move |is_odd: bool| {
        let half = factor.div_ceil(2) + if is_odd || factor == ONE { ONE / 2 } else { 0 };
        u64::from(2 * half.div_ceil(ONE)) + u64::from(!is_odd)
    };
    let even = (factor == ONE || factor >= 2 * ONE).then(|| points(false));
    even.into_iter().chain((factor <= 63 * ONE).then(|| points(true)))
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
        command::run(bench::script(folder)?.args(["--stages", "--build"]))?;
        Ok(Self(folder.join("stages/Vtb_stages")))
    }

    /// Compares a range, and returns a description of what was compared.
    ///
    /// # Errors
    /// Something differs; the error has the bench's output.
    pub(crate) fn compare(&self, inputs: Inputs) -> Result<String, String> {
        let arguments = inputs.arguments();
        let output = output(Command::new(&self.0).args(&arguments))?;
        let said = said(&output);
        let tally = inputs.tally();
        let says = |expected: &str| said.lines().any(|line| line == expected);
        match output.status.success() && says(&tally) && says("PASS") {
            true => Ok(format!("stages {}: {tally}", arguments.join(" "))),
            false => Err(format!(
                "{} {}: not said `{tally}`:\n{said}",
                self.0.display(),
                arguments.join(" ")
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tallies_are_those_of_the_bench() {
        for (inputs, tally) in [
            (Inputs::Factors(0x1_0000, 128), "258 contexts, 1026 places, 0 processed factors"),
            (Inputs::Factors(0x3E_FFC0, 128), "386 contexts, 24960 places, 0 processed factors"),
            (Inputs::Words(0x3F80_0000, 4096), "0 contexts, 0 places, 65536 processed factors"),
        ] {
            assert_eq!(inputs.tally(), format!("{tally}, 0 mismatches"), "{inputs:?}");
        }
    }

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

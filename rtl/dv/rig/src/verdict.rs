//! The verdict of the circuit's bench, read from its output.

use std::fmt;

/// The numbers of elements that a run compared and found equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BenchVerdict {
    pub(crate) patches: u64,
    pub(crate) points: u64,
    pub(crate) primitives: u64,
    pub(crate) clocks: u64,
}

impl BenchVerdict {
    /// Reads the tally from a bench's output, which must also have the line `PASS`.
    ///
    /// # Errors
    /// Something differs, or fewer than `patches` were compared.
    pub(crate) fn read(said: &str, patches: u64) -> Result<Self, String> {
        let tally = said.lines().find_map(|line| line.strip_suffix(" clocks, 0 mismatches"));
        let number = |word: &str| word.split(' ').next()?.parse::<u64>().ok();
        let numbers: Vec<u64> = tally.unwrap_or_default().split(", ").filter_map(number).collect();
        match numbers[..] {
            [compared, points, primitives, clocks]
                if compared >= patches && said.lines().any(|line| line == "PASS") =>
            {
                Ok(Self { patches: compared, points, primitives, clocks })
            }
            _ => Err(format!("not said that {patches} patches are equal:\n{said}")),
        }
    }
}

impl fmt::Display for BenchVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { patches, points, primitives, clocks } = self;
        write!(
            f,
            "{patches} patches, {points} points, {primitives} primitives equal, in {clocks} clocks"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_needs_the_tally_and_pass() {
        let tally = "7 patches, 60 points, 50 primitives, 90 clocks, 0 mismatches";
        let expected = BenchVerdict { patches: 7, points: 60, primitives: 50, clocks: 90 };
        let said = format!("{tally}\nPASS\n");
        assert_eq!(BenchVerdict::read(&said, 7), Ok(expected), "equal");
        assert!(BenchVerdict::read(&said, 8).is_err(), "fewer patches");
        assert!(BenchVerdict::read(tally, 7).is_err(), "without PASS");
        let different = said.replace(", 0 mism", ", 3 mism");
        assert!(BenchVerdict::read(&different, 7).is_err(), "mismatches");
    }
}

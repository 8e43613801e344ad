//! CPU levels: the sets of instructions that the kernels are compiled for.

use core::fmt;

/// A set of CPU instructions that the kernels are compiled for. All levels give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Level {
    /// The instructions that the crate was compiled for; always available.
    Baseline,
    /// AVX2 on x86-64.
    Avx2,
    /// AVX-512 on x86-64, as in processors since Ice Lake and Zen 4.
    Avx512,
}

impl Level {
    /// Every level, from the least to the most capable.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// The name that `Display` gives: `baseline`, `avx2` or `avx512`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// This machine, or this build, cannot run a CPU level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelUnavailableError(pub Level);

impl fmt::Display for LevelUnavailableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "this machine cannot run the CPU level {}", self.0)
    }
}

impl core::error::Error for LevelUnavailableError {}

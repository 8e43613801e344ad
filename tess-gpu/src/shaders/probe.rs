//! The WGSL of single steps, for comparing them with the golden model's.

use super::files;
use crate::setup::Setup;

/// A shader that runs one step alone, for comparing it with the golden model's. Binding 0 is what
/// goes in, 1 what comes out, 2 the [`crate::tables`]; the entry point is `probes`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Probe {
    /// Four words of a triangle patch's factors to its fixed-point u = 0 and inside factors.
    Factors,
    /// A 15.16 factor and its parity (1 is odd) to its packed context.
    Contexts,
    /// A packed context to 65 words of locations, as many of them written as it has points.
    Locations,
}

impl Probe {
    /// Every probe.
    pub const ALL: [Self; 3] = [Self::Factors, Self::Contexts, Self::Locations];

    /// Words of input and of output of one probe.
    #[must_use]
    pub const fn words(self) -> (u32, u32) {
        match self {
            Self::Factors => (4, 2),
            Self::Contexts => (2, 2),
            Self::Locations => (2, 65),
        }
    }

    /// Its WGSL, a whole module.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let file = match self {
            Self::Factors => "probe_factors",
            Self::Contexts => "probe_contexts",
            Self::Locations => "probe_locations",
        };
        setup.prelude() + &files::joined("probe", &[("probe", file)])
    }
}

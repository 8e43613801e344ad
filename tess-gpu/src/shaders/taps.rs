//! Stage taps: the WGSL of single stages. Tests compare their values with the golden model's.

use super::files;
use crate::setup::Setup;

/// A shader that runs a single stage, so that its values can be compared with the golden model's.
///
/// The entry point is `taps`. Binding 0 is the input, binding 1 the output, binding 2 the
/// [`crate::tables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Tap {
    /// Input: the four factors of a triangle patch. Output: its fixed-point u = 0 and inside
    /// factors.
    Factors,
    /// Input: a 15.16 factor and its parity (1 is odd). Output: its packed context.
    Contexts,
    /// Input: a packed context. Output: 65 words for locations, of which those of the context's
    /// points are written.
    Locations,
}

impl Tap {
    /// Every tap.
    pub const ALL: [Self; 3] = [Self::Factors, Self::Contexts, Self::Locations];

    /// Words of input and of output of one value.
    #[must_use]
    pub const fn words(self) -> (u32, u32) {
        match self {
            Self::Factors => (4, 2),
            Self::Contexts => (2, 2),
            Self::Locations => (2, 65),
        }
    }

    /// The tap's WGSL, a whole module.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let file = match self {
            Self::Factors => "taps/factors",
            Self::Contexts => "taps/contexts",
            Self::Locations => "taps/locations",
        };
        setup.prelude() + &files::joined(&["taps/tap"], &[("tap", file)])
    }
}

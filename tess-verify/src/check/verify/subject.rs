//! The subjects of a comparison.

use crate::names::Named;

/// A set of cases or values to compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Subject {
    /// The generated level 1.
    Level1,
    /// The cases of the generated level 2 that are not in level 1.
    Level2,
    /// All 2^32 binary32 factors, as outer and as inside factor, in every partitioning.
    Factors,
    /// All fixed-point factors: their contexts and locations, in both parities and split orders.
    Locations,
    /// All pairs of an outer and an inside factor, in both split orders.
    Transitions,
    /// All pairs of inside factors, and all isolines.
    Interiors,
    /// Random patches in every configuration of domain, partitioning, output and split order.
    ///
    /// Each unit has its own seed, so a run with more patches includes those of a run with fewer.
    Random {
        /// The number of patches per configuration.
        patches: u64,
        /// The seed of all patches.
        seed: u64,
    },
}

impl Subject {
    /// Every finite subject, the fastest first.
    pub const ALL: [Self; 6] = [
        Self::Level1,
        Self::Transitions,
        Self::Interiors,
        Self::Level2,
        Self::Locations,
        Self::Factors,
    ];
}

impl Named for Subject {
    const WHAT: &'static str = "subject";
    const NAMES: &'static [(&'static str, Self)] = &[
        ("level-1", Self::Level1),
        ("level-2", Self::Level2),
        ("factors", Self::Factors),
        ("locations", Self::Locations),
        ("transitions", Self::Transitions),
        ("interiors", Self::Interiors),
    ];

    fn name(self) -> &'static str {
        let finite = Self::NAMES.iter().find(|(_, subject)| *subject == self);
        finite.map_or("random", |(name, _)| name)
    }
}

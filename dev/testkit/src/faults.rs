//! Planted faults: a backend with one fault, which a comparison must notice.
//!
//! Faults of whole patches are mistakes of `tess_verify::mistakes`; the stages have faults of their
//! own.

mod faulty;

pub use faulty::Faulty;

use tess_verify::mistakes::{Mistake, named, of_one_element};

/// A fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A mistake in the answer for one patch.
    Patch(&'static Mistake),
    /// The answer has one patch, factor or context too few.
    ShortAnswer,
    /// The lowest bit of an edge's factor.
    OuterFactor,
    /// The lowest bit of an inside factor.
    InsideFactor,
    /// The lowest bit of a field of a context; parity is inverted.
    Context(ContextField),
    /// The lowest bit of the last location.
    LastLocation,
    /// The first and the last location are exchanged.
    SwappedLocations,
    /// The last location is missing.
    DroppedLocation,
}

/// A field of a context.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContextField {
    /// Parity.
    Parity,
    /// Reciprocal of the coarser subdivision.
    InvFloor,
    /// Reciprocal of the finer subdivision.
    InvCeil,
    /// Weight of the finer subdivision.
    Fraction,
    /// Points on a half edge.
    HalfPoints,
    /// The position that splits.
    Split,
    /// Points on the edge.
    Points,
}

impl Fault {
    /// Faults of factor processing.
    pub const OF_FACTORS: [Self; 3] = [Self::OuterFactor, Self::InsideFactor, Self::ShortAnswer];
    /// Faults of contexts.
    pub const OF_CONTEXTS: [Self; 8] = [
        Self::Context(ContextField::Parity),
        Self::Context(ContextField::InvFloor),
        Self::Context(ContextField::InvCeil),
        Self::Context(ContextField::Fraction),
        Self::Context(ContextField::HalfPoints),
        Self::Context(ContextField::Split),
        Self::Context(ContextField::Points),
        Self::ShortAnswer,
    ];
    /// Faults of locations.
    pub const OF_LOCATIONS: [Self; 3] =
        [Self::LastLocation, Self::SwappedLocations, Self::DroppedLocation];

    /// Faults of whole patches: one wrong, missing or additional element, or a lost answer.
    #[must_use]
    pub fn of_patches() -> Vec<Self> {
        of_one_element().map(Self::Patch).chain([Self::ShortAnswer]).collect()
    }

    /// The mistake with these words.
    ///
    /// # Panics
    /// If the table of mistakes has none.
    #[must_use]
    pub fn patch(words: &str) -> Self {
        Self::Patch(named(words).unwrap_or_else(|| panic!("{words}: not in the table of mistakes")))
    }

    /// The last index is one too high.
    ///
    /// # Panics
    /// As [`Fault::patch`].
    #[must_use]
    pub fn last_index() -> Self {
        Self::patch("the last index is one too high")
    }

    /// Whether it damages whole patches.
    const fn is_of_patches(self) -> bool {
        matches!(self, Self::Patch(_) | Self::ShortAnswer)
    }
}

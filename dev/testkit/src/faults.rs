//! Planted faults: a backend with one fault, which a comparison must notice.

mod faulty;

pub use faulty::Faulty;

/// A fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The lowest bit of the first point's u.
    PointU,
    /// The highest bit of the first point's v.
    PointV,
    /// The lowest bit of the last point's v.
    LastPoint,
    /// The first and the last point are exchanged.
    SwappedPoints,
    /// The last point is missing.
    DroppedPoint,
    /// There is one point too many, at the place of another.
    ExtraPoint,
    /// There is one point too many, outside every domain.
    StrayPoint,
    /// The first and the last index are exchanged.
    SwappedIndices,
    /// The last index is one too high.
    LastIndex,
    /// The last index is missing.
    DroppedIndex,
    /// There is one index too many.
    ExtraIndex,
    /// A patch is answered as culled.
    EmptyPatch,
    /// A patch has the output of the one before it in the batch.
    RepeatedPatch,
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
    /// Faults of whole patches.
    pub const OF_PATCHES: [Self; 14] = [
        Self::PointU,
        Self::PointV,
        Self::LastPoint,
        Self::SwappedPoints,
        Self::DroppedPoint,
        Self::ExtraPoint,
        Self::StrayPoint,
        Self::SwappedIndices,
        Self::LastIndex,
        Self::DroppedIndex,
        Self::ExtraIndex,
        Self::EmptyPatch,
        Self::RepeatedPatch,
        Self::ShortAnswer,
    ];
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
}

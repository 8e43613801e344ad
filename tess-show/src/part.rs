//! The parts of a patch that can be explained and compared.

use std::fmt;

/// A part of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Part {
    /// The whole patch: its counts.
    Patch,
    /// A factor, by its number in the order of the specification.
    Factor(u32),
    /// A domain point.
    Point(u32),
    /// A primitive.
    Primitive(u32),
}

/// For example `factor 3`.
impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Patch => f.write_str("patch"),
            Self::Factor(k) => write!(f, "factor {k}"),
            Self::Point(i) => write!(f, "point {i}"),
            Self::Primitive(t) => write!(f, "primitive {t}"),
        }
    }
}

//! A difference: the element, its two values, and the stage of the specification that it points to.

use crate::names::{Named, named};
use std::fmt;
use tess_core::FixedFactor;

named! {
    /// A stage of processing to which a difference can be traced back; in the order of processing.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    #[non_exhaustive]
    pub enum SpecStage: "stage" {
        /// Factor preparation (spec section 9).
        Preparation = "preparation",
        /// Factor processing (spec section 3).
        Factors = "factors",
        /// Factor contexts (spec section 4).
        Context = "context",
        /// Numbers of points and indices (spec section 12.6).
        Counts = "counts",
        /// Placing of points (spec sections 5 and 6).
        Location = "location",
        /// The right points in another order (spec section 6).
        PointOrder = "point order",
        /// Connectivity (spec sections 7 and 8).
        Stitch = "stitch",
        /// The case answered is not the case asked.
        Answer = "answer",
        /// A digest over whole patches differs, although every element agrees with the model's.
        Unknown = "unknown, every element is the model's",
    }
}

impl fmt::Display for SpecStage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One element of a result.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Element {
    /// A number of elements, such as `points`.
    Count(&'static str),
    /// A coordinate, `u` or `v`, of a domain point.
    Point {
        /// The number of the point.
        index: usize,
        /// `u` or `v`.
        coordinate: &'static str,
    },
    /// One index of a primitive.
    Index {
        /// The number of the primitive.
        primitive: usize,
        /// The position in the primitive, from 0.
        position: usize,
    },
    /// The third coordinate of a vertex.
    Third {
        /// The number of the primitive.
        primitive: usize,
        /// The position in the primitive, from 0.
        position: usize,
    },
    /// The case that a record answers.
    Case,
    /// The record that answers a case.
    Record,
    /// A field of a factor's context.
    Context {
        /// The factor.
        factor: FixedFactor,
        /// The name of the field.
        field: &'static str,
    },
    /// The location of a factor's point.
    Location {
        /// The factor.
        factor: FixedFactor,
        /// The number of the point.
        p: usize,
    },
    /// A processed factor of the triangle patch (x, 3, 3; x).
    Factor {
        /// The bits of the raw factor x.
        x: u32,
        /// `outer` or `inside`.
        role: &'static str,
    },
    /// A prepared factor.
    Prepared {
        /// `unrounded` or `rounded`.
        result: &'static str,
        /// The name of the factor.
        factor: &'static str,
    },
    /// Where the order is free: a point, or a primitive by its vertices, as 16.16 bits of u and v.
    Vertices(Vec<[u32; 2]>),
    /// The fixed-point number of the binary32 factor with these bits.
    Conversion(u32),
    /// A digest that differs although every element agrees with the model's.
    Digest(&'static str),
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(what) => write!(f, "number of {what}"),
            Self::Point { index, coordinate } => write!(f, "point {index} {coordinate}"),
            Self::Index { primitive, position } => {
                write!(f, "index {position} of primitive {primitive}")
            }
            Self::Third { primitive, position } => {
                write!(f, "third coordinate of vertex {position} of primitive {primitive}")
            }
            Self::Case => f.write_str("case that is answered"),
            Self::Record => f.write_str("record"),
            Self::Context { factor, field } => {
                write!(f, "{field} of the context of factor 0x{:06x}", factor.to_bits())
            }
            Self::Location { factor, p } => {
                write!(f, "location {p} of factor 0x{:06x}", factor.to_bits())
            }
            Self::Factor { x, role } => write!(f, "{role} factor from 0x{x:08x}"),
            Self::Prepared { result, factor } => write!(f, "{result} {factor}"),
            Self::Vertices(vertices) => {
                f.write_str(if vertices.len() == 1 { "point" } else { "primitive" })?;
                vertices.iter().try_for_each(|[u, v]| write!(f, " ({u:05x}, {v:05x})"))
            }
            Self::Conversion(bits) => write!(f, "fixed-point number of factor 0x{bits:08x}"),
            Self::Digest(what) => write!(f, "digest of the {what}"),
        }
    }
}

/// The first difference between two results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// The first element that differs.
    pub element: Element,
    /// The implementation's value, in hex (counts in decimal), or `none`.
    pub observed: String,
    /// The right value.
    pub expected: String,
    /// The stage that the difference points to.
    pub stage: SpecStage,
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { element, observed, expected, stage } = self;
        write!(f, "{element}: observed {observed}, expected {expected} (stage: {stage})")
    }
}

impl Mismatch {
    /// A difference of two numbers, shown with at least `digits` hex digits.
    pub(crate) fn hex(
        element: Element,
        digits: usize,
        observed: impl Into<u64>,
        expected: impl Into<u64>,
        stage: SpecStage,
    ) -> Self {
        let show = |number: u64| format!("0x{number:0digits$x}");
        let (observed, expected) = (show(observed.into()), show(expected.into()));
        Self { element, observed, expected, stage }
    }

    /// A difference of two counts.
    pub(crate) fn count(what: &'static str, observed: u64, expected: u64) -> Option<Self> {
        (observed != expected).then(|| Self {
            element: Element::Count(what),
            observed: observed.to_string(),
            expected: expected.to_string(),
            stage: SpecStage::Counts,
        })
    }

    /// A difference of two digests.
    pub(crate) fn digest(
        what: &'static str,
        observed: u64,
        expected: u64,
        stage: SpecStage,
    ) -> Option<Self> {
        let mismatch = || Self::hex(Element::Digest(what), 16, observed, expected, stage);
        (observed != expected).then(mismatch)
    }
}

//! Exact comparison: the first element in which two results differ, and the stage it points to.

use crate::case::Case;
use crate::vectors::primitive_size;
use std::fmt;
use tess_core::{DomainPoint, FactorContext, FixedFactor, Tessellation};

/// A stage on a patch's way, as far as a difference can be traced back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Factor preparation (spec section 9).
    Preparation,
    /// Factor processing (spec section 3).
    Factors,
    /// Factor contexts (spec section 4).
    Context,
    /// Numbers of points and indices (spec section 12.6).
    Counts,
    /// Placing of points (spec sections 5 and 6).
    Location,
    /// The right points in another order (spec section 6).
    PointOrder,
    /// Connectivity (spec sections 7 and 8).
    Stitch,
    /// A digest over whole patches differs, every element of which is the model's.
    Unknown,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Preparation => "preparation",
            Self::Factors => "factors",
            Self::Context => "context",
            Self::Counts => "counts",
            Self::Location => "location",
            Self::PointOrder => "point order",
            Self::Stitch => "stitch",
            Self::Unknown => "unknown, every element is the model's",
        })
    }
}

/// One element of a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Element {
    /// A number of elements, such as `points`.
    Count(&'static str),
    /// A coordinate, `u` or `v`, of a domain point.
    Point {
        /// Number of the point.
        index: usize,
        /// `u` or `v`.
        coordinate: &'static str,
    },
    /// One index of a primitive.
    Index {
        /// Number of the primitive.
        primitive: usize,
        /// Position in the primitive, from 0.
        position: usize,
    },
    /// A field of a factor's context.
    Context {
        /// The factor.
        factor: FixedFactor,
        /// Name of the field.
        field: &'static str,
    },
    /// The location of a factor's point.
    Location {
        /// The factor.
        factor: FixedFactor,
        /// Number of the point.
        p: usize,
    },
    /// A processed factor of the triangle patch (x, 3, 3; x).
    Factor {
        /// Bits of the raw factor x.
        x: u32,
        /// `outer` or `inside`.
        role: &'static str,
    },
    /// A prepared factor.
    Prepared {
        /// `unrounded` or `rounded`.
        result: &'static str,
        /// Name of the factor.
        factor: &'static str,
    },
    /// A point, or a primitive by its vertices, where the order is free: 16.16 bits of u and v.
    Vertices(Vec<[u32; 2]>),
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
            Self::Digest(what) => write!(f, "digest of the {what}"),
        }
    }
}

/// The first difference between two results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// The first element that differs.
    pub element: Element,
    /// What an implementation gave there, in hex (counts in decimal), or `none`.
    pub observed: String,
    /// What is right there.
    pub expected: String,
    /// The stage that the difference points to.
    pub stage: Stage,
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
        stage: Stage,
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
            stage: Stage::Counts,
        })
    }

    /// A difference of two digests.
    pub(crate) fn digest(
        what: &'static str,
        observed: u64,
        expected: u64,
        stage: Stage,
    ) -> Option<Self> {
        let mismatch = || Self::hex(Element::Digest(what), 16, observed, expected, stage);
        (observed != expected).then(mismatch)
    }
}

/// The first difference between two outputs of a case: counts, then points, then indices.
#[must_use]
pub fn tessellations(
    case: &Case,
    observed: &Tessellation,
    expected: &Tessellation,
) -> Option<Mismatch> {
    let size = primitive_size(case);
    count("points", &observed.points, &expected.points)
        .or_else(|| count("indices", &observed.indices, &expected.indices))
        .or_else(|| points(&observed.points, &expected.points))
        .or_else(|| indices(size, &observed.indices, &expected.indices))
}

/// The first difference between the points of two outputs, whatever their indices.
#[must_use]
pub fn points_alone(observed: &Tessellation, expected: &Tessellation) -> Option<Mismatch> {
    count("points", &observed.points, &expected.points)
        .or_else(|| points(&observed.points, &expected.points))
}

fn count<T>(what: &'static str, observed: &[T], expected: &[T]) -> Option<Mismatch> {
    Mismatch::count(what, observed.len() as u64, expected.len() as u64)
}

fn points(observed: &[DomainPoint], expected: &[DomainPoint]) -> Option<Mismatch> {
    let index =
        observed.iter().zip(expected).position(|(observed, expected)| observed != expected)?;
    let same_set = sorted(observed) == sorted(expected);
    let stage = if same_set { Stage::PointOrder } else { Stage::Location };
    let (observed, expected) = (observed[index], expected[index]);
    let (coordinate, observed, expected) = if observed.u == expected.u {
        ("v", observed.v, expected.v)
    } else {
        ("u", observed.u, expected.u)
    };
    let element = Element::Point { index, coordinate };
    Some(Mismatch::hex(element, 5, observed.to_bits(), expected.to_bits(), stage))
}

fn sorted(points: &[DomainPoint]) -> Vec<(u32, u32)> {
    let mut bits: Vec<_> = points.iter().map(|p| (p.u.to_bits(), p.v.to_bits())).collect();
    bits.sort_unstable();
    bits
}

fn indices(size: usize, observed: &[u32], expected: &[u32]) -> Option<Mismatch> {
    let at = observed.iter().zip(expected).position(|(observed, expected)| observed != expected)?;
    let element = Element::Index { primitive: at / size, position: at % size };
    Some(Mismatch::hex(element, 1, observed[at], expected[at], Stage::Stitch))
}

/// The first difference between contexts of `factors`, all three lists being equally long.
#[must_use]
pub fn contexts(
    factors: &[FixedFactor],
    observed: &[FactorContext],
    expected: &[FactorContext],
) -> Option<Mismatch> {
    let of_one = |((&factor, observed), expected): ((&FixedFactor, _), _)| {
        let fields = context_fields(observed).into_iter().zip(context_fields(expected));
        let mut different = fields.filter(|(observed, expected)| observed != expected);
        different.next().map(|((field, observed), (_, expected))| {
            let element = Element::Context { factor, field };
            Mismatch::hex(element, 1, observed, expected, Stage::Context)
        })
    };
    factors.iter().zip(observed).zip(expected).find_map(of_one)
}

/// The fields of a context by name, parity as 1 for odd.
#[must_use]
pub fn context_fields(context: &FactorContext) -> [(&'static str, u32); 7] {
    [
        ("parity", context.parity.odd()),
        ("inv_floor", context.inv_floor),
        ("inv_ceil", context.inv_ceil),
        ("fraction", context.fraction),
        ("half_points", context.half_points),
        ("split", context.split),
        ("points", context.points),
    ]
}

/// The first difference between the locations of contexts, which belong to `factors`.
#[must_use]
pub fn locations(
    factors: &[FixedFactor],
    contexts: &[FactorContext],
    observed: &[u32],
    expected: &[u32],
) -> Option<Mismatch> {
    let count = Mismatch::count("locations", observed.len() as u64, expected.len() as u64);
    count.or_else(|| {
        let at = observed.iter().zip(expected).position(|(o, e)| o != e)?;
        let mut before = 0;
        for (&factor, context) in factors.iter().zip(contexts) {
            let p = at - before;
            if p < context.points as usize {
                let element = Element::Location { factor, p };
                return Some(Mismatch::hex(
                    element,
                    5,
                    observed[at],
                    expected[at],
                    Stage::Location,
                ));
            }
            before += context.points as usize;
        }
        None
    })
}

/// The first difference between processed factors of the raw factors `values`.
#[must_use]
pub fn fixed_factors(
    values: &[f32],
    observed: &[[FixedFactor; 2]],
    expected: &[[FixedFactor; 2]],
) -> Option<Mismatch> {
    let at = observed.iter().zip(expected).position(|(o, e)| o != e)?;
    let (role, which) =
        if observed[at][0] == expected[at][0] { ("inside", 1) } else { ("outer", 0) };
    let element = Element::Factor { x: values[at].to_bits(), role };
    let [observed, expected] = [observed, expected].map(|factors| factors[at][which].to_bits());
    Some(Mismatch::hex(element, 6, observed, expected, Stage::Factors))
}

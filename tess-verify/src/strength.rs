//! How closely another implementation must agree with the model (spec section 13).
//!
//! The model is exact, but the public specification leaves hardware some freedom. [`Strength`]
//! selects which freedoms count as equal. `check::device` compares each answer of a device at a
//! strength, and [`super::Explainer`] tries weaker ones to explain a difference.
//!
//! ```text
//!  case ──► Alternatives ──► cases with each legal conversion ──► model ──► expected outputs
//!           (conversions.rs)  choice 0 is the model's own                        │
//!  observed output ───────────────────────────────► Strength::equal ◄────────────┘
//!                                                    (order, elements; unordered.rs)
//!                 ──► Conversions: which of the choices explain the output
//!                 ──► check::consistency: one choice for each value through the whole file
//! ```
//!
//! # A worked patch
//!
//! The quad below has one outer factor of 3 + 2^-17. Multiplied by 65536 that is 196608.5, halfway
//! between `0x30000` and `0x30001`. The model takes the even number; a device that converts within
//! 0.6 units may take either.
//!
//! ```
//! use tess_verify::Case;
//! use tess_verify::check::{Conversion, ListOrder, Strength};
//!
//! let quad = |u0| format!("case quad fractional_odd triangle_cw ruler {u0} 40200000 40a00000 40500000 40900000 40d00000");
//! let case: Case = quad("40400020").parse()?; // 3 + 2^-17
//! let above: Case = quad("40400040").parse()?; // 3 + 2^-16, which is 0x30001
//!
//! // A device that rounds up and lists its triangles in another order.
//! let mut device = above.patch().tessellate();
//! device.indices.rotate_left(3);
//!
//! let conversion = Conversion::Within06Ulp;
//! let both = Strength { order: ListOrder::Any, conversion, ..Strength::default() };
//! assert!(both.accepts(&case, &device));
//! assert!(!Strength { order: ListOrder::Any, ..Strength::default() }.accepts(&case, &device));
//! assert!(!Strength { conversion, ..Strength::default() }.accepts(&case, &device));
//! # Ok::<(), tess_verify::CaseError>(())
//! ```
//!
//! # What callers rely on
//!
//! - The default strength accepts only the model's output, bit for bit and in order.
//! - Whatever `Exact` accepts, `Sequence` accepts; whatever `Sequence` accepts, `Any` accepts.
//! - Every strength accepts the model's output.
//! - A point counts even if no primitive uses it, so an output with stray points is never equal.
//!
//! # Why not a tolerance
//!
//! Comparing coordinates with a tolerance of one unit would be simpler. It would also accept a
//! device that converts one value in two ways, and such a device has cracks between neighbouring
//! patches. So each legal conversion is tessellated exactly (at most 64 per patch) and compared bit
//! for bit.

mod conversions;
mod unordered;

use crate::case::Case;
use tess_core::{DomainPoint, Tessellation};

pub use conversions::flushed;
pub(crate) use conversions::{Alternatives, Ambiguous, Conversions};
pub(crate) use unordered::{Difference, first_difference, first_stray};

/// Whether points and primitives must come in the model's order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ListOrder {
    /// The model's order, index for index.
    #[default]
    Exact,
    /// The model's order of primitives and of their vertices, with each vertex identified by its
    /// coordinates, so the numbering of points is free. The places of points are compared as in
    /// [`ListOrder::Any`], so that `Any` accepts every output that this order accepts. If only
    /// points are compared, they must be in the model's order.
    Sequence,
    /// Any order of primitives, and any leading vertex of a triangle. The orientation of a triangle
    /// must be right.
    Any,
}

/// The elements that are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Elements {
    /// Points and the primitives made of them.
    #[default]
    Primitives,
    /// Only the domain points. In any order, each distinct point counts once.
    Points,
}

/// How factors may be converted to fixed-point numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Conversion {
    /// To the nearest number, ties to even.
    #[default]
    Exact,
    /// With an error of up to 0.6 units in the last place (D3D11.3 3.2.4.1).
    Within06Ulp,
}

/// What happens to a positive denormal outer factor before the cull test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Denormals {
    /// It counts as greater than zero.
    #[default]
    Keep,
    /// It may be flushed to zero, which culls the patch (D3D11.3 3.1.3).
    Flush,
}

/// The four parts of a comparison's strength. The default is the strictest: identical sequences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Strength {
    /// Order.
    pub order: ListOrder,
    /// Elements.
    pub elements: Elements,
    /// Conversion.
    pub conversion: Conversion,
    /// Denormals.
    pub denormals: Denormals,
}

impl Strength {
    /// Whether this strength accepts an output for a case, judged by this case only.
    ///
    /// [`super::check`] demands more of a whole file: with [`Conversion::Within06Ulp`], each value
    /// must be converted in the same way throughout.
    #[must_use]
    pub fn accepts(self, case: &Case, observed: &Tessellation) -> bool {
        self.explain(case, observed).is_some()
    }

    /// Whether two outputs of the same case count as equal; only order and elements are considered.
    #[must_use]
    pub fn equal(self, case: &Case, observed: &Tessellation, expected: &Tessellation) -> bool {
        match (self.order, self.elements) {
            (ListOrder::Exact, Elements::Primitives) => observed == expected,
            (ListOrder::Sequence, Elements::Primitives) => {
                vertices(observed).eq(vertices(expected))
                    && first_stray(observed, expected).is_none()
            }
            (ListOrder::Exact | ListOrder::Sequence, Elements::Points) => {
                observed.points == expected.points
            }
            (ListOrder::Any, elements) => {
                first_difference(elements, case, observed, expected).is_none()
            }
        }
    }
}

/// The point of each vertex of each primitive, in order; `None` for an index out of range.
pub fn vertices(output: &Tessellation) -> impl Iterator<Item = Option<DomainPoint>> {
    output.indices.iter().map(|&index| output.points.get(index as usize).copied())
}

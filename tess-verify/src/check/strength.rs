//! How closely another implementation is compared with the model (spec section 13).
//!
//! The model is exact, and the public specification leaves some freedom to hardware. [`Strength`]
//! says which of that freedom counts as equal. `check::device` compares each answer of a device in
//! a strength, and [`super::Way`] tries stronger and weaker ones to explain a difference.
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
//! `QUAD` has one outer factor of 3 + 2^-17. Times 65536 that is 196608.5, halfway between
//! `0x30000` and `0x30001`. The model takes the even one; a device within 0.6 units may take
//! either.
//!
//! ```
//! use tess_verify::Case;
//! use tess_verify::check::{Conversion, ListOrder, Strength};
//!
//! let quad = |u0| format!("case quad fractional_odd triangle_cw ruler {u0} 40200000 40a00000 40500000 40900000 40d00000");
//! let case: Case = quad("40400020").parse()?; // 3 + 2^-17
//! let above: Case = quad("40400040").parse()?; // 3 + 2^-16, which is 0x30001
//!
//! // A device that rounds up, and lists its triangles in another order.
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
//! - The default strength accepts the model's output alone, bit for bit and in order.
//! - What `Exact` accepts, `Sequence` accepts; what `Sequence` accepts, `Any` accepts.
//! - Every strength accepts the model.
//! - A point counts even if no primitive uses it, so an output with stray points is never equal.
//!
//! # Why not a tolerance
//!
//! Comparing coordinates with a tolerance of one unit is simpler. It would accept a device that
//! converts one value in two ways, and such a device has cracks between neighbouring patches. So
//! each legal conversion is tessellated exactly (at most 64 per patch) and compared bit for bit.

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
    /// The model's order of primitives and of their vertices, each vertex by its coordinates:
    /// however points are numbered. The places of points are compared as in [`ListOrder::Any`], so
    /// an output that this order accepts is accepted in any order too. Points alone are compared in
    /// the model's order.
    Sequence,
    /// Any order, and any leading vertex of a triangle; its orientation counts.
    Any,
}

/// The elements that are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Elements {
    /// Points and the primitives made of them.
    #[default]
    Primitives,
    /// The domain points alone; in any order, each distinct point once.
    Points,
}

/// How factors may become fixed-point numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Conversion {
    /// To the nearest, ties to even.
    #[default]
    Exact,
    /// With an error of up to 0.6 units in the last place (D3D11.3 3.2.4.1).
    Within06Ulp,
}

/// The fate of a positive denormal outer factor before the cull test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Denormals {
    /// It is greater than zero.
    #[default]
    Keep,
    /// It may be flushed to zero, which culls the patch (D3D11.3 3.1.3).
    Flush,
}

/// All four together. The default is the strictest: identical sequences.
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
    /// Whether this strength accepts an output for a case, looking at nothing but the case.
    ///
    /// [`super::check`] demands more of a whole file: with [`Conversion::Within06Ulp`], one
    /// conversion for each value.
    #[must_use]
    pub fn accepts(self, case: &Case, observed: &Tessellation) -> bool {
        self.explain(case, observed).is_some()
    }

    /// Whether two outputs of the same case count as equal, as far as order and elements go.
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

//! How closely another implementation is compared with the model (spec section 13).
//!
//! The model is exact; the public specification leaves some freedom to hardware. A comparison of a
//! device's output therefore has a strength: which order, which elements, which conversions from
//! floating point and which treatment of denormals count as equal.

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
pub enum Order {
    /// The model's order, index for index.
    #[default]
    Exact,
    /// The model's order of primitives and of their vertices, each vertex by its coordinates: however
    /// points are numbered. The places of points are compared as in [`Order::Any`], so an output that
    /// this order accepts is accepted in any order too. Points alone are compared in the model's order.
    Sequence,
    /// Any order, and any leading vertex of a triangle; its orientation counts.
    Any,
}

/// What is compared.
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

/// What happens to a positive denormal outer factor before the cull test.
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
    pub order: Order,
    /// Elements.
    pub elements: Elements,
    /// Conversion.
    pub conversion: Conversion,
    /// Denormals.
    pub denormals: Denormals,
}

impl Strength {
    /// Whether this is the comparison for identical sequences.
    #[must_use]
    pub fn is_strictest(self) -> bool {
        self == Self::default()
    }

    /// Whether this strength accepts an output for a case, looking at nothing but the case.
    ///
    /// [`crate::checker::check`] demands more of a whole file: with [`Conversion::Within06Ulp`], one
    /// conversion for each value.
    #[must_use]
    pub fn accepts(self, case: &Case, observed: &Tessellation) -> bool {
        self.explain(case, observed).is_some()
    }

    /// Whether two outputs of the same case count as equal, as far as order and elements go.
    #[must_use]
    pub fn equal(self, case: &Case, observed: &Tessellation, expected: &Tessellation) -> bool {
        match (self.order, self.elements) {
            (Order::Exact, Elements::Primitives) => observed == expected,
            (Order::Sequence, Elements::Primitives) => {
                observed.indices.len() == expected.indices.len()
                    && vertices(observed).eq(vertices(expected))
                    && first_stray(observed, expected).is_none()
            }
            (Order::Exact | Order::Sequence, Elements::Points) => {
                observed.points == expected.points
            }
            (Order::Any, elements) => {
                first_difference(elements, case, observed, expected).is_none()
            }
        }
    }
}

/// The point of each vertex of each primitive, in order; `None` for an index out of range.
pub fn vertices(output: &Tessellation) -> impl Iterator<Item = Option<DomainPoint>> {
    output.indices.iter().map(|&index| output.points.get(index as usize).copied())
}

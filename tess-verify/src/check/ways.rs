//! Explanations of a device that differs: freedoms that the specification leaves (spec section 13),
//! and mistakes that show in every output in the same way.

use crate::case::Case;
use crate::check::strength::{Conversion, Denormals, ListOrder, Strength};
use std::collections::BTreeSet;
use tess_core::fixed_point::ONE;
use tess_core::{
    Config, Domain, DomainPoint, IsolineFactors, OutputPrimitive, PatchFactors, QuadFactors,
    Tessellation,
};

/// The largest factor of the model.
const LARGEST: u32 = 64;

/// An explanation of an output that differs from the model's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Way {
    /// Primitives and points come in another order.
    Order,
    /// Positive denormal outer factors are flushed to zero, which culls the patch.
    Flush,
    /// Factors are converted to fixed point within 0.6 units in the last place.
    Conversion,
    /// Both `Flush` and `Conversion`.
    FlushAndConversion,
    /// Factors above the model's largest are not clamped to it; a device need not do so.
    Clamping,
    /// Every triangle turns the other way.
    Reversed,
    /// u and v are exchanged, and triangles turn the right way.
    Transposed,
    /// u and v are exchanged, and each triangle keeps its order of vertices, so it turns the other
    /// way.
    TransposedReversed,
    /// u runs backwards, and triangles turn the right way.
    MirroredU,
    /// u runs backwards, and each triangle keeps its order of vertices.
    MirroredUReversed,
    /// v runs backwards, and triangles turn the right way.
    MirroredV,
    /// v runs backwards, and each triangle keeps its order of vertices.
    MirroredVReversed,
    /// On triangle patches, v and w are exchanged, and triangles turn the right way.
    ExchangedVW,
    /// On triangle patches, v and w are exchanged, and each triangle keeps its order of vertices.
    ExchangedVWReversed,
    /// The density and the detail of isoline patches are exchanged.
    IsolineFactors,
    /// The two inside factors of quad patches are exchanged.
    InsideFactors,
    /// Factors are rounded to binary16, as Metal stores them.
    HalfFactors,
}

impl Way {
    /// Every way; those that the specification allows come first.
    pub const ALL: [Self; 17] = [
        Self::Flush,
        Self::Conversion,
        Self::FlushAndConversion,
        Self::Clamping,
        Self::Order,
        Self::Reversed,
        Self::Transposed,
        Self::TransposedReversed,
        Self::MirroredU,
        Self::MirroredUReversed,
        Self::MirroredV,
        Self::MirroredVReversed,
        Self::ExchangedVW,
        Self::ExchangedVWReversed,
        Self::IsolineFactors,
        Self::InsideFactors,
        Self::HalfFactors,
    ];

    /// Whether the specification leaves this choice to a device.
    #[must_use]
    pub const fn is_allowed(self) -> bool {
        matches!(
            self,
            Self::Order
                | Self::Flush
                | Self::Conversion
                | Self::FlushAndConversion
                | Self::Clamping
        )
    }

    /// The options of `tess check` with which this counts as equal; empty if there are none.
    #[must_use]
    pub const fn options(self) -> &'static str {
        match self {
            Self::Order => "--order any",
            Self::Flush => "--denormals flush",
            Self::Conversion => "--conversion 0.6ulp",
            Self::FlushAndConversion => "--denormals flush --conversion 0.6ulp",
            _ => "",
        }
    }

    /// A description of the device's way.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Order => "primitives or points come in another order, and are the model's",
            Self::Flush => "positive denormal outer factors are flushed to zero, which culls",
            Self::Conversion => "factors are converted to fixed point within 0.6 ulp",
            Self::FlushAndConversion => {
                "denormal outer factors are flushed, and factors converted within 0.6 ulp"
            }
            Self::Clamping => "factors above 64 are not clamped to the model's range",
            Self::Reversed => "every triangle turns the other way",
            Self::Transposed => "u and v are exchanged",
            Self::TransposedReversed => {
                "u and v are exchanged, and the order of a triangle's vertices is kept"
            }
            Self::MirroredU => "u runs backwards",
            Self::MirroredUReversed => {
                "u runs backwards, and the order of a triangle's vertices is kept"
            }
            Self::MirroredV => "v runs backwards",
            Self::MirroredVReversed => {
                "v runs backwards, and the order of a triangle's vertices is kept"
            }
            Self::ExchangedVW => "v and w are exchanged on triangle patches",
            Self::ExchangedVWReversed => {
                "v and w are exchanged on triangle patches, and the order of a triangle's vertices is kept"
            }
            Self::IsolineFactors => "the two factors of isolines are exchanged",
            Self::InsideFactors => "the two inside factors of quads are exchanged",
            Self::HalfFactors => "factors are rounded to binary16 (half), as Metal stores them",
        }
    }

    /// Whether this explains an output that differs at a strength. `max_level` is the largest
    /// factor that the device supports; pass 64 if it is unknown.
    #[must_use]
    pub fn explains(
        self,
        case: &Case,
        observed: &Tessellation,
        strength: Strength,
        max_level: u32,
    ) -> bool {
        let flush = Strength { denormals: Denormals::Flush, ..strength };
        let convert = |from: Strength| Strength { conversion: Conversion::Within06Ulp, ..from };
        match self {
            Self::Order => Strength { order: ListOrder::Any, ..strength }.accepts(case, observed),
            Self::Flush => flush.accepts(case, observed),
            Self::Conversion => convert(strength).accepts(case, observed),
            Self::FlushAndConversion => convert(flush).accepts(case, observed),
            Self::Clamping => {
                let is_larger = case.factors.iter().any(|factor| factor > 64.0);
                max_level > LARGEST && is_larger && has_more_places(case, observed)
            }
            Self::IsolineFactors | Self::InsideFactors | Self::HalfFactors => {
                let taken = self.taken_for(case);
                taken.is_some_and(|taken| strength.accepts(&taken, observed))
            }
            _ => self.turns(case).is_some_and(|(turn, right)| {
                !observed.points.is_empty() && strength.accepts(&right, &turn_round(observed, turn))
            }),
        }
    }

    /// The move of points that corrects an output, and the case that the moved output answers.
    fn turns(self, case: &Case) -> Option<(Turn, Case)> {
        let (turn, is_reversed): (Turn, bool) = match self {
            Self::Reversed => (|uv| uv, true),
            Self::Transposed => (|[u, v]| [v, u], true),
            Self::TransposedReversed => (|[u, v]| [v, u], false),
            Self::MirroredU => (|[u, v]| [ONE.wrapping_sub(u), v], true),
            Self::MirroredUReversed => (|[u, v]| [ONE.wrapping_sub(u), v], false),
            Self::MirroredV => (|[u, v]| [u, ONE.wrapping_sub(v)], true),
            Self::MirroredVReversed => (|[u, v]| [u, ONE.wrapping_sub(v)], false),
            Self::ExchangedVW | Self::ExchangedVWReversed => {
                if case.domain() != Domain::Triangle {
                    return None;
                }
                let turn: Turn = |[u, v]| [u, ONE.wrapping_sub(u).wrapping_sub(v)];
                (turn, self == Self::ExchangedVW)
            }
            _ => return None,
        };
        Some((turn, if is_reversed { reverse(case) } else { *case }))
    }

    /// The case that the device tessellated in place of this one.
    fn taken_for(self, case: &Case) -> Option<Case> {
        let factors = match (self, case.factors) {
            (Self::IsolineFactors, PatchFactors::Isoline(f)) => {
                PatchFactors::Isoline(IsolineFactors { density: f.detail, detail: f.density })
            }
            (Self::InsideFactors, PatchFactors::Quad(f)) => {
                PatchFactors::Quad(QuadFactors { inside_u: f.inside_v, inside_v: f.inside_u, ..f })
            }
            (Self::HalfFactors, factors) => {
                factors.map(|factor| half::f16::from_f32(factor).to_f32())
            }
            _ => return None,
        };
        Some(Case { factors, ..*case })
    }
}

/// A move of points, on their 16.16 bits.
type Turn = fn([u32; 2]) -> [u32; 2];

/// Whether the output has more distinct points than the model's, as if its factors were larger.
fn has_more_places(case: &Case, observed: &Tessellation) -> bool {
    let places = |output: &Tessellation| {
        let place = |point: &DomainPoint| (point.u.to_bits(), point.v.to_bits());
        output.points.iter().map(place).collect::<BTreeSet<_>>().len()
    };
    places(observed) > places(&case.patch().tessellate())
}

/// The case with the other orientation of triangles.
const fn reverse(case: &Case) -> Case {
    let output = match case.config.output {
        OutputPrimitive::TriangleCw => OutputPrimitive::TriangleCcw,
        OutputPrimitive::TriangleCcw => OutputPrimitive::TriangleCw,
        other => other,
    };
    Case { config: Config { output, ..case.config }, factors: case.factors }
}

/// The output with every point moved.
fn turn_round(output: &Tessellation, turn: Turn) -> Tessellation {
    let point = |point: &DomainPoint| {
        let [u, v] = turn([point.u.to_bits(), point.v.to_bits()]);
        DomainPoint::from_bits(u, v)
    };
    Tessellation {
        points: output.points.iter().map(point).collect(),
        indices: output.indices.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Domain, Partitioning, PatchFactors};

    /// The outputs are the model's for factor 100, which it clamps to 64: as they are, or with one
    /// more point.
    #[test]
    fn larger_factors_explain_more_points() {
        let case = |factor: f32| {
            let config = Config::new(Partitioning::Integer, OutputPrimitive::Point);
            Case { config, factors: PatchFactors::uniform(Domain::Isoline, factor) }
        };
        let model = case(100.0).patch().tessellate();
        let with = |point| {
            let mut output = model.clone();
            output.points.push(point);
            output
        };
        let finer = with(DomainPoint::from_bits(0x123, 0x456));
        let strength = Strength::default();
        let explains = |factor: f32, output: &Tessellation, max_level: u32| {
            Way::Clamping.explains(&case(factor), output, strength, max_level)
        };
        assert!(explains(100.0, &finer, 128), "one place more");
        assert!(!explains(100.0, &model, 128), "as many places");
        assert!(!explains(64.0, &finer, 128), "no factor above 64");
        assert!(!explains(100.0, &finer, 64), "a device that takes 64 at most");
        let repeated = with(model.points[0]);
        assert!(!explains(100.0, &repeated, 128), "a place twice");
    }
}

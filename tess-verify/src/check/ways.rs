//! Explanations of a device that differs: freedoms that the specification leaves (spec section 13), and
//! mistakes that turn a whole output round.

use crate::case::Case;
use crate::check::strength::{Conversion, Denormals, ListOrder, Strength};
use std::collections::BTreeSet;
use tess_core::fixed_point::ONE;
use tess_core::{Config, DomainPoint, OutputPrimitive, Tessellation};

/// The largest factor of the model.
const LARGEST: u32 = 64;

/// An explanation of an output that differs from the model's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Way {
    /// Primitives and points come in another order.
    Order,
    /// Positive denormal outer factors are flushed to zero, which culls.
    Flush,
    /// Factors are converted to fixed point within 0.6 units in the last place.
    Conversion,
    /// Both of these.
    FlushAndConversion,
    /// Factors above the model's largest, which the device need not clamp there.
    Clamping,
    /// Every triangle turns the other way.
    Reversed,
    /// u and v are exchanged, and triangles turn the other way.
    Transposed,
    /// u and v are exchanged.
    TransposedReversed,
    /// u runs backwards, and triangles turn the other way.
    MirroredU,
    /// v runs backwards, and triangles turn the other way.
    MirroredV,
}

impl Way {
    /// The ways that may explain output in any order, those that the specification allows first.
    pub const ALL: [Self; 9] = [
        Self::Flush,
        Self::Conversion,
        Self::FlushAndConversion,
        Self::Clamping,
        Self::Reversed,
        Self::Transposed,
        Self::TransposedReversed,
        Self::MirroredU,
        Self::MirroredV,
    ];

    /// The ways that may explain every difference of a file: freedoms of `tess check`'s options first, then what turns a
    /// whole output round.
    pub(crate) const OF_FILES: [Self; 9] = [
        Self::Order,
        Self::Flush,
        Self::Conversion,
        Self::FlushAndConversion,
        Self::Reversed,
        Self::Transposed,
        Self::TransposedReversed,
        Self::MirroredU,
        Self::MirroredV,
    ];

    /// Whether the specification leaves this to a device, as it does the first of them.
    #[must_use]
    pub const fn is_allowed(self) -> bool {
        self as usize <= Self::Clamping as usize
    }

    /// The options of `tess check` under which this counts as equal; empty if there are none.
    #[must_use]
    pub const fn options(self) -> &'static str {
        SAID[self as usize].1
    }

    /// The device's way, in words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        SAID[self as usize].0
    }

    /// Whether this explains an output that differs in a strength. `max_level` is the largest factor
    /// that the device takes, 64 if it is not known to be larger.
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
        let turned = |turn: fn([u32; 2]) -> [u32; 2], reversed: bool| {
            let case = if reversed { reverse(case) } else { *case };
            !observed.points.is_empty() && strength.accepts(&case, &turn_round(observed, turn))
        };
        match self {
            Self::Order => Strength { order: ListOrder::Any, ..strength }.accepts(case, observed),
            Self::Flush => flush.accepts(case, observed),
            Self::Conversion => convert(strength).accepts(case, observed),
            Self::FlushAndConversion => convert(flush).accepts(case, observed),
            Self::Clamping => {
                let is_larger = case.factors.iter().any(|factor| factor > 64.0);
                max_level > LARGEST && is_larger && has_more_places(case, observed)
            }
            Self::Reversed => turned(|uv| uv, true),
            Self::Transposed => turned(|[u, v]| [v, u], true),
            Self::TransposedReversed => turned(|[u, v]| [v, u], false),
            Self::MirroredU => turned(|[u, v]| [ONE.wrapping_sub(u), v], true),
            Self::MirroredV => turned(|[u, v]| [u, ONE.wrapping_sub(v)], true),
        }
    }
}

/// The words and the options of each [`Way`], in their order.
const SAID: [(&str, &str); 10] = [
    ("primitives or points come in another order, and are the model's", "--order any"),
    ("positive denormal outer factors are flushed to zero, which culls", "--denormals flush"),
    ("factors are converted to fixed point within 0.6 ulp", "--conversion 0.6ulp"),
    (
        "denormal outer factors are flushed, and factors converted within 0.6 ulp",
        "--denormals flush --conversion 0.6ulp",
    ),
    ("factors above 64 are not clamped to the model's range", ""),
    ("every triangle turns the other way", ""),
    ("u and v are exchanged", ""),
    ("u and v are exchanged, the turn of triangles kept", ""),
    ("u runs backwards", ""),
    ("v runs backwards", ""),
];

/// Whether a device cuts finer than the model: it has more distinct points.
fn has_more_places(case: &Case, observed: &Tessellation) -> bool {
    let places = |output: &Tessellation| {
        let place = |point: &DomainPoint| (point.u.to_bits(), point.v.to_bits());
        output.points.iter().map(place).collect::<BTreeSet<_>>().len()
    };
    places(observed) > places(&case.patch().tessellate())
}

/// The case with triangles that turn the other way.
const fn reverse(case: &Case) -> Case {
    let output = match case.config.output {
        OutputPrimitive::TriangleCw => OutputPrimitive::TriangleCcw,
        OutputPrimitive::TriangleCcw => OutputPrimitive::TriangleCw,
        other => other,
    };
    Case { config: Config { output, ..case.config }, factors: case.factors }
}

/// An output with every point moved.
fn turn_round(output: &Tessellation, turn: fn([u32; 2]) -> [u32; 2]) -> Tessellation {
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

    /// The outputs are the model's for factor 100, which it clamps to 64, with a point more or none.
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

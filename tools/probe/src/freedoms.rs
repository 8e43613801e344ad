//! What explains that a device differs: freedoms that the specification leaves, and mistakes that turn
//! a whole output round.

use crate::capture::Method;
use crate::verdict::any_order;
use serde::Serialize;
use tess_core::fixed_point::ONE;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::case::Case;
use tess_verify::strength::{Conversion, Denormals, Strength};

/// An explanation of a patch that is not the model's in any order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Way {
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
    /// All, those that the specification allows first.
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

    /// Whether the specification leaves this to a device.
    #[must_use]
    pub const fn is_allowed(self) -> bool {
        matches!(self, Self::Flush | Self::Conversion | Self::FlushAndConversion | Self::Clamping)
    }

    /// What the device does, in words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Flush => "positive denormal outer factors are flushed to zero, which culls",
            Self::Conversion => "factors are converted to fixed point within 0.6 ulp",
            Self::FlushAndConversion => {
                "denormal outer factors are flushed, and factors converted within 0.6 ulp"
            }
            Self::Clamping => "factors above 64 are not clamped to the model's range",
            Self::Reversed => "every triangle turns the other way",
            Self::Transposed => "u and v are exchanged",
            Self::TransposedReversed => "u and v are exchanged, the turn of triangles kept",
            Self::MirroredU => "u runs backwards",
            Self::MirroredV => "v runs backwards",
        }
    }

    /// Whether this explains an output.
    pub(crate) fn explains(
        self,
        case: &Case,
        observed: &Tessellation,
        method: Method,
        max_level: u32,
    ) -> bool {
        let strict = any_order(method);
        let flush = Strength { denormals: Denormals::Flush, ..strict };
        let convert = |from: Strength| Strength { conversion: Conversion::Within06Ulp, ..from };
        let turned = |turn: fn([u32; 2]) -> [u32; 2], reverse| {
            !observed.points.is_empty()
                && strict.accepts(case, &turn_round(observed, turn, reverse))
        };
        match self {
            Self::Flush => flush.accepts(case, observed),
            Self::Conversion => convert(strict).accepts(case, observed),
            Self::FlushAndConversion => convert(flush).accepts(case, observed),
            Self::Clamping => max_level > 64 && case.factors.iter().any(|factor| factor > 64.0),
            Self::Reversed => turned(|uv| uv, true),
            Self::Transposed => turned(|[u, v]| [v, u], true),
            Self::TransposedReversed => turned(|[u, v]| [v, u], false),
            Self::MirroredU => turned(|[u, v]| [ONE - u, v], true),
            Self::MirroredV => turned(|[u, v]| [u, ONE - v], true),
        }
    }
}

/// An output with every point moved and, if so asked, every primitive's vertices reversed.
fn turn_round(
    output: &Tessellation,
    turn: fn([u32; 2]) -> [u32; 2],
    reverse: bool,
) -> Tessellation {
    let point = |point: &DomainPoint| {
        let [u, v] = turn([point.u.to_bits(), point.v.to_bits()]);
        DomainPoint::from_bits(u, v)
    };
    let mut indices = output.indices.clone();
    if reverse {
        indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    Tessellation { points: output.points.iter().map(point).collect(), indices }
}

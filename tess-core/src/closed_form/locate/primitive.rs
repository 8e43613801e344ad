//! Which line, stitch or centre the t-th primitive of a patch belongs to, and its indices.
//!
//! `Patch::locate_primitive` calls [`locate`], which turns a number into an origin.
//! `Patch::primitive` also calls [`primitive`], which turns the origin into indices.
//!
//! # The data
//!
//! ```text
//! output, patch                 origin of primitive t                     indices
//! points; culled                Sequence { step: t }                      t
//! isoline                       Line { line: t / s, segment: t % s }   p, p + 1
//! lines of other domains        Sequence { step: t }                      t, t + 1
//! minimum triangle or quad      Minimum { step: t }                       0 1 2; 0 1 3 and 1 2 3
//! other triangles               Transition, Ring or Centre                `locate/rings.rs`
//! ```
//!
//! Here `s` is the number of segments of a line, and `p = line * (s + 1) + segment`. Triangles are
//! made clockwise; counterclockwise output swaps the last two indices.
//!
//! # One patch
//!
//! An isoline patch with 3 lines of 4 segments has 12 primitives. Primitive 6 is segment 2 of line
//! 1, whose points are 5 to 9: the indices are 7 and 8.
//!
//! # What holds
//!
//! - `t` is below the patch's count, so `t / s` is one of its lines. `s` is at least 1.
//! - [`primitive`] returns `None` for an origin of another output or kind of patch. It does not
//!   check the ring, edge and step of one of the right kind.

use crate::closed_form::locate::origin::PrimitiveOrigin;
use crate::closed_form::locate::rings;
use crate::model::connect::minimum_triangles;
use crate::model::factors::{ProcessedFactor, ProcessedPatch};
use crate::model::output::Primitive;
use crate::model::patch_factors::{IsolineFactors, PatchFactors};
use crate::model::state::{Config, OutputPrimitive};

/// The origin of primitive `t`, which is less than the patch's primitive count.
pub(crate) fn locate(config: Config, patch: &ProcessedPatch, t: u32) -> PrimitiveOrigin {
    match (config.output, patch) {
        (OutputPrimitive::Point, _) | (_, ProcessedPatch::Culled) => {
            PrimitiveOrigin::Sequence { step: t }
        }
        (_, ProcessedPatch::Regular(PatchFactors::Isoline(factors))) => {
            let segments = factors.detail.context.points - 1;
            PrimitiveOrigin::Line { line: t / segments, segment: t % segments }
        }
        (OutputPrimitive::Line, _) => PrimitiveOrigin::Sequence { step: t },
        (_, ProcessedPatch::Minimum(_)) => PrimitiveOrigin::Minimum { step: t },
        (_, ProcessedPatch::Regular(PatchFactors::Triangle(factors))) => rings::locate(factors, t),
        (_, ProcessedPatch::Regular(PatchFactors::Quad(factors))) => rings::locate(factors, t),
    }
}

/// The primitive of an origin that [`locate`] gave for this patch; `None` for an origin of another
/// output or kind of patch.
pub(crate) fn primitive(
    config: Config,
    patch: &ProcessedPatch,
    location: PrimitiveOrigin,
) -> Option<Primitive> {
    match (config.output, patch, location) {
        (OutputPrimitive::Point, _, PrimitiveOrigin::Sequence { step }) => {
            Some(Primitive::Point([step]))
        }
        (OutputPrimitive::Line, _, PrimitiveOrigin::Sequence { step }) => {
            Some(Primitive::Line([step, step + 1]))
        }
        (
            _,
            ProcessedPatch::Regular(PatchFactors::Isoline(factors)),
            PrimitiveOrigin::Line { line, segment },
        ) => Some(isoline_segment(factors, line, segment)),
        (OutputPrimitive::TriangleCw, ..) => {
            triangle(config, patch, location).map(Primitive::Triangle)
        }
        (OutputPrimitive::TriangleCcw, ..) => {
            triangle(config, patch, location).map(|[a, b, c]| Primitive::Triangle([a, c, b]))
        }
        _ => None,
    }
}

fn isoline_segment(
    factors: &IsolineFactors<ProcessedFactor>,
    line: u32,
    segment: u32,
) -> Primitive {
    let p = line * factors.detail.context.points + segment;
    Primitive::Line([p, p + 1])
}

/// The triangle of an origin, clockwise.
fn triangle(config: Config, patch: &ProcessedPatch, location: PrimitiveOrigin) -> Option<[u32; 3]> {
    match (patch, location) {
        (ProcessedPatch::Minimum(factors), PrimitiveOrigin::Minimum { step }) => {
            minimum_triangles(factors.domain()).get(step as usize).copied()
        }
        (ProcessedPatch::Regular(PatchFactors::Triangle(factors)), location) => {
            rings::triangle(factors, config.split, location)
        }
        (ProcessedPatch::Regular(PatchFactors::Quad(factors)), location) => {
            rings::triangle(factors, config.split, location)
        }
        _ => None,
    }
}

//! Which line, stitch or centre the t-th primitive of a patch belongs to, and its indices.

use crate::closed_form::locate::origin::PrimitiveOrigin;
use crate::closed_form::locate::rings;
use crate::model::factors::{ProcessedFactor, ProcessedPatch};
use crate::model::output::Primitive;
use crate::model::patch_factors::{IsolineFactors, PatchFactors};
use crate::model::state::{Config, Domain, OutputPrimitive};

/// Locates primitive `t`, which is less than the patch's primitive count.
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

/// The primitive at a location that [`locate`] gave for this patch; `None` for one it never gives.
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

/// The triangle at a location, clockwise.
fn triangle(config: Config, patch: &ProcessedPatch, location: PrimitiveOrigin) -> Option<[u32; 3]> {
    match (patch, location) {
        (ProcessedPatch::Minimum(factors), PrimitiveOrigin::Minimum { step }) => {
            match factors.domain() {
                Domain::Triangle if step < 1 => Some([0, 1, 2]),
                Domain::Quad if step < 2 => Some([step, step + 1, 3]),
                Domain::Isoline | Domain::Triangle | Domain::Quad => None,
            }
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

//! Which line, stitch or centre the t-th primitive of a patch belongs to, and its indices.

use crate::factors::{ProcessedFactor, ProcessedPatch};
use crate::locate::rings;
use crate::output::Primitive;
use crate::patch_factors::{IsolineFactors, PatchFactors};
use crate::state::{Config, Domain, OutputPrimitive};

/// Where a primitive comes from in the walk of spec sections 7 and 8.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PrimitiveLocation {
    /// Point output, or the line that joins the points in order: primitive `step`.
    Sequence {
        /// Number of the primitive.
        step: u32,
    },
    /// Segment `segment` of an isoline.
    Line {
        /// Number of the line, from v = 0.
        line: u32,
        /// Number of the segment, from u = 0.
        segment: u32,
    },
    /// Triangle `step` of a minimum patch.
    Minimum {
        /// Number of the triangle.
        step: u32,
    },
    /// Triangle `step` of the stitch between an outer edge and ring 1.
    Transition {
        /// Number of the edge: u = 0, v = 0, then w = 0 or u = 1, v = 1.
        edge: u32,
        /// Number of the triangle along the stitch.
        step: u32,
    },
    /// Triangle `step` of the stitch between one edge of rings `ring - 1` and `ring`.
    Ring {
        /// Number of the inner ring, from 2.
        ring: u32,
        /// Number of the edge.
        edge: u32,
        /// Number of the triangle along the stitch.
        step: u32,
    },
    /// Triangle `step` inside the innermost ring.
    Centre {
        /// Number of the triangle.
        step: u32,
    },
}

/// Locates primitive `t`, which is less than the patch's primitive count.
pub(crate) fn locate(config: Config, patch: &ProcessedPatch, t: u32) -> PrimitiveLocation {
    match (config.output, patch) {
        (OutputPrimitive::Point, _) | (_, ProcessedPatch::Culled) => {
            PrimitiveLocation::Sequence { step: t }
        }
        (_, ProcessedPatch::Regular(PatchFactors::Isoline(factors))) => {
            let segments = factors.detail.context.points - 1;
            PrimitiveLocation::Line { line: t / segments, segment: t % segments }
        }
        (OutputPrimitive::Line, _) => PrimitiveLocation::Sequence { step: t },
        (_, ProcessedPatch::Minimum(_)) => PrimitiveLocation::Minimum { step: t },
        (_, ProcessedPatch::Regular(PatchFactors::Triangle(factors))) => rings::locate(factors, t),
        (_, ProcessedPatch::Regular(PatchFactors::Quad(factors))) => rings::locate(factors, t),
    }
}

/// The primitive at a location that [`locate`] gave for this patch; `None` for one it never gives.
pub(crate) fn primitive(
    config: Config,
    patch: &ProcessedPatch,
    location: PrimitiveLocation,
) -> Option<Primitive> {
    match (config.output, patch, location) {
        (OutputPrimitive::Point, _, PrimitiveLocation::Sequence { step }) => {
            Some(Primitive::Point([step]))
        }
        (OutputPrimitive::Line, _, PrimitiveLocation::Sequence { step }) => {
            Some(Primitive::Line([step, step + 1]))
        }
        (
            _,
            ProcessedPatch::Regular(PatchFactors::Isoline(factors)),
            PrimitiveLocation::Line { line, segment },
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
fn triangle(
    config: Config,
    patch: &ProcessedPatch,
    location: PrimitiveLocation,
) -> Option<[u32; 3]> {
    match (patch, location) {
        (ProcessedPatch::Minimum(factors), PrimitiveLocation::Minimum { step }) => {
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

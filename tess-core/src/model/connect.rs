//! The primitives of a patch, in order (spec sections 7 and 8).

pub(crate) mod quad;
pub(crate) mod rings;
pub(crate) mod triangle;

use crate::model::factors::{ProcessedFactor, ProcessedPatch};
use crate::model::output::Primitive;
use crate::model::patch_factors::{IsolineFactors, PatchFactors};
use crate::model::points::isoline::line_count;
use crate::model::sink::Sink;
use crate::model::state::{Config, Domain, OutputPrimitive};
use crate::model::stitch::{Stitch, Triangle};

/// Sends all primitives of a patch with this many points to `sink`.
pub(crate) fn emit(config: Config, patch: &ProcessedPatch, points: u32, sink: &mut impl Sink) {
    match (config.output, patch) {
        (OutputPrimitive::Point, _) => {
            (0..points).for_each(|i| sink.primitive(Primitive::Point([i])));
        }
        (_, ProcessedPatch::Regular(PatchFactors::Isoline(factors))) => {
            emit_isolines(factors, sink);
        }
        (OutputPrimitive::Line, _) => {
            (1..points).for_each(|p| sink.primitive(Primitive::Line([p - 1, p])));
        }
        (OutputPrimitive::TriangleCw, _) => {
            emit_triangles(config, patch, |t| sink.primitive(Primitive::Triangle(t)));
        }
        (OutputPrimitive::TriangleCcw, _) => emit_triangles(config, patch, |[a, b, c]| {
            sink.primitive(Primitive::Triangle([a, c, b]));
        }),
    }
}

/// The segments of isolines, line by line.
fn emit_isolines(factors: &IsolineFactors<ProcessedFactor>, sink: &mut impl Sink) {
    let points = factors.detail.context.points;
    for line in 0..line_count(factors) {
        let first = line * points;
        for p in first + 1..first + points {
            sink.primitive(Primitive::Line([p - 1, p]));
        }
    }
}

/// The triangles of a triangle or quad patch, clockwise.
fn emit_triangles(config: Config, patch: &ProcessedPatch, mut emit: impl FnMut(Triangle)) {
    match patch {
        ProcessedPatch::Culled => {}
        ProcessedPatch::Minimum(factors) => {
            minimum_triangles(factors.domain()).iter().copied().for_each(emit);
        }
        ProcessedPatch::Regular(factors) => {
            stitches(factors, |stitch| stitch.triangles(config.split, &mut emit));
        }
    }
}

/// Sends the stitches of a patch to `emit`, in order. Isolines have none.
pub(crate) fn stitches(factors: &PatchFactors<ProcessedFactor>, emit: impl FnMut(Stitch)) {
    match factors {
        PatchFactors::Isoline(_) => {}
        PatchFactors::Triangle(factors) => triangle::emit(factors, emit),
        PatchFactors::Quad(factors) => quad::emit(factors, emit),
    }
}

/// The triangles of a minimum patch (spec section 3, step 8). Isolines have none.
pub(crate) const fn minimum_triangles(domain: Domain) -> &'static [Triangle] {
    match domain {
        Domain::Isoline => &[],
        Domain::Triangle => &[[0, 1, 2]],
        Domain::Quad => &[[0, 1, 3], [1, 2, 3]],
    }
}

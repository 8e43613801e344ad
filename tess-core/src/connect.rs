//! The primitives of a patch, in order (spec sections 7 and 8).

pub(crate) mod isoline;
pub(crate) mod quad;
pub(crate) mod rings;
pub(crate) mod triangle;

use crate::counts::counts;
use crate::factors::{ProcessedFactor, ProcessedPatch};
use crate::output::Primitive;
use crate::patch_factors::PatchFactors;
use crate::sink::Sink;
use crate::state::{Config, Domain, OutputPrimitive};
use crate::stitch::{Stitch, Triangle};

/// Sends all primitives of a patch to `sink`.
pub(crate) fn emit(config: Config, patch: &ProcessedPatch, sink: &mut impl Sink) {
    let points = || counts(config, patch).points;
    match (config.output, patch) {
        (OutputPrimitive::Point, _) => {
            (0..points()).for_each(|i| sink.primitive(Primitive::Point([i])));
        }
        (_, ProcessedPatch::Regular(PatchFactors::Isoline(factors))) => {
            isoline::emit(factors, sink);
        }
        (OutputPrimitive::Line, _) => {
            (1..points()).for_each(|p| sink.primitive(Primitive::Line([p - 1, p])));
        }
        (OutputPrimitive::TriangleCw, _) => {
            emit_triangles(config, patch, |t| sink.primitive(Primitive::Triangle(t)));
        }
        (OutputPrimitive::TriangleCcw, _) => emit_triangles(config, patch, |[a, b, c]| {
            sink.primitive(Primitive::Triangle([a, c, b]));
        }),
    }
}

/// The triangles of a triangle or quad patch, clockwise.
fn emit_triangles(config: Config, patch: &ProcessedPatch, emit: impl FnMut(Triangle)) {
    match patch {
        ProcessedPatch::Culled => {}
        ProcessedPatch::Minimum(factors) => {
            minimum_triangles(factors.domain()).iter().copied().for_each(emit);
        }
        ProcessedPatch::Regular(factors) => emit_regular(config, factors, emit),
    }
}

fn emit_regular(
    config: Config,
    factors: &PatchFactors<ProcessedFactor>,
    mut emit: impl FnMut(Triangle),
) {
    let stitch = |stitch: Stitch| stitch.triangles(config.split, &mut emit);
    match factors {
        PatchFactors::Isoline(_) => {} // drawn as lines
        PatchFactors::Triangle(factors) => {
            let centre = triangle::emit(factors, stitch);
            centre.into_iter().for_each(emit);
        }
        PatchFactors::Quad(factors) => quad::emit(factors, stitch),
    }
}

/// Sends the stitches of a patch to `emit`, in order.
pub(crate) fn stitches(patch: &ProcessedPatch, emit: impl FnMut(Stitch)) {
    match patch {
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => {
            triangle::emit(factors, emit);
        }
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => quad::emit(factors, emit),
        _ => {}
    }
}

/// The triangles of a minimum patch (spec section 3, step 8). Isolines have none.
const fn minimum_triangles(domain: Domain) -> &'static [Triangle] {
    match domain {
        Domain::Isoline => &[],
        Domain::Triangle => &[[0, 1, 2]],
        Domain::Quad => &[[0, 1, 3], [1, 2, 3]],
    }
}

//! How many points, primitives and indices a patch has, by formula (spec section 12.6).

use crate::model::factors::{ProcessedFactor, ProcessedPatch};
use crate::model::patch_factors::{IsolineFactors, PatchFactors};
use crate::model::patch_factors::{QuadFactors, TriangleFactors};
use crate::model::points::isoline::line_count;
use crate::model::state::{Config, Domain, OutputPrimitive, Parity};

/// The most points that one patch has: a 64 x 64 quad.
pub const MAX_POINTS: usize = 65 * 65;
/// The most indices that one patch has: a 64 x 64 quad in triangles.
pub const MAX_INDICES: usize = 64 * 64 * 6;

/// Sizes of a patch's output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Counts {
    /// Domain points, at most [`MAX_POINTS`].
    pub points: u32,
    /// Primitives: points, line segments or triangles.
    pub primitives: u32,
    /// Indices, 1, 2 or 3 for each primitive, at most [`MAX_INDICES`].
    pub indices: u32,
}

/// Predicts the output sizes of a processed patch.
#[must_use]
pub fn counts(config: Config, patch: &ProcessedPatch) -> Counts {
    let (points, triangles) = match patch {
        ProcessedPatch::Culled => return Counts::default(),
        ProcessedPatch::Regular(PatchFactors::Isoline(factors)) => {
            return isoline(config, factors);
        }
        ProcessedPatch::Minimum(factors) => minimum(factors.domain()),
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => triangle(factors),
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => quad(factors),
    };
    match config.output {
        OutputPrimitive::Point => in_primitives(points, points, 1),
        OutputPrimitive::Line => in_primitives(points, points - 1, 2),
        OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw => {
            in_primitives(points, triangles, 3)
        }
    }
}

/// Asked for triangles, isolines are lines.
fn isoline(config: Config, factors: &IsolineFactors<ProcessedFactor>) -> Counts {
    let lines = line_count(factors);
    let points = factors.detail.context.points;
    match config.output {
        OutputPrimitive::Point => in_primitives(lines * points, lines * points, 1),
        _ => in_primitives(lines * points, lines * (points - 1), 2),
    }
}

/// Points and triangles of a minimum patch. Isolines have none.
const fn minimum(domain: Domain) -> (u32, u32) {
    match domain {
        Domain::Isoline => (0, 0),
        Domain::Triangle => (3, 1),
        Domain::Quad => (4, 2),
    }
}

/// Points and triangles of a triangle patch.
fn triangle(factors: &TriangleFactors<ProcessedFactor>) -> (u32, u32) {
    let boundary = factors.outer_contexts().iter().map(|context| context.points - 1).sum();
    let half = factors.inside.context.points / 2;
    let interior = match factors.inside.context.parity {
        Parity::Odd => 3 * (half - 1) * (half - 1),
        Parity::Even => 3 * half * (half - 1) + 1,
    };
    points_and_triangles(boundary, interior)
}

/// Points and triangles of a quad patch.
fn quad(factors: &QuadFactors<ProcessedFactor>) -> (u32, u32) {
    let boundary = factors.outer_contexts().iter().map(|context| context.points - 1).sum();
    let [u, v] = factors.inside().map(|factor| factor.context.points);
    points_and_triangles(boundary, (u - 2) * (v - 2))
}

/// Euler's formula for a disc: triangles = 2 * points - 2 - boundary.
fn points_and_triangles(boundary: u32, interior: u32) -> (u32, u32) {
    let points = boundary + interior;
    (points, 2 * points - 2 - boundary)
}

const fn in_primitives(points: u32, primitives: u32, indices_each: u32) -> Counts {
    Counts { points, primitives, indices: primitives * indices_each }
}

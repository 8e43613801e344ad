//! How many points, primitives and indices a patch has, by formula (spec section 12.6).

use crate::model::factors::{ProcessedFactor, ProcessedPatch};
use crate::model::patch_factors::{IsolineFactors, PatchFactors};
use crate::model::patch_factors::{QuadFactors, TriangleFactors};
use crate::model::points::isoline::line_count;
use crate::model::state::{Config, Parity};

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
    let Some(factors) = patch.factors() else { return Counts::default() };
    let [points, lines, triangles] = match (patch, factors) {
        (_, PatchFactors::Isoline(factors)) => isoline(factors),
        (ProcessedPatch::Minimum(_), PatchFactors::Triangle(_)) => [3, 2, 1],
        (ProcessedPatch::Minimum(_), PatchFactors::Quad(_)) => [4, 3, 2],
        (_, PatchFactors::Triangle(factors)) => triangle(factors),
        (_, PatchFactors::Quad(factors)) => quad(factors),
    };
    let each = config.output.indices_per_primitive(factors.domain());
    let primitives = match each {
        1 => points,
        2 => lines,
        _ => triangles,
    };
    Counts { points, primitives, indices: primitives * each }
}

/// The numbers of points, of lines that join them, and of triangles.
type Sizes = [u32; 3];

/// The lines of an isoline patch are not joined to each other.
fn isoline(factors: &IsolineFactors<ProcessedFactor>) -> Sizes {
    let lines = line_count(factors);
    let points = factors.detail.context.points;
    [lines * points, lines * (points - 1), 0]
}

fn triangle(factors: &TriangleFactors<ProcessedFactor>) -> Sizes {
    let boundary = factors.outer_contexts().iter().map(|context| context.points - 1).sum();
    let half = factors.inside.context.points / 2;
    let interior = match factors.inside.context.parity {
        Parity::Odd => 3 * (half - 1) * (half - 1),
        Parity::Even => 3 * half * (half - 1) + 1,
    };
    of_disc(boundary, interior)
}

fn quad(factors: &QuadFactors<ProcessedFactor>) -> Sizes {
    let boundary = factors.outer_contexts().iter().map(|context| context.points - 1).sum();
    let [u, v] = factors.inside().map(|factor| factor.context.points);
    of_disc(boundary, (u - 2) * (v - 2))
}

/// Sizes by Euler's formula for a disc: triangles = 2 * points - 2 - boundary. As line output, a
/// polyline joins all points in order: points - 1 segments.
const fn of_disc(boundary: u32, interior: u32) -> Sizes {
    let points = boundary + interior;
    [points, points - 1, 2 * points - 2 - boundary]
}

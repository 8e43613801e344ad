//! Output sizes of eight patches, by formula (spec section 12.6).

use crate::factors::Processed;
use crate::lanes::{Column, LANES, Lanes, factor, is_odd, outer_factors};
use tess_core::{Config, Domain, OutputPrimitive};

/// Points and indices of each patch of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockCounts {
    pub(crate) points: Lanes,
    pub(crate) indices: Lanes,
}

/// Predicts the output sizes of a block.
#[inline(always)]
pub(crate) fn counts(
    config: Config,
    domain: Domain,
    processed: &Processed,
    points: &Column,
) -> BlockCounts {
    let mut counts = BlockCounts { points: [0; LANES], indices: [0; LANES] };
    for lane in 0..LANES {
        let n = |f: usize| factor(points, f)[lane];
        let minimum = processed.minimum[lane] == 1;
        let boundary: u32 = (0..outer_factors(domain)).map(|edge| n(edge).wrapping_sub(1)).sum();
        let (points, lines, triangles) = match domain {
            Domain::Isoline => {
                let lines = n(0).wrapping_sub(1);
                (lines * n(1), lines * n(1).wrapping_sub(1), 0)
            }
            Domain::Triangle => {
                let half = n(3) / 2;
                let odd = is_odd(n(3));
                let rings = 3 * half.wrapping_sub(1);
                let interior = if odd { rings * half.wrapping_sub(1) } else { rings * half + 1 };
                disc(boundary, if minimum { 0 } else { interior })
            }
            Domain::Quad => {
                let interior = n(4).wrapping_sub(2) * n(5).wrapping_sub(2);
                disc(boundary, if minimum { 0 } else { interior })
            }
        };
        let indices = match (config.output, domain) {
            (OutputPrimitive::Point, _) => points,
            (OutputPrimitive::Line, _) | (_, Domain::Isoline) => 2 * lines,
            (OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw, _) => 3 * triangles,
        };
        counts.points[lane] = points * processed.alive[lane];
        counts.indices[lane] = indices * processed.alive[lane];
    }
    counts
}

/// Points, lines that join them in order, and triangles: Euler's formula for a disc.
#[inline(always)]
const fn disc(boundary: u32, interior: u32) -> (u32, u32, u32) {
    let points = boundary.wrapping_add(interior);
    (points, points.wrapping_sub(1), (2 * points).wrapping_sub(2).wrapping_sub(boundary))
}

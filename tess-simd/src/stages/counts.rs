//! Output sizes of a packet, by formula (spec section 12.6).

use crate::data::lanes::{Column, EdgePoints, LANES, Lanes, factor, is_odd};
use crate::stages::factors::Processed;
use tess_core::{Config, Counts, Domain, OutputPrimitive};

/// Points and indices of each patch of a packet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PacketCounts {
    pub(crate) points: Lanes,
    pub(crate) indices: Lanes,
}

/// Output sizes of a part of a batch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PartCounts {
    pub(crate) points: u64,
    pub(crate) indices: u64,
    /// Points of its largest patch.
    pub(crate) largest: u32,
}

impl PartCounts {
    /// The counts of all parts together.
    pub(crate) fn sum(parts: &[Self]) -> Self {
        parts.iter().fold(Self::default(), |sum, part| Self {
            points: sum.points + part.points,
            indices: sum.indices + part.indices,
            largest: sum.largest.max(part.largest),
        })
    }

    /// The size of the output in the widest formats.
    #[cfg(feature = "rayon")]
    pub(crate) const fn bytes(&self) -> u64 {
        8 * self.points + 4 * self.indices
    }
}

/// Predicts the output sizes of a packet.
#[inline(always)]
pub(crate) fn counts(
    config: Config,
    domain: Domain,
    processed: &Processed,
    points: &Column,
) -> PacketCounts {
    let each = indices_each(config.output, domain);
    match domain {
        Domain::Isoline => of_each_lane(each, processed, |lane| isoline(of_lane(points, lane))),
        Domain::Triangle => of_each_lane(each, processed, |lane| {
            triangle(of_lane(points, lane), processed.minimum[lane])
        }),
        Domain::Quad => of_each_lane(each, processed, |lane| {
            quad(of_lane(points, lane), processed.minimum[lane])
        }),
    }
}

/// Points, lines that join them in order, and triangles of a patch.
type Sizes = [u32; 3];

/// Indices for each of these.
#[inline(always)]
const fn indices_each(output: OutputPrimitive, domain: Domain) -> Sizes {
    match output.indices_per_primitive(domain) {
        1 => [1, 0, 0],
        2 => [0, 2, 0],
        _ => [0, 0, 3],
    }
}

/// The counts of a packet from the sizes that they have unless they are culled.
#[inline(always)]
fn of_each_lane(
    indices_each: Sizes,
    processed: &Processed,
    sizes: impl Fn(usize) -> Sizes,
) -> PacketCounts {
    let mut counts = PacketCounts { points: [0; LANES], indices: [0; LANES] };
    for lane in 0..LANES {
        let [points, lines, triangles] = sizes(lane);
        let [per_point, per_line, per_triangle] = indices_each;
        let indices = per_point * points + per_line * lines + per_triangle * triangles;
        counts.points[lane] = points * processed.alive[lane];
        counts.indices[lane] = indices * processed.alive[lane];
    }
    counts
}

/// The output sizes of one patch, which is not culled.
#[inline(always)]
pub(crate) fn counts_of_patch(
    config: Config,
    domain: Domain,
    edges: &EdgePoints,
    minimum: u32,
) -> Counts {
    let of = |factor: usize| edges[factor];
    let sizes = match domain {
        Domain::Isoline => isoline(of),
        Domain::Triangle => triangle(of, minimum),
        Domain::Quad => quad(of, minimum),
    };
    let each = indices_each(config.output, domain);
    let (mut primitives, mut indices) = (0, 0);
    for (size, each) in sizes.into_iter().zip(each) {
        primitives += size * each.min(1);
        indices += size * each;
    }
    Counts { points: sizes[0], primitives, indices }
}

/// The point counts of a lane.
#[inline(always)]
fn of_lane(points: &Column, lane: usize) -> impl Fn(usize) -> u32 {
    move |number| factor(points, number)[lane]
}

#[inline(always)]
fn isoline(points: impl Fn(usize) -> u32) -> Sizes {
    let (density, detail) = (points(0), points(1));
    let lines = density.wrapping_sub(1);
    [lines.wrapping_mul(detail), lines.wrapping_mul(detail.wrapping_sub(1)), 0]
}

#[inline(always)]
fn triangle(n: impl Fn(usize) -> u32, minimum: u32) -> Sizes {
    let half = n(3) / 2;
    let odd = u32::from(is_odd(n(3)));
    let rings = half.wrapping_sub(1).wrapping_mul(3);
    let interior = rings.wrapping_mul(half.wrapping_sub(odd)).wrapping_add(1 - odd);
    disc(n(0).wrapping_add(n(1)).wrapping_add(n(2)).wrapping_sub(3), interior, minimum)
}

#[inline(always)]
fn quad(n: impl Fn(usize) -> u32, minimum: u32) -> Sizes {
    let boundary = n(0).wrapping_add(n(1)).wrapping_add(n(2)).wrapping_add(n(3)).wrapping_sub(4);
    disc(boundary, n(4).wrapping_sub(2).wrapping_mul(n(5).wrapping_sub(2)), minimum)
}

/// The sizes of a patch with these points on its boundary and, unless it is a minimum patch,
/// inside: Euler's formula for a disc.
#[inline(always)]
const fn disc(boundary: u32, interior: u32, minimum: u32) -> Sizes {
    let points = boundary.wrapping_add(interior.wrapping_mul(1 - minimum));
    [points, points.wrapping_sub(1), (2 * points).wrapping_sub(2).wrapping_sub(boundary)]
}

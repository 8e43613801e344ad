//! Output sizes, by formula (spec section 12.6).

use crate::data::lanes::{LANES, is_odd};
use crate::stages::factors::Processed;
use tess_core::{Config, Counts, Domain, OutputPrimitive};

/// Points and indices of each of `L` patches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PacketCounts<const L: usize = LANES> {
    pub(crate) points: [u32; L],
    pub(crate) indices: [u32; L],
}

/// Output sizes of a part of a batch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PartCounts {
    pub(crate) points: u64,
    pub(crate) indices: u64,
    /// Points of the part's largest patch.
    pub(crate) largest: u32,
    /// Length of the run of equal patches at the part's beginning; 1 or less if it is not known or
    /// not worth copying.
    pub(crate) run: usize,
}

impl From<Counts> for PartCounts {
    /// The counts of a part of one patch.
    fn from(Counts { points, indices, .. }: Counts) -> Self {
        Self { points: points.into(), indices: indices.into(), largest: points, run: 1 }
    }
}

impl PartCounts {
    /// The counts of all parts together.
    pub(crate) fn sum(parts: &[Self]) -> Self {
        parts.iter().fold(Self::default(), |sum, part| Self {
            points: sum.points + part.points,
            indices: sum.indices + part.indices,
            largest: sum.largest.max(part.largest),
            run: 0,
        })
    }

    /// The counts of `run` equal patches, from the counts of one.
    #[inline(always)]
    pub(crate) const fn times(self, run: usize) -> Self {
        let Self { points, indices, largest, .. } = self;
        Self { points: run as u64 * points, indices: run as u64 * indices, largest, run }
    }

    /// The size of the output in the widest formats.
    #[cfg(feature = "rayon")]
    pub(crate) const fn bytes(&self) -> u64 {
        8 * self.points + 4 * self.indices
    }
}

/// Predicts the output sizes of patches whose factors have these points; zeros for culled patches.
#[inline(always)]
pub(crate) fn counts<const L: usize, const F: usize>(
    config: Config,
    domain: Domain,
    processed: &Processed<L, F>,
    points: &[[u32; L]; F],
) -> PacketCounts<L> {
    let each = indices_each(config.output, domain);
    let mut counts = PacketCounts { points: [0; L], indices: [0; L] };
    for lane in 0..L {
        let (minimum, alive) = (processed.minimum[lane], processed.alive[lane]);
        let of = |factor: usize| points[factor][lane];
        let [points, lines, triangles] = match domain {
            Domain::Isoline => isoline(of),
            Domain::Triangle => triangle(of, minimum),
            Domain::Quad => quad(of, minimum),
        };
        let indices = each[0] * points + each[1] * lines + each[2] * triangles;
        counts.points[lane] = points * alive;
        counts.indices[lane] = indices * alive;
    }
    counts
}

/// The numbers of a patch's points, of lines that join them in order, and of triangles.
type Elements = [u32; 3];

/// The indices of each kind of element that the output has; 0 for the other kinds.
#[inline(always)]
const fn indices_each(output: OutputPrimitive, domain: Domain) -> Elements {
    match output.indices_per_primitive(domain) {
        1 => [1, 0, 0],
        2 => [0, 2, 0],
        _ => [0, 0, 3],
    }
}

impl PacketCounts<1> {
    /// The sizes of the patch. The divisors are constants, so no division instruction remains.
    #[inline(always)]
    pub(crate) const fn of_patch(self, config: Config, domain: Domain) -> Counts {
        let Self { points: [points], indices: [indices] } = self;
        let primitives = match config.output.indices_per_primitive(domain) {
            1 => indices,
            2 => indices / 2,
            _ => indices / 3,
        };
        Counts { points, primitives, indices }
    }
}

#[inline(always)]
fn isoline(points: impl Fn(usize) -> u32) -> Elements {
    let (density, detail) = (points(0), points(1));
    let lines = density.wrapping_sub(1);
    [lines.wrapping_mul(detail), lines.wrapping_mul(detail.wrapping_sub(1)), 0]
}

#[inline(always)]
fn triangle(n: impl Fn(usize) -> u32, minimum: u32) -> Elements {
    let half = n(3) / 2;
    let odd = u32::from(is_odd(n(3)));
    let rings = half.wrapping_sub(1).wrapping_mul(3);
    let interior = rings.wrapping_mul(half.wrapping_sub(odd)).wrapping_add(1 - odd);
    disc(n(0).wrapping_add(n(1)).wrapping_add(n(2)).wrapping_sub(3), interior, minimum)
}

#[inline(always)]
fn quad(n: impl Fn(usize) -> u32, minimum: u32) -> Elements {
    let boundary = n(0).wrapping_add(n(1)).wrapping_add(n(2)).wrapping_add(n(3)).wrapping_sub(4);
    disc(boundary, n(4).wrapping_sub(2).wrapping_mul(n(5).wrapping_sub(2)), minimum)
}

/// The sizes of a patch with these points on its boundary and inside, by Euler's formula for a
/// disc. A minimum patch has no points inside.
#[inline(always)]
const fn disc(boundary: u32, interior: u32, minimum: u32) -> Elements {
    let points = boundary.wrapping_add(interior.wrapping_mul(1 - minimum));
    [points, points.wrapping_sub(1), (2 * points).wrapping_sub(2).wrapping_sub(boundary)]
}

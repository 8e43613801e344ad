//! A block of patches after the front end: factors, contexts and counts.

use crate::batch::{Batch, Chunk};
use crate::counts::{BlockCounts, counts};
use crate::factor_context::{Context, Spacings, point_counts};
use crate::factors::process;
use crate::lanes::{Column, EdgePoints, LANES, Lanes, is_odd};
use crate::place::Spacing;
use tess_core::{Config, Domain, Partitioning};

/// Blocks that go through the front end in one call.
pub(crate) const BLOCKS: usize = Chunk::PATCHES / LANES;

/// Sixteen patches of one domain after factor processing, their output sizes known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    config: Config,
    domain: Domain,
    fixed: Column,
    points: Column,
    spacings: Spacings,
    minimum: Lanes,
    topologies: Lanes<u64>,
    pub(crate) counts: BlockCounts,
}

/// Takes patches from `first` on through the front end, as many as there is room for; those past
/// the end of the batch count as culled.
#[inline(always)]
pub(crate) fn process_blocks(
    config: Config,
    batch: &Batch<'_>,
    first: usize,
    blocks: &mut [Block; BLOCKS],
) {
    let mut chunk = Chunk::EMPTY;
    chunk.load(batch, first);
    for (number, block) in blocks.iter_mut().enumerate() {
        if first + number * LANES >= batch.len() {
            break;
        }
        *block = Block::new(config, batch.domain(), &chunk.block(number));
    }
}

impl Block {
    /// A block of culled patches.
    pub(crate) const EMPTY: Self = Self {
        config: Config::new(Partitioning::Integer, tess_core::OutputPrimitive::Point),
        domain: Domain::Quad,
        fixed: [0; _],
        points: [0; _],
        spacings: Spacings::NONE,
        minimum: [0; _],
        topologies: [0; _],
        counts: BlockCounts { points: [0; _], indices: [0; _] },
    };

    /// Processes the raw factors of a block; zeros count as culled.
    #[inline(always)]
    pub(crate) fn new(config: Config, domain: Domain, raw: &Column<f32>) -> Self {
        match domain {
            Domain::Isoline => Self::of_factors::<{ 2 * LANES }>(config, domain, raw),
            Domain::Triangle => Self::of_factors::<{ 4 * LANES }>(config, domain, raw),
            Domain::Quad => Self::of_factors::<{ 6 * LANES }>(config, domain, raw),
        }
    }

    /// [`Block::new`] for patches whose factors are the first `ALL` elements of a column.
    #[inline(always)]
    fn of_factors<const ALL: usize>(config: Config, domain: Domain, raw: &Column<f32>) -> Self {
        let processed = process(config, domain, raw);
        let points = point_counts::<ALL>(&processed.fixed, &processed.odd);
        // Where factors are integers, few spacings are ever needed: see `Block::spacing`.
        let spacings = if config.partitioning.has_integer_factors() {
            Spacings::NONE
        } else {
            Spacings::new::<ALL>(&processed.fixed, &processed.odd, config.split)
        };
        let counts = counts(config, domain, &processed, &points);
        let topologies = topologies(&points, &processed.minimum);
        let (fixed, minimum) = (processed.fixed, processed.minimum);
        Self { config, domain, fixed, points, spacings, minimum, topologies, counts }
    }

    /// The domain of its patches.
    #[inline(always)]
    pub(crate) const fn domain(&self) -> Domain {
        self.domain
    }

    /// Whether all factors are integers, so that a point count says all about a factor.
    #[inline(always)]
    pub(crate) const fn integer(&self) -> bool {
        self.config.partitioning.has_integer_factors()
    }

    /// Whether a patch is a minimum patch.
    #[inline(always)]
    pub(crate) const fn is_minimum(&self, lane: usize) -> bool {
        self.minimum[lane] == 1
    }

    /// A number for each topology of a domain, not 0.
    #[inline(always)]
    pub(crate) const fn topology(&self, lane: usize) -> u64 {
        self.topologies[lane]
    }

    /// The point counts of a patch's factors.
    #[inline(always)]
    pub(crate) fn edges(&self, lane: usize) -> EdgePoints {
        let points = |factor| self.edge_points(factor, lane);
        [points(0), points(1), points(2), points(3), points(4), points(5)]
    }

    /// The point count of one factor.
    #[inline(always)]
    pub(crate) const fn edge_points(&self, factor: usize, lane: usize) -> u32 {
        self.points[factor * LANES + lane]
    }

    /// A number that tells contexts of one split order apart; not 0.
    #[inline(always)]
    pub(crate) const fn key(&self, factor: usize, lane: usize) -> u32 {
        let i = factor * LANES + lane;
        (self.fixed[i] << 1) | (self.points[i] & 1)
    }

    /// The spacing of one factor's points.
    #[inline(always)]
    pub(crate) fn spacing(&self, factor: usize, lane: usize) -> Spacing {
        let i = factor * LANES + lane;
        if self.integer() {
            let odd = u32::from(is_odd(self.points[i]));
            Spacing::new(&Context::new(self.fixed[i], odd, self.config.split))
        } else {
            self.spacings.get(i, self.points[i])
        }
    }
}

/// A number for each topology: the point counts of all factors, after a leading 1, and whether it
/// is a minimum patch.
#[inline(always)]
fn topologies(points: &Column, minimum: &Lanes) -> Lanes<u64> {
    let mut topologies = [1; LANES];
    for points in points.as_chunks::<LANES>().0 {
        for (topology, &points) in topologies.iter_mut().zip(points) {
            *topology = (*topology << 7) | u64::from(points);
        }
    }
    for (topology, &minimum) in topologies.iter_mut().zip(minimum) {
        *topology = (*topology << 1) | u64::from(minimum);
    }
    topologies
}

//! A block of eight patches after the front end: factors, contexts and counts.

use crate::batch::Batch;
use crate::counts::{BlockCounts, counts};
use crate::factor_context::{Context, Contexts, point_counts};
use crate::factors::process;
use crate::lanes::{Column, EdgePoints, LANES, Lanes};
use tess_core::{Config, Domain, Partitioning};

/// Eight patches of one domain after factor processing, their output sizes known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    config: Config,
    domain: Domain,
    fixed: Column,
    odd: Column,
    points: Column,
    minimum: Lanes,
    pub(crate) counts: BlockCounts,
}

impl Block {
    /// Processes patches `first..first + LANES` of a batch; those past its end count as culled.
    #[inline(always)]
    pub(crate) fn new(config: Config, batch: &Batch<'_>, first: usize) -> Self {
        let domain = batch.domain();
        let processed = process(config, domain, &batch.load(first));
        let (fixed, odd) = (processed.fixed, processed.odd);
        let points = match domain {
            Domain::Isoline => point_counts::<{ 2 * LANES }>(&fixed, &odd),
            Domain::Triangle => point_counts::<{ 4 * LANES }>(&fixed, &odd),
            Domain::Quad => point_counts::<{ 6 * LANES }>(&fixed, &odd),
        };
        let counts = counts(config, domain, &processed, &points);
        Self { config, domain, fixed, odd, points, minimum: processed.minimum, counts }
    }

    /// The contexts of its factors. Where factors are integers, few are ever needed, and
    /// [`Block::context`] computes them one by one.
    #[inline(always)]
    pub(crate) fn contexts(&self) -> Contexts {
        let Self { config, fixed, odd, .. } = self;
        if self.integer() {
            return Contexts::NONE;
        }
        match self.domain {
            Domain::Isoline => Contexts::new::<{ 2 * LANES }>(fixed, odd, config.split),
            Domain::Triangle => Contexts::new::<{ 4 * LANES }>(fixed, odd, config.split),
            Domain::Quad => Contexts::new::<{ 6 * LANES }>(fixed, odd, config.split),
        }
    }

    /// The domain of its patches.
    #[inline(always)]
    pub(crate) const fn domain(&self) -> Domain {
        self.domain
    }

    /// Whether all factors are integers, so that a point count says all about a factor.
    #[inline(always)]
    pub(crate) const fn integer(&self) -> bool {
        matches!(self.config.partitioning, Partitioning::Integer | Partitioning::Pow2)
    }

    /// Whether a patch is a minimum patch.
    #[inline(always)]
    pub(crate) const fn is_minimum(&self, lane: usize) -> bool {
        self.minimum[lane] == 1
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
        (self.fixed[i] << 1) | self.odd[i]
    }

    /// The context of one factor; `contexts` are this block's.
    #[inline(always)]
    pub(crate) fn context(&self, contexts: &Contexts, factor: usize, lane: usize) -> Context {
        let i = factor * LANES + lane;
        if self.integer() {
            Context::new(self.fixed[i], self.odd[i], self.config.split)
        } else {
            contexts.get(i, self.odd[i])
        }
    }
}

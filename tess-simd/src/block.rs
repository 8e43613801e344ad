//! A block of eight patches after the front end: factors, contexts and counts.

use crate::batch::Batch;
use crate::counts::{BlockCounts, counts};
use crate::factor_context::{Context, Contexts};
use crate::factors::process;
use crate::lanes::{Column, EdgePoints, LANES, factors};
use tess_core::{Config, Domain, Partitioning};

/// Eight patches of one domain, ready to be emitted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    domain: Domain,
    partitioning: Partitioning,
    fixed: Column,
    minimum: [u32; LANES],
    contexts: Contexts,
    pub(crate) counts: BlockCounts,
}

impl Block {
    /// Processes patches `first..first + LANES` of a batch; those past its end count as culled.
    #[inline(always)]
    pub(crate) fn new(config: Config, batch: &Batch<'_>, first: usize) -> Self {
        let domain = batch.domain();
        let processed = process(config, domain, &batch.load(first));
        let columns = LANES * factors(domain);
        let contexts = Contexts::new(&processed.fixed, &processed.odd, columns, config.split);
        Self {
            domain,
            partitioning: config.partitioning,
            fixed: processed.fixed,
            minimum: processed.minimum,
            counts: counts(config, domain, &processed, &contexts),
            contexts,
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
        matches!(self.partitioning, Partitioning::Integer | Partitioning::Pow2)
    }

    /// Whether a patch is a minimum patch.
    #[inline(always)]
    pub(crate) const fn is_minimum(&self, lane: usize) -> bool {
        self.minimum[lane] == 1
    }

    /// The point counts of a patch's factors.
    #[inline(always)]
    pub(crate) fn edges(&self, lane: usize) -> EdgePoints {
        core::array::from_fn(|factor| self.edge_points(factor, lane))
    }

    /// The point count of one factor.
    #[inline(always)]
    pub(crate) const fn edge_points(&self, factor: usize, lane: usize) -> u32 {
        self.contexts.points[factor * LANES + lane]
    }

    /// A number that tells contexts of one split order apart; not 0.
    #[inline(always)]
    pub(crate) const fn key(&self, factor: usize, lane: usize) -> u32 {
        let i = factor * LANES + lane;
        (self.fixed[i] << 1) | self.contexts.odd[i]
    }

    /// The context of one factor.
    #[inline(always)]
    pub(crate) fn context(&self, factor: usize, lane: usize) -> Context {
        self.contexts.get(factor, lane)
    }

    /// The factor as 15.16 number; of a culled patch unspecified.
    #[inline(always)]
    pub(crate) const fn fixed(&self, factor: usize, lane: usize) -> u32 {
        self.fixed[factor * LANES + lane]
    }
}

//! What the stages are run on, and their results in both forms.

use crate::by_wide;
use crate::data::lanes::{Column, LANES};
use crate::levels::{self, ALL, Factors};
use crate::stages::factors::Processed;
use crate::stages::place::{Locations, Spacing, Spacings};
use std::hint::black_box;
use tess_core::{Partitioning, SplitOrder};
use tess_simd::Level;
use tess_verify::random::SplitMix64;

/// Blocks that are timed: their inputs and results fit the first cache.
const BLOCKS: usize = 8;

/// Which form of a stage runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Arrays,
    Wide,
}

/// A stage of the front end.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Stage {
    /// Factor processing (spec section 3).
    Factors(Partitioning),
    /// Contexts (spec section 4), and the spacings that follow from them.
    Contexts(SplitOrder),
    /// Locations of all points of an edge (spec section 5).
    Locations,
}

impl Stage {
    /// The stages of the table.
    pub(crate) const TIMED: [Self; 4] = [
        Self::Factors(Partitioning::Integer),
        Self::Factors(Partitioning::FractionalOdd),
        Self::Contexts(SplitOrder::Ruler),
        Self::Locations,
    ];

    /// Its name in the table.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Factors(partitioning) if partitioning.has_integer_factors() => "factors, integer",
            Self::Factors(_) => "factors, fractional",
            Self::Contexts(_) => "contexts",
            Self::Locations => "locations",
        }
    }
}

/// Inputs of each stage, block by block or edge by edge, and results of the arrays and of `wide`.
#[derive(Debug)]
pub(crate) struct Work {
    level: Level,
    pub(crate) raw: Vec<Column<f32>>,
    pub(crate) factors: Vec<Factors>,
    pub(crate) edges: Vec<Spacing>,
    pub(crate) processed: [Vec<Processed>; 2],
    pub(crate) contexts: (Vec<(Spacings, Column)>, Vec<by_wide::Spacings>),
    pub(crate) locations: (Vec<Locations>, Vec<by_wide::Locations>),
}

impl Work {
    /// Room for results of these inputs.
    pub(crate) fn new(
        level: Level,
        raw: Vec<Column<f32>>,
        factors: Vec<Factors>,
        edges: Vec<Spacing>,
    ) -> Self {
        const NONE: Processed =
            Processed { fixed: [0; ALL], odd: [0; ALL], alive: [0; LANES], minimum: [0; LANES] };
        let processed = [vec![NONE; raw.len()], vec![NONE; raw.len()]];
        let arrays = vec![(Spacings::NONE, [0; ALL]); factors.len()];
        let contexts = (arrays, vec![by_wide::Spacings::NONE; factors.len()]);
        let arrays = vec![Locations::EMPTY; edges.len()];
        let locations = (arrays, vec![by_wide::Locations::EMPTY; edges.len()]);
        Self { level, raw, factors, edges, processed, contexts, locations }
    }

    /// What is timed: quads of fractional odd factors at random from 1 to 63, and the edges of one block.
    pub(crate) fn at_random(level: Level) -> Self {
        let mut random = SplitMix64::new(1);
        let mut column = || -> Column { [(); ALL].map(|()| 0x1_0000 + random.below(62 << 16)) };
        let fixed: Vec<Column> = (0..BLOCKS).map(|_| column()).collect();
        let raw = fixed.iter().map(|fixed| fixed.map(to_float)).collect();
        let factors: Vec<_> =
            fixed.into_iter().map(|fixed| Factors { fixed, odd: [1; ALL] }).collect();
        let mut spacings = by_wide::Spacings::NONE;
        spacings.fill(&factors[0].fixed, &factors[0].odd, SplitOrder::Ruler);
        let edges = (0..ALL).map(|i| spacings.get(i)).collect();
        Self::new(level, raw, factors, edges)
    }

    /// The CPU level that the stages run at.
    pub(crate) const fn level(&self) -> Level {
        self.level
    }

    /// Runs one form of a stage on all of its inputs.
    pub(crate) fn run(&mut self, stage: Stage, form: Form) {
        let Self { level, raw, factors, edges, processed, contexts, locations } = self;
        let (level, [arrays, wide]) = (*level, processed);
        let (raw, factors, edges) = black_box((&raw[..], &factors[..], &edges[..]));
        match (stage, form) {
            (Stage::Factors(partitioning), Form::Arrays) => {
                levels::factors_by_arrays(level, partitioning, raw, arrays);
            }
            (Stage::Factors(partitioning), Form::Wide) => {
                levels::factors_by_wide(level, partitioning, raw, wide);
            }
            (Stage::Contexts(order), Form::Arrays) => {
                levels::contexts_by_arrays(level, order, factors, &mut contexts.0);
            }
            (Stage::Contexts(order), Form::Wide) => {
                levels::contexts_by_wide(level, order, factors, &mut contexts.1);
            }
            (Stage::Locations, Form::Arrays) => {
                levels::locations_by_arrays(level, edges, &mut locations.0);
            }
            (Stage::Locations, Form::Wide) => {
                levels::locations_by_wide(level, edges, &mut locations.1);
            }
        }
    }

    /// Runs both forms.
    pub(crate) fn run_both(&mut self, stage: Stage) {
        self.run(stage, Form::Arrays);
        self.run(stage, Form::Wide);
    }

    /// Blocks, or edges, that a run of a stage has.
    pub(crate) const fn len(&self, stage: Stage) -> usize {
        match stage {
            Stage::Factors(_) => self.raw.len(),
            Stage::Contexts(_) => self.factors.len(),
            Stage::Locations => self.edges.len(),
        }
    }
}

/// A fixed-point factor as a number.
#[expect(
    clippy::cast_precision_loss,
    clippy::float_arithmetic,
    reason = "below 2^22, so all of it is exact"
)]
fn to_float(fixed: u32) -> f32 {
    fixed as f32 / 65536.0
}

#[cfg(test)]
impl Work {
    /// Changes one bit of what `wide` gave.
    pub(crate) fn plant_fault(&mut self, stage: Stage) {
        match stage {
            Stage::Factors(_) => self.processed[1][3].fixed[40] ^= 1,
            Stage::Contexts(_) => self.contexts.1[3].points[40] ^= 1,
            Stage::Locations => self.locations.1[40].0[0] ^= 1,
        }
    }
}

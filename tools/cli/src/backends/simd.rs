//! `tess-simd` as a backend under test.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use tess_core::{
    Config, DomainPoint, FactorContext, FixedFactor, Parity, Partitioning, PatchFactors,
    SplitOrder, Tessellation,
};
use tess_simd::{IndexFormat, Level, LevelUnavailableError, Numbering, Output, Tessellator};
use tess_verify::{Answers, Backend, BackendError};

/// `tess-simd` at one CPU level, with indices of 16 or 32 bits.
#[derive(Debug)]
pub(crate) struct Simd<I> {
    level: Level,
    /// One tessellator per configuration used so far.
    tessellators: HashMap<Config, Tessellator>,
    output: Output<DomainPoint, I>,
}

impl<I: IndexFormat> Simd<I> {
    /// A backend that runs at `level`. Errors: this machine cannot run that level.
    pub(crate) fn with_level(level: Level) -> Result<Self, LevelUnavailableError> {
        level.require()?;
        Ok(Self { level, tessellators: HashMap::new(), output: Output::new() })
    }
}

impl<I: IndexFormat + Into<u32>> Backend for Simd<I> {
    fn name(&self) -> &'static str {
        "simd"
    }

    fn device(&self) -> String {
        self.level.to_string()
    }

    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation> {
        let Self { level, tessellators, output } = self;
        let tessellator = match tessellators.entry(config) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                new.insert(Tessellator::with_level(config, *level).map_err(BackendError::new)?)
            }
        };
        let mut all = Vec::with_capacity(patches.len());
        // Batches are small, because a batch's points and indices must be countable in 32 bits.
        for batch in patches.chunks(4096) {
            tessellator
                .tessellate(batch, Numbering::PerPatch, output)
                .map_err(BackendError::new)?;
            let whole = (0..output.ranges().len()).filter_map(|patch| output.patch(patch));
            all.extend(whole.map(|(points, indices)| Tessellation {
                points: points.to_vec(),
                indices: indices.iter().map(|&index| index.into()).collect(),
            }));
        }
        Ok(all)
    }

    fn fixed_factors(
        &mut self,
        partitioning: Partitioning,
        values: &[f32],
    ) -> Answers<[FixedFactor; 2]> {
        tess_simd::fixed_factors(self.level, partitioning, values).map_err(BackendError::new)
    }

    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Answers<FactorContext> {
        tess_simd::contexts(self.level, split, parity, factors).map_err(BackendError::new)
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Answers<u32> {
        tess_simd::locations(self.level, contexts).map_err(BackendError::new)
    }
}

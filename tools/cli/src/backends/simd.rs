//! The SIMD backend as a backend under test.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use tess_core::{
    Config, Domain, DomainPoint, FactorContext, FixedFactor, IsolineFactors, Parity, Partitioning,
    PatchFactors, QuadFactors, SplitOrder, Tessellation, TriangleFactors,
};
use tess_simd::{Batch, IndexFormat, Level, LevelUnavailable, Numbering, Output, Tessellator};
use tess_verify::backend::{Backend, BackendError};

/// `tess-simd` at one CPU level, with indices of 16 or 32 bits.
#[derive(Debug)]
pub(crate) struct Simd<I> {
    level: Level,
    /// One for each configuration that was asked for.
    tessellators: HashMap<Config, Tessellator>,
    output: Output<DomainPoint, I>,
}

impl<I: IndexFormat> Simd<I> {
    /// A backend that runs at `level`.
    ///
    /// # Errors
    /// This machine cannot run that level.
    pub(crate) fn with_level(level: Level) -> Result<Self, LevelUnavailable> {
        if !level.is_available() {
            return Err(LevelUnavailable(level));
        }
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

    fn tessellate(
        &mut self,
        config: Config,
        patches: &[PatchFactors],
    ) -> Result<Vec<Tessellation>, BackendError> {
        let Self { level, tessellators, output } = self;
        let tessellator = match tessellators.entry(config) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => {
                new.insert(Tessellator::with_level(config, *level).map_err(unavailable)?)
            }
        };
        let patches = Patches::new(patches)?;
        let mut all = Vec::with_capacity(patches.len());
        // Small batches: a batch's points and indices must be countable in 32 bits.
        const BATCH: usize = 4096;
        for first in (0..patches.len()).step_by(BATCH) {
            let batch = patches.batch(first, BATCH);
            tessellator
                .tessellate(batch, Numbering::PerPatch, output)
                .map_err(|error| BackendError::new(error.to_string()))?;
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
    ) -> Result<Vec<[FixedFactor; 2]>, BackendError> {
        tess_simd::fixed_factors(self.level, partitioning, values).map_err(unavailable)
    }

    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Result<Vec<FactorContext>, BackendError> {
        tess_simd::contexts(self.level, split, parity, factors).map_err(unavailable)
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Result<Vec<u32>, BackendError> {
        tess_simd::locations(self.level, contexts).map_err(unavailable)
    }
}

fn unavailable(error: LevelUnavailable) -> BackendError {
    BackendError::new(error.to_string())
}

/// Patches of one domain in the layout that the backend takes.
#[derive(Debug)]
pub(crate) enum Patches {
    /// Isolines.
    Isolines(Vec<IsolineFactors>),
    /// Triangles.
    Triangles(Vec<TriangleFactors>),
    /// Quads.
    Quads(Vec<QuadFactors>),
}

impl Patches {
    /// Sorts patches into the layout of the first one's domain.
    ///
    /// # Errors
    /// The patches are of several domains.
    pub(crate) fn new(patches: &[PatchFactors]) -> Result<Self, BackendError> {
        let mut all = match patches.first().map_or(Domain::Quad, PatchFactors::domain) {
            Domain::Isoline => Self::Isolines(Vec::with_capacity(patches.len())),
            Domain::Triangle => Self::Triangles(Vec::with_capacity(patches.len())),
            Domain::Quad => Self::Quads(Vec::with_capacity(patches.len())),
        };
        for patch in patches {
            match (&mut all, patch) {
                (Self::Isolines(all), PatchFactors::Isoline(factors)) => all.push(*factors),
                (Self::Triangles(all), PatchFactors::Triangle(factors)) => all.push(*factors),
                (Self::Quads(all), PatchFactors::Quad(factors)) => all.push(*factors),
                _ => return Err(BackendError::new("a batch has patches of one domain alone")),
            }
        }
        Ok(all)
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.batch(0, usize::MAX).len()
    }

    /// At most `count` of them, from `first` on, as a batch.
    pub(crate) fn batch(&self, first: usize, count: usize) -> Batch<'_> {
        match self {
            Self::Isolines(all) => Batch::Isolines(part(all, first, count)),
            Self::Triangles(all) => Batch::Triangles(part(all, first, count)),
            Self::Quads(all) => Batch::Quads(part(all, first, count)),
        }
    }
}

fn part<T>(all: &[T], first: usize, count: usize) -> &[T] {
    let rest = all.get(first..).unwrap_or_default();
    &rest[..count.min(rest.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixed_domains_are_refused() {
        let isoline = IsolineFactors { density: 1.0, detail: 2.0 };
        let triangle = TriangleFactors { u0: 1.0, v0: 1.0, w0: 1.0, inside: 2.0 };
        let mixed = [PatchFactors::Isoline(isoline), PatchFactors::Triangle(triangle)];
        let one = &mixed[..1];
        assert_eq!(Patches::new(one).map(|patches| patches.len()).ok(), Some(1), "one domain");
        assert!(Patches::new(&mixed).is_err(), "two domains");
    }
}

//! The raw factors of several blocks, factor by factor.

use crate::batch::{Batch, isoline, quad, triangle};
use crate::lanes::{Column, LANES, MAX_FACTORS};
use tess_core::{Domain, PatchFactors};

/// The factors of up to [`Chunk::PATCHES`] patches, factor by factor.
///
/// Blocks are read from here and not from the batch, because a wide load that follows the narrow
/// stores of its elements too closely waits for them.
#[derive(Clone, Debug)]
pub(crate) struct Chunk([[f32; Self::PATCHES]; MAX_FACTORS]);

impl Chunk {
    pub(crate) const BLOCKS: usize = 4;
    pub(crate) const PATCHES: usize = Self::BLOCKS * LANES;
    pub(crate) const EMPTY: Self = Self([[0.0; Self::PATCHES]; MAX_FACTORS]);

    /// Loads patches from `first` on, as many as there is room for. Factors are zero where the
    /// last block has no patch, or one of another domain.
    #[inline(always)]
    pub(crate) fn load(&mut self, batch: &Batch<'_>, first: usize) {
        match batch {
            Batch::Isolines(patches) => self.load_structures(patches, first, isoline),
            Batch::Triangles(patches) => self.load_structures(patches, first, triangle),
            Batch::Quads(patches) => self.load_structures(patches, first, quad),
            Batch::Patches(patches) => self.load_patches(batch.domain(), patches, first),
            Batch::IsolineColumns(columns) => self.load_columns(isoline(columns), first),
            Batch::TriangleColumns(columns) => self.load_columns(triangle(columns), first),
            Batch::QuadColumns(columns) => self.load_columns(quad(columns), first),
        }
    }

    #[inline(always)]
    fn load_patches(&mut self, domain: Domain, patches: &[PatchFactors], first: usize) {
        match domain {
            Domain::Isoline => self.load_structures(patches, first, |patch| match patch {
                PatchFactors::Isoline(factors) => isoline(factors),
                _ => [0.0; 2],
            }),
            Domain::Triangle => self.load_structures(patches, first, |patch| match patch {
                PatchFactors::Triangle(factors) => triangle(factors),
                _ => [0.0; 4],
            }),
            Domain::Quad => self.load_structures(patches, first, |patch| match patch {
                PatchFactors::Quad(factors) => quad(factors),
                _ => [0.0; 6],
            }),
        }
    }

    #[inline(always)]
    fn load_structures<F, const N: usize>(
        &mut self,
        patches: &[F],
        first: usize,
        factors: impl Fn(&F) -> [f32; N],
    ) {
        let patches = patches.get(first..).unwrap_or_default();
        let patches = patches.get(..Self::PATCHES).unwrap_or(patches);
        for (i, patch) in patches.iter().enumerate().take(Self::PATCHES) {
            for (values, factor) in self.0.iter_mut().zip(factors(patch)) {
                values[i] = factor;
            }
        }
        self.clear(patches.len());
    }

    #[inline(always)]
    fn load_columns<const N: usize>(&mut self, columns: [&[f32]; N], first: usize) {
        let count = columns.iter().map(|c| c.len()).min().unwrap_or(0);
        let mut loaded = 0;
        for (values, source) in self.0.iter_mut().zip(columns) {
            let source = source.get(first..count.min(first + Self::PATCHES)).unwrap_or_default();
            values[..source.len()].copy_from_slice(source);
            loaded = source.len();
        }
        self.clear(loaded);
    }

    /// Zeros from a patch to the end of its block.
    #[inline(always)]
    fn clear(&mut self, first: usize) {
        for i in first..first.next_multiple_of(LANES).min(Self::PATCHES) {
            for values in &mut self.0 {
                values[i] = 0.0;
            }
        }
    }

    /// The factors of the patches of a block, `number` blocks into the chunk.
    #[inline(always)]
    pub(crate) fn block(&self, number: usize) -> Column<f32> {
        let mut column = [0.0; LANES * MAX_FACTORS];
        for (lanes, values) in column.as_chunks_mut::<LANES>().0.iter_mut().zip(&self.0) {
            *lanes = values.as_chunks().0[number % Self::BLOCKS];
        }
        column
    }
}

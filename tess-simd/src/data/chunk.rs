//! The raw factors of several packets, factor by factor.

use crate::data::batch::Batch;
use crate::data::lanes::{Column, LANES, MAX_FACTORS};
use tess_core::{Domain, PatchFactors};

/// The factors of up to [`Chunk::PATCHES`] patches, factor by factor.
///
/// Packets are read from here and not from the batch, because a wide load stalls if its elements
/// were stored one by one a short time ago.
#[derive(Clone, Debug)]
pub(crate) struct Chunk([[f32; Self::PATCHES]; MAX_FACTORS]);

/// The work of one step: the patches of a chunk, or one patch that repeats.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// Patches to process, at most [`Chunk::PATCHES`]; 1 if the patch repeats.
    pub(crate) patches: usize,
    /// How many times these patches come in a row.
    pub(crate) times: usize,
}

impl Stretch {
    /// At this many equal patches and above, copying the output of one is faster than processing
    /// each.
    pub(crate) const WORTH_REPEATING: usize = 8;

    /// The next step of a batch, from patch `start`, which the batch has.
    #[inline(always)]
    pub(crate) fn new(batch: &Batch<'_>, start: usize) -> Self {
        let times = batch.run(start);
        if times >= Self::WORTH_REPEATING {
            Self { patches: 1, times }
        } else {
            Self { patches: Chunk::PATCHES.min(batch.len() - start), times: 1 }
        }
    }
}

impl Chunk {
    pub(crate) const PACKETS: usize = 4;
    pub(crate) const PATCHES: usize = Self::PACKETS * LANES;
    pub(crate) const EMPTY: Self = Self([[0.0; Self::PATCHES]; MAX_FACTORS]);

    /// Loads the first patches of a batch, at most a chunk. Lanes of the last packet that have no
    /// patch get zeros.
    #[inline(always)]
    pub(crate) fn load(&mut self, batch: &Batch<'_>) {
        match batch {
            Batch::Isolines(patches) => self.load_structures(patches, |&patch| Some(patch.into())),
            Batch::Triangles(patches) => self.load_structures(patches, |&patch| Some(patch.into())),
            Batch::Quads(patches) => self.load_structures(patches, |&patch| Some(patch.into())),
            Batch::Patches(patches) => self.load_patches(batch.domain(), patches),
            Batch::Columns(columns) => self.load_columns(columns, batch.len()),
        }
    }

    #[inline(always)]
    fn load_patches(&mut self, domain: Domain, patches: &[PatchFactors]) {
        match domain {
            Domain::Isoline => self.load_structures(patches, |patch| match *patch {
                PatchFactors::Isoline(factors) => Some(factors.into()),
                _ => None,
            }),
            Domain::Triangle => self.load_structures(patches, |patch| match *patch {
                PatchFactors::Triangle(factors) => Some(factors.into()),
                _ => None,
            }),
            Domain::Quad => self.load_structures(patches, |patch| match *patch {
                PatchFactors::Quad(factors) => Some(factors.into()),
                _ => None,
            }),
        }
    }

    #[inline(always)]
    fn load_structures<F, const N: usize>(
        &mut self,
        patches: &[F],
        factors: impl Fn(&F) -> Option<[f32; N]>,
    ) {
        let patches = patches.get(..Self::PATCHES).unwrap_or(patches);
        // Whole packets have their own loop, whose fixed length lets the compiler load them without
        // a remainder.
        let (whole, others) = patches.as_chunks::<LANES>();
        for (number, patches) in whole.iter().enumerate().take(Self::PACKETS) {
            self.load_packet(number * LANES, patches, &factors);
        }
        self.load_packet(whole.len() * LANES, others, &factors);
        self.clear(patches.len());
    }

    /// Loads patches of one packet, the first of which is number `first` of the chunk.
    #[inline(always)]
    fn load_packet<F, const N: usize>(
        &mut self,
        first: usize,
        patches: &[F],
        factors: impl Fn(&F) -> Option<[f32; N]>,
    ) {
        for (lane, patch) in patches.iter().enumerate().take(LANES) {
            let Some(factors) = factors(patch) else { break };
            for (values, factor) in self.0.iter_mut().zip(factors) {
                values[(first + lane) % Self::PATCHES] = factor;
            }
        }
    }

    #[inline(always)]
    fn load_columns(&mut self, columns: &PatchFactors<&[f32]>, patches: usize) {
        let end = patches.min(Self::PATCHES);
        for (values, column) in self.0.iter_mut().zip(columns.iter()) {
            let source = column.get(..end).unwrap_or_default();
            values[..source.len()].copy_from_slice(source);
        }
        self.clear(end);
    }

    /// Writes zeros from patch `first` to the end of its packet.
    #[inline(always)]
    fn clear(&mut self, first: usize) {
        for i in first..first.next_multiple_of(LANES).min(Self::PATCHES) {
            for values in &mut self.0 {
                values[i] = 0.0;
            }
        }
    }

    /// The factors of the patches of a packet, `number` packets into the chunk.
    #[inline(always)]
    pub(crate) fn packet(&self, number: usize) -> Column<f32> {
        let mut column = [[0.0; LANES]; MAX_FACTORS];
        for (lanes, values) in column.iter_mut().zip(&self.0) {
            *lanes = values.as_chunks().0[number % Self::PACKETS];
        }
        column
    }
}

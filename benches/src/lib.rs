//! The named workloads under Criterion, for development; `tess bench` is for users.
//!
//! ```text
//! cargo bench -p tess-benches --bench core -- --save-baseline before
//! cargo bench -p tess-benches --bench core -- --baseline before
//! cargo bench -p tess-benches --bench simd -- terrain
//! cargo bench -p tess-benches --bench kernels -- stages/points
//! cargo bench -p tess-benches --bench surface
//! ```
//!
//! A [`Case`] is a workload's first batch of the working set `cache` with buffers for its output.
//! The digest of its output is compared with the random-access formulation before it is timed, and by
//! `cargo test`. The bench `simd` fills the same bytes beside each workload, `kernels` times single stages beside the
//! model's. The program `gpu` measures the GPU backend.

use std::ops::Range;
use tess_core::{BufferTooSmall, DomainPoint, Patch};
use tess_simd::{Buffers, Level, Numbering, OwnedBatch, PatchRange, Tessellator};
use tess_verify::generate::{IndexWidth, Totals, Workload};
use tess_verify::vectors::Fnv1a;

/// Patches to tessellate and buffers of the right size.
#[derive(Debug)]
pub struct Case {
    /// The workload.
    pub workload: Workload,
    /// The patches that are timed.
    pub batch: Range<usize>,
    /// Sizes of the output.
    pub totals: Totals,
    points: Vec<DomainPoint>,
    indices: Vec<u32>,
    simd: Simd,
}

/// The SIMD backend, and the patches as it reads them fastest.
#[derive(Debug)]
struct Simd {
    tessellator: Tessellator,
    patches: OwnedBatch,
    ranges: Vec<PatchRange>,
}

/// Every workload's first batch.
#[must_use]
pub fn cases() -> Vec<Case> {
    Workload::all().into_iter().map(Case::new).collect()
}

impl Case {
    fn new(workload: Workload) -> Self {
        let batch = workload.cache_batches(IndexWidth::U32).swap_remove(0);
        let part =
            Workload { patches: workload.patches[batch.clone()].to_vec(), ..workload.clone() };
        let totals = part.totals();
        let points = part.counts().map(|counts| counts.points as usize).sum();
        let indices = part.counts().map(|counts| counts.indices as usize).sum();
        let simd = Simd {
            tessellator: Tessellator::new(workload.config),
            patches: OwnedBatch::try_from(&part.patches[..]).expect("patches of one domain"),
            ranges: vec![PatchRange::default(); part.patches.len()],
        };
        Self {
            simd,
            workload,
            batch,
            totals,
            points: vec![DomainPoint::default(); points],
            indices: vec![0; indices],
        }
    }

    /// Tessellates the batch by the core, patch after patch.
    ///
    /// # Errors
    /// The buffers are too small, which their sizes rule out.
    pub fn run_core(&mut self) -> Result<(), BufferTooSmall> {
        let (mut points, mut indices) = (&mut self.points[..], &mut self.indices[..]);
        for &factors in &self.workload.patches[self.batch.clone()] {
            let counts = Patch::new(self.workload.config, factors).write(points, indices)?;
            points = &mut points[counts.points as usize..];
            indices = &mut indices[counts.indices as usize..];
        }
        Ok(())
    }

    /// Tessellates the batch by the SIMD backend, at the best CPU level.
    ///
    /// # Errors
    /// The buffers are too small, which their sizes rule out.
    pub fn run_simd(&mut self) -> Result<(), tess_simd::Error> {
        let Self { points, indices, simd, .. } = self;
        let Simd { tessellator, patches, ranges } = simd;
        let buffers = Buffers::new(points, indices).with_ranges(ranges);
        tessellator.write(patches.batch(), Numbering::PerPatch, buffers)?;
        Ok(())
    }

    /// The CPU level that [`Self::run_simd`] runs at.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.simd.tessellator.level()
    }

    /// Fills the same bytes with zeros.
    pub fn fill(&mut self) {
        self.points.fill(DomainPoint::default());
        self.indices.fill(0);
    }

    /// Bytes that a run writes, the ranges of patches left out.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        self.totals.bytes(IndexWidth::U32)
    }

    /// The digest of what the buffers hold: all points, then all indices.
    #[must_use]
    pub fn digest(&self) -> u64 {
        let mut digest = Fnv1a::default();
        digest.points(&self.points);
        digest.words(self.indices.iter().copied());
        digest.finish()
    }

    /// The digest that the random-access formulation gives, which shares no walk with what is
    /// timed.
    #[must_use]
    pub fn expected_digest(&self) -> u64 {
        let patches = &self.workload.patches[self.batch.clone()];
        let patches = || patches.iter().map(|&factors| Patch::new(self.workload.config, factors));
        let mut digest = Fnv1a::default();
        for patch in patches() {
            digest.points(&patch.points().collect::<Vec<_>>());
        }
        for patch in patches() {
            for primitive in patch.primitives() {
                digest.words(primitive.indices().iter().copied());
            }
        }
        digest.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_workload_gives_the_expected_digest() {
        let cases = cases();
        assert!(cases.len() >= 23, "workloads: {}", cases.len());
        for mut case in cases {
            case.run_core().expect("the buffers fit");
            let (digest, expected) = (case.digest(), case.expected_digest());
            assert_eq!(digest, expected, "core, {}: {digest:016x}", case.workload.name);
            case.fill();
            case.run_simd().expect("the buffers fit");
            let digest = case.digest();
            assert_eq!(digest, expected, "simd, {}: {digest:016x}", case.workload.name);
        }
    }

    /// The comparison can fail: one wrong index changes the digest.
    #[test]
    fn a_planted_fault_changes_the_digest() {
        let mut case = cases().swap_remove(0);
        case.run_core().expect("the buffers fit");
        case.indices[5] ^= 1;
        assert_ne!(case.digest(), case.expected_digest(), "a wrong index");
    }
}

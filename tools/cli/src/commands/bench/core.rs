//! The golden model under the clock.

use super::parts::parts;
use super::runner::{Amount, Runner, WorkingSet};
use std::hint::black_box;
use std::ops::Range;
use std::time::{Duration, Instant};
use tess_core::{Config, Counts, DomainPoint, Patch, PatchFactors};
use tess_verify::BackendError;
use tess_verify::generate::{IndexWidth, Totals, Workload};
use tess_verify::vectors::Fnv1a;

/// The sequential formulation, patch by patch, into slices.
#[derive(Debug)]
pub(super) struct CoreRunner {
    config: Option<Config>,
    patches: Vec<PatchFactors>,
    batches: Vec<Batch>,
    /// The batches of each part.
    parts: Vec<Range<usize>>,
    points: Vec<DomainPoint>,
    indices: Vec<u32>,
}

/// Patches whose output lies in the buffers at the same time, and what it takes up.
#[derive(Clone, Debug)]
struct Batch {
    patches: Range<usize>,
    /// First point and first index of its output.
    start: (usize, usize),
    points: usize,
    indices: usize,
    amount: Amount,
}

impl CoreRunner {
    /// The core as it is: one thread, 32-bit indices.
    pub(super) const fn single() -> Self {
        Self {
            config: None,
            patches: Vec::new(),
            batches: Vec::new(),
            parts: Vec::new(),
            points: Vec::new(),
            indices: Vec::new(),
        }
    }

    /// Tessellates one batch; `each` sees the output of every patch.
    fn tessellate(
        &mut self,
        batch: usize,
        mut each: impl FnMut(&[DomainPoint], &[u32]),
    ) -> Result<(), BackendError> {
        let Batch { patches, start: (mut first_point, mut first_index), .. } =
            self.batches[batch].clone();
        let config = self.config.ok_or_else(|| BackendError::new("nothing is prepared"))?;
        for &factors in &self.patches[patches] {
            let points = &mut self.points[first_point..];
            let indices = &mut self.indices[first_index..];
            let counts = Patch::new(config, factors)
                .write(points, indices)
                .map_err(|error| BackendError::new(error.to_string()))?;
            let (n, m) = (counts.points as usize, counts.indices as usize);
            each(&points[..n], &indices[..m]);
            first_point += n;
            first_index += m;
        }
        Ok(())
    }
}

impl Runner for CoreRunner {
    fn backend(&self) -> &'static str {
        "core"
    }

    fn level(&self) -> String {
        "portable".to_owned()
    }

    fn threads(&self) -> u32 {
        1
    }

    fn index_type(&self) -> IndexWidth {
        IndexWidth::U32
    }

    fn prepare(
        &mut self,
        workload: &Workload,
        working_set: WorkingSet,
    ) -> Result<Vec<Amount>, BackendError> {
        self.config = Some(workload.config);
        self.patches.clone_from(&workload.patches);
        let counts: Vec<_> = workload.counts().collect();
        self.batches = match working_set {
            WorkingSet::Cache => cache_batches(workload, &counts),
            WorkingSet::Stream => stream_batches(workload, &counts),
        };
        let bytes: Vec<_> = self.batches.iter().map(|batch| batch.amount.bytes).collect();
        self.parts = parts(&bytes);
        let ends = |end: fn(&Batch) -> usize| self.batches.iter().map(end).max().unwrap_or(0);
        let points = ends(|batch| batch.start.0 + batch.points);
        let indices = ends(|batch| batch.start.1 + batch.indices);
        self.points = vec![DomainPoint::default(); points];
        self.indices = vec![0; indices];
        let amounts = self
            .parts
            .iter()
            .map(|part| self.batches[part.clone()].iter().map(|batch| batch.amount).sum());
        Ok(amounts.collect())
    }

    fn digest(&mut self) -> Result<u64, BackendError> {
        let mut digest = Fnv1a::default();
        let mut left = self.patches.len();
        for batch in 0..self.batches.len() {
            if left == 0 {
                break;
            }
            left -= self.batches[batch].patches.len();
            self.tessellate(batch, |points, indices| {
                digest.words([u32::try_from(points.len()).unwrap_or(u32::MAX)]);
                digest.words([u32::try_from(indices.len()).unwrap_or(u32::MAX)]);
                digest.points(points);
                digest.words(indices.iter().copied());
            })?;
        }
        Ok(digest.finish())
    }

    fn run(&mut self, part: usize) -> Result<Duration, BackendError> {
        let batches = self.parts[part].clone();
        let start = Instant::now();
        for batch in batches {
            self.tessellate(batch, |_, _| ())?;
            black_box((&mut self.points[..], &mut self.indices[..]));
        }
        Ok(start.elapsed())
    }

    fn fill(&mut self, part: usize) -> Result<Duration, BackendError> {
        let batches = &self.batches[self.parts[part].clone()];
        let start = Instant::now();
        for Batch { start: (first_point, first_index), points, indices, .. } in batches {
            // Zeros, so that the compiler makes `memset` of both.
            self.points[*first_point..][..*points].fill(DomainPoint::default());
            self.indices[*first_index..][..*indices].fill(0);
            black_box((&mut self.points[..], &mut self.indices[..]));
        }
        Ok(start.elapsed())
    }
}

/// Batches that all start at the beginning of the buffers.
fn cache_batches(workload: &Workload, counts: &[Counts]) -> Vec<Batch> {
    let ranges = workload.cache_batches(IndexWidth::U32);
    ranges.into_iter().map(|patches| Batch::new(patches, counts, (0, 0))).collect()
}

/// The whole workload again and again, one after another, in the same batches.
fn stream_batches(workload: &Workload, counts: &[Counts]) -> Vec<Batch> {
    let ranges = workload.cache_batches(IndexWidth::U32);
    let mut batches = Vec::new();
    let mut start = (0, 0);
    for _ in 0..workload.stream_repeats(IndexWidth::U32) {
        for patches in &ranges {
            let batch = Batch::new(patches.clone(), counts, start);
            start = (start.0 + batch.points, start.1 + batch.indices);
            batches.push(batch);
        }
    }
    batches
}

impl Batch {
    fn new(patches: Range<usize>, counts: &[Counts], start: (usize, usize)) -> Self {
        let counts = &counts[patches.clone()];
        let sum = |figure: fn(&Counts) -> u32| counts.iter().map(|c| u64::from(figure(c))).sum();
        let totals = Totals {
            patches: patches.len() as u64,
            points: sum(|counts| counts.points),
            primitives: sum(|counts| counts.primitives),
            indices: sum(|counts| counts.indices),
        };
        Self {
            patches,
            start,
            points: counts.iter().map(|counts| counts.points as usize).sum(),
            indices: counts.iter().map(|counts| counts.indices as usize).sum(),
            amount: Amount {
                patches: totals.patches,
                triangles: totals.primitives,
                bytes: totals.bytes(IndexWidth::U32),
            },
        }
    }
}

//! A timed CPU backend: it writes the batches of a workload into buffers that are made once.

use super::parts::parts;
use super::runner::{Amount, Description, Runner, WorkingSet, totals};
use std::hint::black_box;
use std::ops::Range;
use std::time::{Duration, Instant};
use tess_core::DomainPoint;
use tess_simd::{IndexFormat, PatchRange};
use tess_verify::BackendError;
use tess_verify::vectors::Fnv1a;
use tess_workloads::{Calls, IndexWidth, Workload};

/// The parts in which CPU backends differ.
pub(super) trait Kernel {
    type Point: Copy + Default;
    type Index: IndexFormat + Into<u32>;

    /// A point that is not all zeros.
    const ONE: Self::Point;
    /// Whether a stream is timed in parts of a mebibyte each.
    const STREAMS_IN_PARTS: bool;

    fn exact(point: Self::Point) -> DomainPoint;

    /// Takes the patches that will be written. Errors: the backend cannot write them.
    fn take(&mut self, workload: &Workload) -> Result<(), BackendError>;

    /// Tessellates some of the patches into the beginning of the buffers. Errors: the backend
    /// failed.
    fn write(
        &mut self,
        patches: &Range<usize>,
        points: &mut [Self::Point],
        indices: &mut [Self::Index],
        ranges: &mut [PatchRange],
    ) -> Result<(), BackendError>;

    /// Fills both slices with zeros; the compiler makes `memset` of it.
    fn fill(&self, points: &mut [Self::Point], indices: &mut [Self::Index]) {
        points.fill(Self::Point::default());
        indices.fill(Self::Index::default());
    }
}

/// The batches of a workload, ready to run.
pub(super) struct CpuRunner<K: Kernel> {
    kernel: K,
    description: Description,
    /// The output of one call in MiB, unless the workload fixes its calls.
    frame: Option<usize>,
    batches: Vec<CpuBatch>,
    /// The range of batches of each part.
    parts: Vec<Range<usize>>,
    /// The patches of one pass over the workload; after them it is repeated.
    once: usize,
    points: Vec<K::Point>,
    indices: Vec<K::Index>,
    ranges: Vec<PatchRange>,
}

/// The patches of one call, and the ranges of the buffers that it writes.
#[derive(Clone)]
struct CpuBatch {
    patches: Range<usize>,
    points: Range<usize>,
    indices: Range<usize>,
    amount: Amount,
}

impl CpuBatch {
    /// A batch that writes to the beginning of the buffers.
    fn new(workload: &Workload, patches: Range<usize>, index_type: IndexWidth) -> Self {
        let totals = totals(workload, &patches);
        let size = |elements| 0..usize::try_from(elements).unwrap_or(usize::MAX);
        let (points, indices) = (size(totals.points), size(totals.indices));
        Self { patches, points, indices, amount: Amount::of(&totals, index_type) }
    }
}

/// The batches repeated, one after another in the buffers.
fn streamed(batches: &[CpuBatch], repeats: u64) -> Vec<CpuBatch> {
    let mut all: Vec<CpuBatch> = Vec::new();
    for _ in 0..repeats {
        for batch in batches {
            let (point, index) = all.last().map_or((0, 0), |b| (b.points.end, b.indices.end));
            let (points, indices) =
                (point..point + batch.points.len(), index..index + batch.indices.len());
            all.push(CpuBatch { points, indices, ..batch.clone() });
        }
    }
    all
}

impl<K: Kernel> CpuRunner<K> {
    pub(super) fn new(kernel: K, description: Description, frame: Option<usize>) -> Self {
        let (batches, parts, ranges) = (Vec::new(), Vec::new(), Vec::new());
        let (points, indices) = (Vec::new(), Vec::new());
        Self { kernel, description, frame, batches, parts, once: 0, points, indices, ranges }
    }

    /// Tessellates one batch into its ranges.
    fn tessellate(&mut self, batch: usize) -> Result<(), BackendError> {
        let CpuBatch { patches, points, indices, .. } = &self.batches[batch];
        let points = &mut self.points[points.start..];
        let indices = &mut self.indices[indices.start..];
        self.kernel.write(patches, points, indices, &mut self.ranges)
    }

    /// Adds the first patches of a tessellated batch to a digest of whole patches.
    fn digest_batch(&self, batch: &CpuBatch, patches: usize, digest: &mut Fnv1a) {
        let points = &self.points[batch.points.clone()];
        let indices = &self.indices[batch.indices.clone()];
        for range in &self.ranges[..patches] {
            digest.words([range.points]);
            digest.words([range.indices]);
            let points = &points[range.first_point as usize..][..range.points as usize];
            let points = points.iter().map(|&point| K::exact(point));
            digest.words(points.flat_map(|point| [point.u.to_bits(), point.v.to_bits()]));
            let indices = &indices[range.first_index as usize..][..range.indices as usize];
            digest.words(indices.iter().map(|&index| index.into()));
        }
    }

    /// The number of batches of a mebibyte in one call.
    fn together(&self, calls: Calls) -> Result<usize, BackendError> {
        match (calls, self.frame) {
            (Calls::Batch, frame) => Ok(frame.unwrap_or(self.description.threads as usize)),
            (_, None) => Ok(1),
            (_, Some(_)) => Err(BackendError::new("its calls have their size: no --frame")),
        }
    }
}

impl<K: Kernel> Runner for CpuRunner<K> {
    fn description(&self) -> &Description {
        &self.description
    }

    fn prepare(
        &mut self,
        workload: &Workload,
        working_set: WorkingSet,
    ) -> Result<Vec<Amount>, BackendError> {
        let index_type = self.description.index_type;
        self.once = workload.patches.len();
        let workload = &repeated(workload, self.frame, index_type);
        self.kernel.take(workload)?;
        let mut batches = Vec::new();
        for ranges in workload.cache_batches(index_type).chunks(self.together(workload.calls)?) {
            let (Some(first), Some(last)) = (ranges.first(), ranges.last()) else { continue };
            batches.push(CpuBatch::new(workload, first.start..last.end, index_type));
        }
        if working_set == WorkingSet::Stream {
            batches = streamed(&batches, workload.stream_repeats(index_type));
        }
        self.parts = if working_set == WorkingSet::Stream && !K::STREAMS_IN_PARTS {
            // Between shorter parts, the caches would have time to write back.
            std::iter::once(0..batches.len()).collect()
        } else {
            parts(&batches.iter().map(|batch| batch.amount.bytes).collect::<Vec<_>>())
        };
        let largest = |end: fn(&CpuBatch) -> usize| batches.iter().map(end).max().unwrap_or(0);
        // Not zeros, because the system would then map the memory only while it is timed.
        self.points = vec![K::ONE; largest(|batch| batch.points.end)];
        self.indices = vec![K::Index::wrapping_from(1); largest(|batch| batch.indices.end)];
        self.ranges = vec![PatchRange::default(); largest(|batch| batch.patches.len())];
        self.batches = batches;
        let amount = |part: &Range<usize>| self.batches[part.clone()].iter().map(|b| b.amount);
        Ok(self.parts.iter().map(|part| amount(part).sum()).collect())
    }

    fn digest(&mut self) -> Result<u64, BackendError> {
        let mut digest = Fnv1a::default();
        for number in 0..self.batches.len() {
            let batch = self.batches[number].clone();
            let end = batch.patches.end.min(self.once);
            self.tessellate(number)?;
            self.digest_batch(&batch, end - batch.patches.start, &mut digest);
            if end == self.once {
                break; // the workload is repeated from here on
            }
        }
        Ok(digest.finish())
    }

    fn run(&mut self, part: usize) -> Result<Duration, BackendError> {
        let batches = self.parts[part].clone();
        let start = Instant::now();
        for batch in batches {
            self.tessellate(batch)?;
            black_box((&mut self.points[..], &mut self.indices[..]));
        }
        Ok(start.elapsed())
    }

    fn fill(&mut self, part: usize) -> Result<Duration, BackendError> {
        let start = Instant::now();
        for batch in &self.batches[self.parts[part].clone()] {
            let points = &mut self.points[batch.points.clone()];
            self.kernel.fill(points, &mut self.indices[batch.indices.clone()]);
            black_box((&mut self.points[..], &mut self.indices[..]));
        }
        Ok(start.elapsed())
    }
}

/// The workload, repeated until it has the output of one frame, if frames are timed.
fn repeated(workload: &Workload, frame: Option<usize>, index_type: IndexWidth) -> Workload {
    let wanted = frame.map_or(0, |mebibytes| (mebibytes as u64) << 20);
    let times = wanted.div_ceil(workload.totals().bytes(index_type).max(1)).max(1);
    let times = usize::try_from(times).unwrap_or(usize::MAX);
    Workload { patches: workload.patches.repeat(times), ..workload.clone() }
}

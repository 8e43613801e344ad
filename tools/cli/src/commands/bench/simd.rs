//! The SIMD backend under the clock: points as binary32 pairs, into the caller's buffers.

use super::parts::parts;
use super::runner::{Amount, Runner, RunnerOptions, WorkingSet};
use crate::failure::Failure;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::hint::black_box;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use tess_core::fixed::types::U16F16;
use tess_core::{DomainPoint, PatchFactors};
use tess_simd::{
    BatchCounts, Buffers, IndexFormat, Numbering, Order, OwnedBatch, PatchRange, Tessellator,
};
use tess_verify::BackendError;
use tess_verify::generate::{Calls, IndexWidth, Totals, Workload};
use tess_verify::vectors::Fnv1a;

/// The runner for these options.
///
/// # Errors
/// The threads cannot be started.
pub(super) fn runner(options: RunnerOptions) -> Result<Box<dyn Runner>, Failure> {
    // The calling thread is one of the pool, so that a run starts without waiting for another.
    let threads = options.threads as usize;
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .use_current_thread()
        .build()
        .map_err(|error| Failure::unavailable(format!("cannot start threads: {error}")))?;
    Ok(match options.index_type {
        IndexWidth::U16 => Box::new(SimdRunner::<u16>::new(options, pool)),
        IndexWidth::U32 => Box::new(SimdRunner::<u32>::new(options, pool)),
    })
}

/// Batches of a workload, ready to run.
#[derive(Debug)]
struct SimdRunner<I> {
    options: RunnerOptions,
    pool: ThreadPool,
    prepared: Option<Prepared>,
    points: Vec<[f32; 2]>,
    indices: Vec<I>,
    ranges: Vec<PatchRange>,
}

/// A workload in the backend's layout.
#[derive(Debug)]
struct Prepared {
    tessellator: Tessellator,
    patches: OwnedBatch,
    /// The same patches where each is a call of its own, otherwise none.
    single: Vec<PatchFactors>,
    batches: Vec<Batch>,
    /// The batches of each part.
    parts: Vec<Range<usize>>,
    /// Patches of the workload; behind them it is repeated.
    once: usize,
}

/// Patches that are tessellated in one call, and what that writes.
#[derive(Clone, Debug)]
struct Batch {
    patches: Range<usize>,
    /// First point and first index of its output.
    start: (usize, usize),
    counts: BatchCounts,
    amount: Amount,
}

/// Formats that the bench has.
trait Index: IndexFormat + std::fmt::Debug + PartialEq {
    const TYPE: IndexWidth;
    fn word(self) -> u32;
}

impl Index for u16 {
    const TYPE: IndexWidth = IndexWidth::U16;
    fn word(self) -> u32 {
        self.into()
    }
}

impl Index for u32 {
    const TYPE: IndexWidth = IndexWidth::U32;
    fn word(self) -> u32 {
        self
    }
}

impl<I: Index> SimdRunner<I> {
    fn new(options: RunnerOptions, pool: ThreadPool) -> Self {
        Self {
            options,
            pool,
            prepared: None,
            points: Vec::new(),
            indices: Vec::new(),
            ranges: Vec::new(),
        }
    }

    /// Tessellates one batch into its place.
    fn tessellate(&mut self, batch: usize) -> Result<(), BackendError> {
        let Some(Prepared { tessellator, patches, single, batches, .. }) = &mut self.prepared
        else {
            return Err(BackendError::new("nothing is prepared"));
        };
        let Batch { patches: range, start, .. } = &batches[batch];
        let (points, indices) = (&mut self.points[start.0..], &mut self.indices[start.1..]);
        if let Some(&factors) = single.get(range.start) {
            let counts = tessellator
                .patch(factors, points, indices)
                .map_err(|error| BackendError::new(error.to_string()))?;
            let (points, indices) = (counts.points, counts.indices);
            self.ranges[0] = PatchRange { first_point: 0, points, first_index: 0, indices };
            return Ok(());
        }
        let buffers = Buffers::new(points, indices).with_ranges(&mut self.ranges);
        let batch = part(patches, range)?;
        let write = || tessellator.write(batch, Numbering::PerPatch, buffers);
        let result = self.pool.install(write);
        result.map(|_| ()).map_err(|error| BackendError::new(error.to_string()))
    }

    /// Adds the first patches of a tessellated batch to a digest of whole patches.
    fn digest_batch(&self, batch: &Batch, patches: usize, digest: &mut Fnv1a) {
        let points = &self.points[batch.start.0..];
        let indices = &self.indices[batch.start.1..];
        for range in &self.ranges[..patches] {
            digest.words([range.points]);
            digest.words([range.indices]);
            let points = &points[range.first_point as usize..][..range.points as usize];
            let exact =
                |&[u, v]: &[f32; 2]| DomainPoint { u: U16F16::from_num(u), v: U16F16::from_num(v) };
            digest.points(&points.iter().map(exact).collect::<Vec<_>>());
            let indices = &indices[range.first_index as usize..][..range.indices as usize];
            digest.words(indices.iter().map(|index| index.word()));
        }
    }
}

impl<I: Index> Runner for SimdRunner<I> {
    fn backend(&self) -> &'static str {
        "simd"
    }

    fn level(&self) -> String {
        self.options.level.to_string()
    }

    fn threads(&self) -> u32 {
        self.options.threads
    }

    fn sleeps(&self) -> bool {
        self.options.frame.is_some()
    }

    fn remark(&self) -> String {
        self.options
            .frame
            .map_or_else(String::new, |mebibytes| format!(", frames of {mebibytes} MiB"))
    }

    fn order(&self) -> Order {
        self.options.order
    }

    fn index_type(&self) -> IndexWidth {
        I::TYPE
    }

    fn prepare(
        &mut self,
        workload: &Workload,
        working_set: WorkingSet,
    ) -> Result<Vec<Amount>, BackendError> {
        let threads = self.options.threads as usize;
        let mut tessellator = Tessellator::with_level(workload.config, self.options.level)
            .map_err(|error| BackendError::new(error.to_string()))?
            .threads(threads)
            .order(self.options.order);
        let once = workload.patches.len();
        let workload = &repeated(workload, self.options.frame, I::TYPE);
        let patches = OwnedBatch::try_from(&workload.patches[..])
            .map_err(|error| BackendError::new(error.to_string()))?;
        let totals = workload.totals();
        let indices_each = totals.indices / totals.primitives.max(1);
        let mut batches = Vec::new();
        // Where the workload does not say what a call is, it has a mebibyte for each thread.
        let together = match (workload.calls, self.options.frame) {
            (Calls::Batch, frame) => frame.unwrap_or(threads),
            (_, None) => 1,
            (_, Some(_)) => return Err(BackendError::new("its calls have their size: no --frame")),
        };
        for ranges in workload.cache_batches(I::TYPE).chunks(together) {
            let (Some(first), Some(last)) = (ranges.first(), ranges.last()) else { continue };
            let range = first.start..last.end;
            batches.push(counted_batch::<I>(&mut tessellator, &patches, range, indices_each)?);
        }
        let parts = match working_set {
            WorkingSet::Cache => {
                let bytes: Vec<_> = batches.iter().map(|batch| batch.amount.bytes).collect();
                parts(&bytes)
            }
            // One part: between shorter ones the caches would have time to write back.
            WorkingSet::Stream => {
                batches = streamed(&batches, workload.stream_repeats(I::TYPE));
                std::iter::once(0..batches.len()).collect()
            }
        };
        let amount = |part: &Range<usize>| batches[part.clone()].iter().map(|b| b.amount).sum();
        let amounts = parts.iter().map(amount).collect();
        let largest = |end: fn(&Batch) -> usize| batches.iter().map(end).max().unwrap_or(0);
        // Not zeros, which would leave the memory to be mapped under the clock.
        self.points = vec![[1.0; 2]; largest(|batch| batch.start.0 + batch.counts.points)];
        self.indices =
            vec![I::wrapping_from(1); largest(|batch| batch.start.1 + batch.counts.indices)];
        self.ranges = vec![PatchRange::default(); largest(|batch| batch.patches.len())];
        let single = match workload.calls {
            Calls::SinglePatch => workload.patches.clone(),
            _ => Vec::new(),
        };
        self.prepared = Some(Prepared { tessellator, patches, single, batches, parts, once });
        Ok(amounts)
    }

    fn digest(&mut self) -> Result<u64, BackendError> {
        let mut digest = Fnv1a::default();
        let mut batch = 0;
        while let Some(Prepared { once, batches, .. }) = &self.prepared {
            let Some(next) = batches.get(batch).cloned() else { break };
            let end = next.patches.end.min(*once);
            let last = end == *once;
            self.tessellate(batch)?;
            self.digest_batch(&next, end - next.patches.start, &mut digest);
            batch += 1;
            if last {
                break; // the workload is repeated from here on
            }
        }
        Ok(digest.finish())
    }

    fn run(&mut self, part: usize) -> Result<Duration, BackendError> {
        let part = self.prepared.as_ref().map_or(0..0, |prepared| prepared.parts[part].clone());
        let start = Instant::now();
        for batch in part {
            self.tessellate(batch)?;
            black_box((&mut self.points[..], &mut self.indices[..]));
        }
        Ok(start.elapsed())
    }

    fn fill(&mut self, part: usize) -> Result<Duration, BackendError> {
        let Some(Prepared { batches, parts, .. }) = &self.prepared else {
            return Err(BackendError::new("nothing is prepared"));
        };
        let start = Instant::now();
        for Batch { start, counts, .. } in &batches[parts[part].clone()] {
            let points = &mut self.points[start.0..][..counts.points];
            let indices = &mut self.indices[start.1..][..counts.indices];
            fill(points, indices, &self.pool);
            black_box((&mut self.points[..], &mut self.indices[..]));
        }
        Ok(start.elapsed())
    }
}

/// Fills both, each thread always the same part of each: about what it writes of a batch.
fn fill<I: Index>(points: &mut [[f32; 2]], indices: &mut [I], pool: &ThreadPool) {
    // Zeros, so that the compiler makes `memset` of both.
    let fill = |points: &mut [[f32; 2]], indices: &mut [I]| {
        points.fill([0.0; 2]);
        indices.fill(I::default());
    };
    let threads = pool.current_num_threads();
    if threads == 1 {
        return fill(points, indices);
    }
    let each = |length: usize| length.div_ceil(threads).max(1);
    let (each_points, each_indices) = (each(points.len()), each(indices.len()));
    let (mut points, mut indices) =
        (points.chunks_mut(each_points), indices.chunks_mut(each_indices));
    let mut part = || (points.next().unwrap_or_default(), indices.next().unwrap_or_default());
    let parts: Vec<_> = (0..threads).map(|_| Mutex::new(part())).collect();
    pool.broadcast(|thread| {
        let mut part = parts[thread.index()].lock().unwrap_or_else(PoisonError::into_inner);
        let (points, indices) = &mut *part;
        fill(points, indices);
    });
}

/// The workload again and again until it has a frame's output, if there are frames.
fn repeated(workload: &Workload, frame: Option<usize>, index_type: IndexWidth) -> Workload {
    let wanted = frame.map_or(0, |mebibytes| (mebibytes as u64) << 20);
    let times = wanted.div_ceil(workload.totals().bytes(index_type).max(1)).max(1);
    let times = usize::try_from(times).unwrap_or(usize::MAX);
    Workload { patches: workload.patches.repeat(times), ..workload.clone() }
}

/// The patches of a range.
fn part<'a>(
    patches: &'a OwnedBatch,
    range: &Range<usize>,
) -> Result<tess_simd::Batch<'a>, BackendError> {
    let missing = || BackendError::new(format!("the workload has no patches {range:?}"));
    patches.get(range.clone()).ok_or_else(missing)
}

/// A batch at the beginning of the buffers.
fn counted_batch<I: Index>(
    tessellator: &mut Tessellator,
    patches: &OwnedBatch,
    range: Range<usize>,
    indices_each: u64,
) -> Result<Batch, BackendError> {
    let counts = tessellator
        .count(part(patches, &range)?)
        .map_err(|error| BackendError::new(error.to_string()))?
        .counts();
    let primitives = counts.indices as u64 / indices_each;
    let totals = Totals {
        patches: range.len() as u64,
        points: counts.points as u64,
        primitives,
        indices: counts.indices as u64,
    };
    let amount =
        Amount { patches: totals.patches, triangles: primitives, bytes: totals.bytes(I::TYPE) };
    Ok(Batch { patches: range, start: (0, 0), counts, amount })
}

/// The batches again and again, one after another.
fn streamed(batches: &[Batch], repeats: u64) -> Vec<Batch> {
    let mut all = Vec::new();
    let mut start = (0, 0);
    for _ in 0..repeats {
        for batch in batches {
            all.push(Batch { start, ..batch.clone() });
            start = (start.0 + batch.counts.points, start.1 + batch.counts.indices);
        }
    }
    all
}

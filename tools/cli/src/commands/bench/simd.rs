//! The SIMD backend, timed: it writes points as binary32 pairs into the caller's buffers.

use super::BenchCommand;
use super::cpu::{CpuRunner, Kernel};
use super::runner::{Description, Runner};
use crate::failure::Failure;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::marker::PhantomData;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};
use tess_core::fixed::types::U16F16;
use tess_core::{DomainPoint, PatchFactors};
use tess_simd::{
    Buffers, IndexFormat, Level, Numbering, Order, OwnedBatch, PatchRange, Tessellator,
};
use tess_verify::BackendError;
use tess_workloads::{Calls, IndexWidth, Workload};

/// The runner for these options. Errors: the threads cannot be started.
pub(super) fn runner(args: &BenchCommand, level: Level) -> Result<Box<dyn Runner>, Failure> {
    // The calling thread belongs to the pool, so a run starts without waiting for another thread.
    let pool = ThreadPoolBuilder::new()
        .num_threads(args.threads as usize)
        .use_current_thread()
        .build()
        .map_err(|error| Failure::unavailable(format!("cannot start threads: {error}")))?;
    let BenchCommand { threads, frame, order, .. } = *args;
    let remark = frame.map(|mebibytes| format!(", frames of {mebibytes} MiB"));
    let description = Description {
        backend: "simd",
        level: level.to_string(),
        threads,
        index_type: args.options.index_type,
        order,
        remark: remark.unwrap_or_default(),
        sleeps: frame.is_some(),
        is_device: false,
    };
    let frame = frame.map(|mebibytes| mebibytes as usize);
    Ok(match args.options.index_type {
        IndexWidth::U16 => {
            Box::new(CpuRunner::new(SimdKernel::<u16>::new(pool, level, order), description, frame))
        }
        IndexWidth::U32 => {
            Box::new(CpuRunner::new(SimdKernel::<u32>::new(pool, level, order), description, frame))
        }
    })
}

struct SimdKernel<I> {
    pool: ThreadPool,
    level: Level,
    order: Order,
    /// The workload in the backend's layout.
    taken: Option<(Tessellator, OwnedBatch)>,
    /// The same patches if each is one call; otherwise empty.
    single: Vec<PatchFactors>,
    index: PhantomData<I>,
}

impl<I> SimdKernel<I> {
    const fn new(pool: ThreadPool, level: Level, order: Order) -> Self {
        Self { pool, level, order, taken: None, single: Vec::new(), index: PhantomData }
    }
}

impl<I: IndexFormat + Into<u32>> Kernel for SimdKernel<I> {
    type Point = [f32; 2];
    type Index = I;

    const ONE: [f32; 2] = [1.0; 2];
    const STREAMS_IN_PARTS: bool = false;

    fn exact([u, v]: [f32; 2]) -> DomainPoint {
        DomainPoint { u: U16F16::from_num(u), v: U16F16::from_num(v) }
    }

    fn take(&mut self, workload: &Workload) -> Result<(), BackendError> {
        let tessellator = Tessellator::with_level(workload.config, self.level)
            .map_err(BackendError::new)?
            .with_threads(self.pool.current_num_threads())
            .with_order(self.order);
        let patches = OwnedBatch::try_from(&workload.patches[..]).map_err(BackendError::new)?;
        self.taken = Some((tessellator, patches));
        self.single = match workload.calls {
            Calls::SinglePatch => workload.patches.clone(),
            _ => Vec::new(),
        };
        Ok(())
    }

    fn write(
        &mut self,
        patches: &Range<usize>,
        points: &mut [[f32; 2]],
        indices: &mut [I],
        ranges: &mut [PatchRange],
    ) -> Result<(), BackendError> {
        let Some((tessellator, all)) = &mut self.taken else {
            return Err(BackendError::new("nothing is prepared"));
        };
        if let Some(&factors) = self.single.get(patches.start) {
            let counts = tessellator.patch(factors, points, indices).map_err(BackendError::new)?;
            let (points, indices) = (counts.points, counts.indices);
            ranges[0] = PatchRange { first_point: 0, points, first_index: 0, indices };
            return Ok(());
        }
        let missing = || BackendError::new(format!("the workload has no patches {patches:?}"));
        let batch = all.get(patches.clone()).ok_or_else(missing)?;
        let buffers = Buffers::new(points, indices).with_ranges(ranges);
        let write = || tessellator.write(batch, Numbering::PerPatch, buffers);
        self.pool.install(write).map(|_| ()).map_err(BackendError::new)
    }

    /// Each thread always fills the same part of both slices, about as much as it writes of a
    /// batch.
    fn fill(&self, points: &mut [[f32; 2]], indices: &mut [I]) {
        let fill = |points: &mut [[f32; 2]], indices: &mut [I]| {
            points.fill([0.0; 2]);
            indices.fill(I::default());
        };
        let threads = self.pool.current_num_threads();
        if threads == 1 {
            return fill(points, indices);
        }
        let each = |length: usize| length.div_ceil(threads).max(1);
        let (each_points, each_indices) = (each(points.len()), each(indices.len()));
        let (mut points, mut indices) =
            (points.chunks_mut(each_points), indices.chunks_mut(each_indices));
        let mut part = || (points.next().unwrap_or_default(), indices.next().unwrap_or_default());
        let parts: Vec<_> = (0..threads).map(|_| Mutex::new(part())).collect();
        self.pool.broadcast(|thread| {
            let mut part = parts[thread.index()].lock().unwrap_or_else(PoisonError::into_inner);
            let (points, indices) = &mut *part;
            fill(points, indices);
        });
    }
}

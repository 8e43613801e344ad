//! The interface of a timed backend.

use clap::ValueEnum;
use std::iter::Sum;
use std::ops::Range;
use std::time::Duration;
use tess_simd::Order;
use tess_verify::BackendError;
use tess_workloads::{IndexWidth, Totals, Workload};

/// The destination of a runner's output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum WorkingSet {
    /// Batches of about 1 MiB per thread, into the same buffers again and again
    Cache,
    /// 1 GiB of output, each byte written once
    Stream,
}

/// The work of one run of a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Amount {
    /// The number of tessellated patches.
    pub(crate) patches: u64,
    /// The number of written primitives: triangles, or segments of isolines.
    pub(crate) triangles: u64,
    /// The number of written bytes of points and indices.
    pub(crate) bytes: u64,
}

impl Amount {
    pub(crate) const fn of(totals: &Totals, index_type: IndexWidth) -> Self {
        let bytes = totals.bytes(index_type);
        Self { patches: totals.patches, triangles: totals.primitives, bytes }
    }
}

/// The size of some patches of a workload.
pub(crate) fn totals(workload: &Workload, patches: &Range<usize>) -> Totals {
    Workload { patches: workload.patches[patches.clone()].to_vec(), ..workload.clone() }.totals()
}

impl Sum for Amount {
    fn sum<I: Iterator<Item = Self>>(amounts: I) -> Self {
        amounts.fold(Self::default(), |sum, more| Self {
            patches: sum.patches + more.patches,
            triangles: sum.triangles + more.triangles,
            bytes: sum.bytes + more.bytes,
        })
    }
}

/// The timed backend and its conditions.
#[derive(Clone, Debug)]
pub(crate) struct Description {
    /// The name of the backend.
    pub(crate) backend: &'static str,
    /// The CPU level, or the name of the adapter.
    pub(crate) level: String,
    /// The number of threads.
    pub(crate) threads: u32,
    /// The width of the written indices.
    pub(crate) index_type: IndexWidth,
    /// The order of the written triangles.
    pub(crate) order: Order,
    /// The text after the workload's name in a row.
    pub(crate) remark: String,
    /// Whether threads are asleep when a run begins, so that waking them is timed too.
    pub(crate) sleeps: bool,
    /// Whether it runs on a separate device, so that the core need not be timed in turn with it,
    /// nor in the same working set.
    pub(crate) is_device: bool,
}

/// An implementation that can be timed.
///
/// A workload runs in parts, so that runs that are compared are close together in time. A part is
/// about a mebibyte of output on a CPU; on a device it is as much as suits one submission.
/// [`Runner::run`] and [`Runner::fill`] write the same bytes to the same buffers in the same order;
/// on one thread neither allocates. Both return their own time, so that a device can use its clock.
pub(crate) trait Runner {
    /// The timed backend and its conditions.
    fn description(&self) -> &Description;

    /// Prepares everything to run a workload in a working set, including buffers, and returns the
    /// amount of work of each part. Errors: the implementation cannot run it.
    fn prepare(
        &mut self,
        workload: &Workload,
        working_set: WorkingSet,
    ) -> Result<Vec<Amount>, BackendError>;

    /// Runs the prepared workload once over its patches, and returns the digest of the output, as
    /// [`Workload::digest`] computes it. Errors: the implementation failed.
    fn digest(&mut self) -> Result<u64, BackendError>;

    /// Runs a part and returns its time. Errors: the implementation failed.
    fn run(&mut self, part: usize) -> Result<Duration, BackendError>;

    /// Fills the bytes that a run of the part writes, and returns the time. Errors: the device
    /// failed.
    fn fill(&mut self, part: usize) -> Result<Duration, BackendError>;
}

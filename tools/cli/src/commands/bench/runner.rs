//! The interface of a backend that is timed.

use clap::ValueEnum;
use std::iter::Sum;
use std::ops::Range;
use std::time::Duration;
use tess_simd::Order;
use tess_verify::BackendError;
use tess_verify::workloads::{IndexWidth, Totals, Workload};

/// Where a runner's output goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum WorkingSet {
    /// Batches of about 1 MiB for each thread into the same buffers again and again
    Cache,
    /// 1 GiB of output, each byte written once
    Stream,
}

/// The amount of work of one run of a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Amount {
    /// Patches tessellated.
    pub(crate) patches: u64,
    /// Primitives written: triangles, or segments on isolines.
    pub(crate) triangles: u64,
    /// Bytes of points and indices written.
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

/// The timed backend, and how it is timed.
#[derive(Clone, Debug)]
pub(crate) struct Description {
    /// Name of the backend.
    pub(crate) backend: &'static str,
    /// CPU level or name of the adapter.
    pub(crate) level: String,
    /// Threads it runs on.
    pub(crate) threads: u32,
    /// Width of the indices it writes.
    pub(crate) index_type: IndexWidth,
    /// The order of the triangles it writes.
    pub(crate) order: Order,
    /// The text behind the workload's name in a row.
    pub(crate) remark: String,
    /// Whether threads sleep when a run begins, so that it is timed with waking them.
    pub(crate) sleeps: bool,
    /// Whether it runs on a separate device, so that the core's times need not be taken in turn
    /// with its own, nor in the same working set.
    pub(crate) is_device: bool,
}

/// An implementation that can be timed.
///
/// A workload runs in parts, so that runs which are compared lie close together in time: a part is
/// about a mebibyte of output on a CPU, as much as a device likes in one go elsewhere.
/// [`Runner::run`] and [`Runner::fill`] write the same bytes to the same buffers in the same order;
/// on one thread neither allocates. Both give their own time, so that a device can use its clock.
pub(crate) trait Runner {
    /// The timed backend, and how it is timed.
    fn description(&self) -> &Description;

    /// Gets everything ready to run a workload in a working set, buffers included, and says what
    /// each part amounts to. Errors: the implementation cannot run it.
    fn prepare(
        &mut self,
        workload: &Workload,
        working_set: WorkingSet,
    ) -> Result<Vec<Amount>, BackendError>;

    /// Runs what is prepared, once over the workload's patches, and digests the output as
    /// [`Workload::digest`] does. Errors: the implementation failed.
    fn digest(&mut self) -> Result<u64, BackendError>;

    /// Runs a part and says how long it took. Errors: the implementation failed.
    fn run(&mut self, part: usize) -> Result<Duration, BackendError>;

    /// Fills the bytes that a run of the part writes and says how long it took. Errors: the device
    /// failed.
    fn fill(&mut self, part: usize) -> Result<Duration, BackendError>;
}

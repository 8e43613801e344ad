//! The golden model as a timed backend.

use super::cpu::{CpuRunner, Kernel};
use super::runner::Description;
use std::ops::Range;
use tess_core::fixed::types::U16F16;
use tess_core::{Config, DomainPoint, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_simd::{Order, PatchRange};
use tess_verify::BackendError;
use tess_workloads::{IndexWidth, Workload};

/// The sequential formulation, patch by patch, written into slices.
pub(super) struct CoreKernel {
    config: Config,
    patches: Vec<PatchFactors>,
}

/// The core as it is: one thread and 32-bit indices.
pub(super) fn runner() -> CpuRunner<CoreKernel> {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::Point);
    let description = Description {
        backend: "core",
        level: "portable".to_owned(),
        threads: 1,
        index_type: IndexWidth::U32,
        order: Order::Specification,
        remark: String::new(),
        sleeps: false,
        is_device: false,
    };
    CpuRunner::new(CoreKernel { config, patches: Vec::new() }, description, None)
}

impl Kernel for CoreKernel {
    type Point = DomainPoint;
    type Index = u32;

    const ONE: DomainPoint = DomainPoint { u: U16F16::ONE, v: U16F16::ONE };
    const STREAMS_IN_PARTS: bool = true;

    fn exact(point: DomainPoint) -> DomainPoint {
        point
    }

    fn take(&mut self, workload: &Workload) -> Result<(), BackendError> {
        self.config = workload.config;
        self.patches.clone_from(&workload.patches);
        Ok(())
    }

    fn write(
        &mut self,
        patches: &Range<usize>,
        points: &mut [DomainPoint],
        indices: &mut [u32],
        ranges: &mut [PatchRange],
    ) -> Result<(), BackendError> {
        let (mut first_point, mut first_index) = (0, 0);
        for (&factors, range) in self.patches[patches.clone()].iter().zip(ranges) {
            let (points, indices) =
                (&mut points[first_point as usize..], &mut indices[first_index as usize..]);
            let counts = Patch::new(self.config, factors)
                .write(points, indices)
                .map_err(BackendError::new)?;
            let (points, indices) = (counts.points, counts.indices);
            *range = PatchRange { first_point, points, first_index, indices };
            first_point += points;
            first_index += indices;
        }
        Ok(())
    }
}

//! The dispatches of a plan with their pipelines and bind groups.

use super::buffers::Buffers;
use crate::device::pipeline;
use crate::device::pipelines::Pipelines;
use crate::error::Error;
use tess_gpu::{Plan, Setup, Stage, Workgroups};

/// One stage over one part of the batch.
#[derive(Debug)]
pub(crate) struct Dispatch {
    pub(crate) stage: Stage,
    pub(crate) pipeline: wgpu::ComputePipeline,
    pub(crate) group: wgpu::BindGroup,
    pub(crate) workgroups: Workgroups,
}

/// All dispatches of a plan, in order.
pub(crate) fn dispatches(
    pipelines: &mut Pipelines,
    setup: Setup,
    plan: &Plan,
    buffers: &Buffers,
) -> Result<Vec<Dispatch>, Error> {
    let mut dispatches = Vec::new();
    for dispatch in plan.dispatches() {
        let stage = dispatch.stage();
        let pipeline = pipelines.pipeline(stage, setup)?;
        let bindings = (0..)
            .zip(dispatch.bindings())
            .map(|(binding, (resource, span))| (binding, buffers.bound(resource, span)));
        let (label, layout) = (stage.entry_point(), pipeline.get_bind_group_layout(0));
        let group = pipeline::group(pipelines.device(), label, &layout, bindings)?;
        let workgroups = dispatch.workgroups();
        dispatches.push(Dispatch { stage, pipeline, group, workgroups });
    }
    Ok(dispatches)
}

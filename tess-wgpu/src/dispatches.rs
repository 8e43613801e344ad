//! The dispatches of a plan with their pipelines and bind groups.

use crate::buffers::Buffers;
use crate::error::{Error, checked};
use crate::pipelines::Pipelines;
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
        let entries: Vec<_> = (0..)
            .zip(dispatch.bindings())
            .map(|(binding, (resource, span))| wgpu::BindGroupEntry {
                binding,
                resource: buffers.bound(resource, span),
            })
            .collect();
        let descriptor = wgpu::BindGroupDescriptor {
            label: Some(stage.entry_point()),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        };
        let device = pipelines.device();
        let group = checked(device, || device.create_bind_group(&descriptor))?;
        let workgroups = dispatch.workgroups();
        dispatches.push(Dispatch { stage, pipeline, group, workgroups });
    }
    Ok(dispatches)
}

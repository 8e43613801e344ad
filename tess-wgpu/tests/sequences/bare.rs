//! A plan of tess-gpu on bare wgpu, and the buffers that a batch leaves, whichever host ran it.

#[allow(dead_code, reason = "batches are made and recorded apart")]
#[path = "../../../tess-gpu/examples/bare_wgpu.rs"]
mod bare_wgpu;

use crate::common::device::Machine;
use bare_wgpu::Buffers;
use std::collections::HashMap;
use tess_gpu::{Plan, Resource, Setup, Stage};
use tess_wgpu::Batch;

/// The buffers that a batch leaves in addition to its output.
pub(crate) struct Left<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) status: &'a wgpu::Buffer,
    pub(crate) arguments: &'a wgpu::Buffer,
    pub(crate) draws: &'a wgpu::Buffer,
    pub(crate) offsets: &'a wgpu::Buffer,
    pub(crate) topologies: &'a wgpu::Buffer,
    pub(crate) contexts: &'a wgpu::Buffer,
    pub(crate) jobs: &'a wgpu::Buffer,
    pub(crate) tiles: &'a wgpu::Buffer,
}

/// The objects that run a batch.
pub(crate) enum Runner {
    Batch(Box<Batch>),
    Bare(Bare),
}

/// A plan with its buffers and the pipelines of its dispatches.
pub(crate) struct Bare {
    device: wgpu::Device,
    plan: Plan,
    buffers: Box<Buffers>,
    pipelines: Vec<wgpu::ComputePipeline>,
}

/// Pipelines by stage and the part of the setup that it depends on.
pub(crate) type Pipelines = HashMap<(Stage, Setup), wgpu::ComputePipeline>;

impl Runner {
    pub(crate) fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        match self {
            Self::Batch(batch) => batch.encode(encoder),
            Self::Bare(bare) => bare.encode(encoder),
        }
    }

    pub(crate) fn left(&self) -> Left<'_> {
        match self {
            Self::Batch(batch) => Left {
                plan: batch.plan(),
                status: batch.status(),
                arguments: batch.draw_arguments(),
                draws: batch.group_arguments(),
                offsets: batch.offsets(),
                topologies: batch.topologies(),
                contexts: batch.contexts(),
                jobs: batch.jobs(),
                tiles: batch.tiles(),
            },
            Self::Bare(Bare { plan, buffers, .. }) => Left {
                plan,
                status: &buffers[Resource::Status as usize],
                arguments: &buffers[Resource::Arguments as usize],
                draws: &buffers[Resource::Draws as usize],
                offsets: &buffers[Resource::Offsets as usize],
                topologies: &buffers[Resource::Topologies as usize],
                contexts: &buffers[Resource::Contexts as usize],
                jobs: &buffers[Resource::Job as usize],
                tiles: &buffers[Resource::Tiles as usize],
            },
        }
    }
}

impl Bare {
    /// `given` are the caller's factors, and points and indices if they are written.
    pub(crate) fn new(
        machine: &Machine,
        pipelines: &mut Pipelines,
        (setup, plan): (Setup, Plan),
        groups: &[u32],
        given: &[(Resource, &wgpu::Buffer)],
    ) -> Self {
        let gpu = (machine.gpu.device.clone(), machine.gpu.queue.clone());
        let mut buffers = bare_wgpu::buffers(&gpu, setup, &plan, &[], groups);
        given.iter().for_each(|&(of, buffer)| buffers[of as usize] = buffer.clone());
        let pipelines = plan.dispatches().map(|dispatch| {
            let (stage, relevant) = (dispatch.stage(), dispatch.stage().relevant(setup));
            let make = || bare_wgpu::pipeline(&gpu.0, stage, &stage.source(relevant));
            pipelines.entry((stage, relevant)).or_insert_with(make).clone()
        });
        let pipelines = pipelines.collect();
        Self { device: gpu.0, plan, buffers: Box::new(buffers), pipelines }
    }

    fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        for (dispatch, pipeline) in self.plan.dispatches().zip(&self.pipelines) {
            bare_wgpu::encode(&self.device, &mut pass, pipeline, &dispatch, &self.buffers);
        }
    }
}

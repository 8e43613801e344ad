//! A plan of tess-gpu on bare wgpu, and what a batch leaves, whoever ran it.

use crate::common::device::Machine;
use crate::common::objects;
use std::collections::HashMap;
use tess_gpu::{Access, Binding, Plan, Resource, Setup, Stage, Workgroups, tables};
use tess_wgpu::Batch;
use wgpu::BufferUsages as Usage;

/// The buffers that a batch leaves beside its output.
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

/// A plan with its buffers and bind groups.
pub(crate) struct Bare {
    plan: Plan,
    buffers: HashMap<Resource, wgpu::Buffer>,
    dispatches: Vec<(wgpu::ComputePipeline, wgpu::BindGroup, Workgroups)>,
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
                status: &buffers[&Resource::Status],
                arguments: &buffers[&Resource::Arguments],
                draws: &buffers[&Resource::Draws],
                offsets: &buffers[&Resource::Offsets],
                topologies: &buffers[&Resource::Topologies],
                contexts: &buffers[&Resource::Contexts],
                jobs: &buffers[&Resource::Job],
                tiles: &buffers[&Resource::Tiles],
            },
        }
    }
}

impl Bare {
    /// `given` are the caller's factors, and points and indices where they are written.
    pub(crate) fn new(
        machine: &Machine,
        pipelines: &mut Pipelines,
        (setup, plan): (Setup, Plan),
        groups: &[u32],
        given: &[(Resource, &wgpu::Buffer)],
    ) -> Self {
        let make = |resource| {
            let given = given.iter().find(|(other, _)| *other == resource);
            match (given, resource) {
                (Some(&(_, buffer)), _) => buffer.clone(),
                (_, Resource::Job) => {
                    let jobs = plan.jobs();
                    machine.gpu.upload("jobs", &jobs, Usage::UNIFORM).expect("there is room")
                }
                (_, Resource::Tables) => {
                    machine.upload(&tables(setup.config.split), Usage::STORAGE)
                }
                (_, Resource::Groups) => machine.upload(groups, Usage::STORAGE),
                _ => {
                    let usage = Usage::STORAGE | Usage::COPY_SRC | Usage::INDIRECT;
                    let size = plan.buffer_size(resource);
                    machine.gpu.buffer("between", size, usage).expect("there is room")
                }
            }
        };
        let buffers = Resource::ALL.map(|resource| (resource, make(resource))).into();
        let device = &machine.gpu.device;
        let mut own = Self { plan, buffers, dispatches: Vec::new() };
        for dispatch in plan.dispatches() {
            let stage = dispatch.stage();
            let relevant = stage.relevant(setup);
            let pipeline = pipelines.entry((stage, relevant));
            let pipeline = pipeline.or_insert_with(|| pipeline_of(device, stage, relevant)).clone();
            let bindings = (0..).zip(dispatch.bindings()).map(|(number, (resource, span))| {
                (number, objects::part(&own.buffers[&resource], span.offset, span.size))
            });
            let group = objects::group(device, &pipeline.get_bind_group_layout(0), bindings);
            own.dispatches.push((pipeline, group, dispatch.workgroups()));
        }
        own
    }

    fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        for (pipeline, group, workgroups) in &self.dispatches {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            match *workgroups {
                Workgroups::Direct([x, y, z]) => pass.dispatch_workgroups(x, y, z),
                Workgroups::Indirect(at) => {
                    pass.dispatch_workgroups_indirect(&self.buffers[&Resource::Arguments], at);
                }
            }
        }
    }
}

/// The pipeline of a stage, whose layout has all of its bindings.
fn pipeline_of(device: &wgpu::Device, stage: Stage, setup: Setup) -> wgpu::ComputePipeline {
    let types = stage.bindings().iter().map(|&Binding(resource, access)| match resource {
        Resource::Job => objects::buffer(wgpu::BufferBindingType::Uniform),
        _ => objects::storage(access == Access::Read),
    });
    let layout = objects::layout(device, wgpu::ShaderStages::COMPUTE, types);
    objects::compute(device, stage.source(setup), stage.entry_point(), &[&layout])
}

//! A plan of tess-gpu on bare wgpu, and what a batch leaves, whoever ran it.

use crate::common::device::Machine;
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
            let entries: Vec<_> = (0..)
                .zip(dispatch.bindings())
                .map(|(binding, (resource, span))| wgpu::BindGroupEntry {
                    binding,
                    resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer: &own.buffers[&resource],
                        offset: span.offset,
                        size: std::num::NonZeroU64::new(span.size),
                    }),
                })
                .collect();
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries,
            });
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
    let label = Some(stage.entry_point());
    let entry = |(binding, &Binding(resource, access)): (u32, &Binding)| {
        let read_only = access == Access::Read;
        let ty = match resource {
            Resource::Job => wgpu::BufferBindingType::Uniform,
            _ => wgpu::BufferBindingType::Storage { read_only },
        };
        wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        }
    };
    let entries: Vec<_> = (0..).zip(stage.bindings()).map(entry).collect();
    let entries = &entries;
    let group =
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(&group)],
        immediate_size: 0,
    });
    let source = wgpu::ShaderSource::Wgsl(stage.source(setup).into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label,
        layout: Some(&layout),
        module: &module,
        entry_point: label,
        compilation_options: Default::default(),
        cache: None,
    })
}

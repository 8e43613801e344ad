//! From a plan to dispatches, with pipelines and bind groups.

use crate::Tessellator;
use crate::buffers::{Buffers, job_span};
use tess_gpu::bindings::{Binding, Resource};
use tess_gpu::setup::Setup;
use tess_gpu::shaders::Stage;
use tess_gpu::sizes::{Plan, Span};

/// One stage over one part of the batch.
#[derive(Debug)]
pub(crate) struct Dispatch {
    pub(crate) stage: Stage,
    pub(crate) pipeline: wgpu::ComputePipeline,
    pub(crate) group: wgpu::BindGroup,
    pub(crate) workgroups: Workgroups,
}

/// How many workgroups a dispatch has.
#[derive(Debug)]
pub(crate) enum Workgroups {
    /// These.
    Direct([u32; 3]),
    /// Those at this offset of the arguments.
    Indirect(u64),
}

/// Turns a plan into dispatches.
pub(crate) struct Encoding<'a> {
    pub(crate) tessellator: &'a mut Tessellator,
    pub(crate) setup: Setup,
    pub(crate) plan: &'a Plan,
    pub(crate) buffers: &'a Buffers,
}

/// Which chunk, job and window a dispatch is about.
#[derive(Clone, Copy)]
struct Part {
    chunk: u32,
    job: u32,
    window: u32,
}

impl Encoding<'_> {
    /// All chunks are counted before any is expanded, so that nothing is written if not all fits.
    pub(crate) fn all(mut self) -> Vec<Dispatch> {
        let mut dispatches = Vec::new();
        for chunk in 0..self.plan.chunks() {
            let part = Part { chunk, job: self.first_job(chunk), window: 0 };
            let factors = Workgroups::Direct(self.plan.factors_workgroups(chunk));
            let scan = Workgroups::Direct(self.plan.scan_workgroups(chunk));
            dispatches.push(self.dispatch(Stage::Factors, part, factors));
            dispatches.push(self.dispatch(Stage::Scan, part, scan));
            dispatches.push(self.dispatch(Stage::Totals, part, Workgroups::Direct([1; 3])));
        }
        if dispatches.is_empty() {
            let part = Part { chunk: 0, job: 0, window: 0 };
            dispatches.push(self.dispatch(Stage::Totals, part, Workgroups::Direct([1; 3])));
        }
        (0..self.plan.chunks()).for_each(|chunk| self.expand(chunk, &mut dispatches));
        dispatches
    }

    fn expand(&mut self, chunk: u32, dispatches: &mut Vec<Dispatch>) {
        let plan = self.plan;
        if plan.point_windows() + plan.primitive_windows() == 0 {
            return;
        }
        let job = self.first_job(chunk);
        let mut slot = 0;
        let mut push = |stage, window| {
            let part = Part { chunk, job: job + slot, window };
            let at = Workgroups::Indirect(plan.arguments_at(chunk, slot));
            dispatches.push(self.dispatch(stage, part, at));
            slot += 1;
        };
        push(Stage::Partition, 0);
        (0..plan.point_windows()).for_each(|window| push(Stage::ExpandPoints, window));
        (0..plan.primitive_windows()).for_each(|window| push(Stage::ExpandPrimitives, window));
    }

    /// The number of a chunk's own job.
    fn first_job(&self, chunk: u32) -> u32 {
        1 + chunk * (1 + self.plan.point_windows() + self.plan.primitive_windows())
    }

    fn dispatch(&mut self, stage: Stage, part: Part, workgroups: Workgroups) -> Dispatch {
        let pipeline = self.tessellator.pipeline(stage, self.setup);
        let entries: Vec<_> = (0..)
            .zip(stage.bindings())
            .map(|(binding, &Binding(resource, _))| wgpu::BindGroupEntry {
                binding,
                resource: self.resource(resource, part),
            })
            .collect();
        let group = self.tessellator.device().create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(stage.entry_point()),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Dispatch { stage, pipeline, group, workgroups }
    }

    fn resource(&self, resource: Resource, part: Part) -> wgpu::BindingResource<'_> {
        let Part { chunk, job, window } = part;
        let (plan, buffers) = (self.plan, self.buffers);
        let all = |buffer: &wgpu::Buffer| Span { offset: 0, size: buffer.size() };
        let (buffer, span) = match resource {
            Resource::Job => (&buffers.jobs, job_span(job)),
            Resource::Factors => (&buffers.factors, plan.factors(chunk)),
            Resource::Tables => (&buffers.tables, all(&buffers.tables)),
            Resource::Topologies => (&buffers.topologies, plan.topologies(chunk)),
            Resource::Contexts => (&buffers.contexts, plan.contexts(chunk)),
            Resource::Offsets => (&buffers.offsets, plan.offsets(chunk)),
            Resource::Status => (&buffers.status, all(&buffers.status)),
            Resource::Tiles => (&buffers.tiles, all(&buffers.tiles)),
            Resource::Arguments => (&buffers.arguments, all(&buffers.arguments)),
            Resource::Points => (&buffers.points, plan.point_window(window)),
            Resource::Indices => (&buffers.indices, plan.primitive_window(window)),
        };
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer,
            offset: span.offset,
            size: std::num::NonZeroU64::new(span.size),
        })
    }
}

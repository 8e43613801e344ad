//! The buffers of a batch: the caller's and those in between.

use crate::error::Error;
use crate::gpu;
use crate::outputs::{Outputs, Patches};
use crate::pipelines::Pipelines;
use tess_gpu::{Plan, Resource, Setup, Span};

/// Everything that the stages bind.
#[derive(Debug)]
pub(crate) struct Buffers {
    pub(crate) jobs: wgpu::Buffer,
    pub(crate) factors: wgpu::Buffer,
    pub(crate) tables: wgpu::Buffer,
    pub(crate) topologies: wgpu::Buffer,
    pub(crate) contexts: wgpu::Buffer,
    pub(crate) offsets: wgpu::Buffer,
    pub(crate) status: wgpu::Buffer,
    pub(crate) tiles: wgpu::Buffer,
    pub(crate) arguments: wgpu::Buffer,
    pub(crate) catalogue: wgpu::Buffer,
    pub(crate) groups: wgpu::Buffer,
    pub(crate) draws: wgpu::Buffer,
    pub(crate) points: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
}

impl Buffers {
    pub(crate) fn new(
        pipelines: &mut Pipelines,
        plan: &Plan,
        setup: Setup,
        patches: Patches<'_>,
        outputs: Outputs<'_>,
    ) -> Result<Self, Error> {
        use wgpu::BufferUsages as Usage;
        let Patches { groups, factors, .. } = patches;
        let tables = pipelines.tables(setup.config.split)?;
        let device = pipelines.device();
        let make = |resource, more| {
            let usage = Usage::STORAGE | Usage::COPY_SRC | more;
            gpu::empty(device, &format!("{resource:?}"), plan.buffer_size(resource), usage)
        };
        // Without outputs there are no windows, so nothing binds what stands for them here.
        let (points, indices) = match outputs {
            Outputs::CountOnly | Outputs::Arguments(_) => (factors, factors),
            Outputs::Indices { indices, .. } => (factors, indices),
            Outputs::Buffers { points, indices } => (points, indices),
        };
        Ok(Self {
            jobs: gpu::filled(device, "Job", &plan.jobs(), Usage::UNIFORM)?,
            factors: factors.clone(),
            tables,
            topologies: make(Resource::Topologies, Usage::empty())?,
            contexts: make(Resource::Contexts, Usage::empty())?,
            offsets: make(Resource::Offsets, Usage::empty())?,
            status: make(Resource::Status, Usage::empty())?,
            tiles: make(Resource::Tiles, Usage::empty())?,
            arguments: make(Resource::Arguments, Usage::INDIRECT)?,
            catalogue: make(Resource::Catalogue, Usage::empty())?,
            groups: gpu::filled(device, "Groups", bytemuck::cast_slice(groups), Usage::STORAGE)?,
            draws: make(Resource::Draws, Usage::INDIRECT)?,
            points: points.clone(),
            indices: indices.clone(),
        })
    }

    /// These bytes of the buffer of a resource.
    pub(crate) fn bound(&self, resource: Resource, span: Span) -> wgpu::BindingResource<'_> {
        let buffer = match resource {
            Resource::Job => &self.jobs,
            Resource::Factors => &self.factors,
            Resource::Tables => &self.tables,
            Resource::Topologies => &self.topologies,
            Resource::Contexts => &self.contexts,
            Resource::Offsets => &self.offsets,
            Resource::Status => &self.status,
            Resource::Tiles => &self.tiles,
            Resource::Arguments => &self.arguments,
            Resource::Catalogue => &self.catalogue,
            Resource::Groups => &self.groups,
            Resource::Draws => &self.draws,
            Resource::Points => &self.points,
            Resource::Indices => &self.indices,
        };
        let size = std::num::NonZeroU64::new(span.size);
        wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset: span.offset, size })
    }
}

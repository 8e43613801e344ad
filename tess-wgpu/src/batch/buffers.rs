//! The buffers of a batch: the caller's and the intermediate ones.

use super::outputs::{Outputs, Patches};
use crate::device::gpu;
use crate::device::pipelines::Pipelines;
use crate::error::Error;
use tess_gpu::{Plan, Resource, Setup, Span};

/// The buffers that the stages bind, one for each resource, in the order of [`Resource::ALL`].
#[derive(Debug)]
pub(crate) struct Buffers(Vec<wgpu::Buffer>);

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
        // An output that is not written has no windows, so its placeholder, `factors`, is unused.
        let (points, indices) = match outputs {
            Outputs::CountOnly | Outputs::Arguments(_) => (factors, factors),
            Outputs::Indices { indices, .. } => (factors, indices),
            Outputs::Buffers { points, indices } => (points, indices),
        };
        let make = |resource| match resource {
            Resource::Job => gpu::filled(device, "Job", &plan.jobs(), Usage::UNIFORM),
            Resource::Groups => {
                let usage = Usage::STORAGE | Usage::COPY_DST;
                gpu::filled(device, "Groups", bytemuck::cast_slice(groups), usage)
            }
            Resource::Factors => Ok(factors.clone()),
            Resource::Tables => Ok(tables.clone()),
            Resource::Points => Ok(points.clone()),
            Resource::Indices => Ok(indices.clone()),
            _ => {
                let is_read = matches!(resource, Resource::Arguments | Resource::Draws);
                // `COPY_DST`: a tessellation stage copies the number of instances into them.
                let more = if is_read { Usage::INDIRECT | Usage::COPY_DST } else { Usage::empty() };
                let usage = Usage::STORAGE | Usage::COPY_SRC | more;
                gpu::empty(device, &format!("{resource:?}"), plan.buffer_size(resource), usage)
            }
        };
        Resource::ALL.into_iter().map(make).collect::<Result<_, _>>().map(Self)
    }

    /// The buffer of a resource.
    pub(crate) fn of(&self, resource: Resource) -> &wgpu::Buffer {
        &self.0[resource as usize]
    }

    /// A binding of these bytes of a resource's buffer.
    pub(crate) fn bound(&self, resource: Resource, span: Span) -> wgpu::BindingResource<'_> {
        let (buffer, offset) = (self.of(resource), span.offset);
        let size = std::num::NonZeroU64::new(span.size);
        wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset, size })
    }
}

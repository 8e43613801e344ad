//! A batch of patches, ready to be encoded again and again.

use crate::Tessellator;
use crate::buffers::Buffers;
use crate::dispatches::{Dispatch, Encoding, Workgroups};
use std::fmt;
use tess_gpu::setup::{IndexType, Numbering, Setup};
use tess_gpu::shaders::Stage;
use tess_gpu::sizes::{Capacity, Plan};

/// Where the output goes.
#[derive(Clone, Copy, Debug)]
pub enum Outputs<'a> {
    /// Nowhere: the batch is counted.
    CountOnly,
    /// Into these buffers, from their first byte on, as much as they have room for.
    Buffers {
        /// The domain points, 8 bytes each.
        points: &'a wgpu::Buffer,
        /// The indices, 2 or 4 bytes each; whole 8 bytes of the buffer are used.
        indices: &'a wgpu::Buffer,
    },
}

/// A batch can't be made of these buffers.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// Make the buffer of factors as long as the patches need, or name fewer patches.
    FactorsTooShort {
        /// Bytes that the patches need.
        needed: u64,
        /// Bytes that the buffer has.
        got: u64,
    },
    /// Create the buffers of factors, points and indices with the usage `STORAGE`.
    NotStorage,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FactorsTooShort { needed, got } => {
                write!(f, "the patches have {needed} bytes of factors, their buffer {got}")
            }
            Self::NotStorage => f.write_str("a buffer does not have the usage STORAGE"),
        }
    }
}

impl std::error::Error for Error {}

/// A batch: `patches` patches of one [`Setup`], the caller's buffers, and what is between them.
///
/// The number of patches is fixed; their factors are read anew each time it runs.
#[derive(Debug)]
pub struct Batch {
    plan: Plan,
    status: wgpu::Buffer,
    arguments: wgpu::Buffer,
    topologies: wgpu::Buffer,
    contexts: wgpu::Buffer,
    offsets: wgpu::Buffer,
    dispatches: Vec<Dispatch>,
}

impl Batch {
    pub(crate) fn new(
        tessellator: &mut Tessellator,
        setup: Setup,
        patches: u32,
        factors: &wgpu::Buffer,
        outputs: Outputs<'_>,
    ) -> Result<Self, Error> {
        check(setup, patches, factors, outputs)?;
        let plan = Plan::new(setup, patches, capacity(setup, outputs), tessellator.limits());
        let buffers = Buffers::new(tessellator, &plan, setup, factors, outputs);
        let dispatches = Encoding { tessellator, setup, plan: &plan, buffers: &buffers }.all();
        let Buffers { status, arguments, topologies, contexts, offsets, .. } = buffers;
        Ok(Self { plan, status, arguments, topologies, contexts, offsets, dispatches })
    }

    /// Records everything, from factors to draw arguments, into one compute pass.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        self.encode_each(encoder, |_, _| {});
    }

    /// The same, with `after` called behind each dispatch; for timing stages one by one.
    pub fn encode_each(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        mut after: impl FnMut(&mut wgpu::ComputePass<'_>, Stage),
    ) {
        encoder.clear_buffer(&self.status, 0, None);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("tessellate"),
            timestamp_writes: None,
        });
        for Dispatch { stage, pipeline, group, workgroups } in &self.dispatches {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            match workgroups {
                Workgroups::Direct([x, y, z]) => pass.dispatch_workgroups(*x, *y, *z),
                Workgroups::Indirect(at) => {
                    pass.dispatch_workgroups_indirect(&self.arguments, *at);
                }
            }
            after(&mut pass, *stage);
        }
    }

    /// How the batch is cut up.
    #[must_use]
    pub const fn plan(&self) -> &Plan {
        &self.plan
    }

    /// A [`Status`](tess_gpu::layout::Status) after the batch has run.
    #[must_use]
    pub const fn status(&self) -> &wgpu::Buffer {
        &self.status
    }

    /// The arguments of `draw_indexed_indirect` at offset 0, after the batch has run: see
    /// [`tess_gpu::layout::DrawIndexed`].
    #[must_use]
    pub const fn draw_arguments(&self) -> &wgpu::Buffer {
        &self.arguments
    }

    /// The [`tess_gpu::layout::Topology`] of each patch, after the batch has run.
    #[must_use]
    pub const fn topologies(&self) -> &wgpu::Buffer {
        &self.topologies
    }

    /// The packed factor contexts ([`tess_gpu::layout::pack_context`]), after the batch has run.
    #[must_use]
    pub const fn contexts(&self) -> &wgpu::Buffer {
        &self.contexts
    }

    /// The offsets of patches, blocks and groups, after the batch has run.
    #[must_use]
    pub const fn offsets(&self) -> &wgpu::Buffer {
        &self.offsets
    }
}

fn check(
    setup: Setup,
    patches: u32,
    factors: &wgpu::Buffer,
    outputs: Outputs<'_>,
) -> Result<(), Error> {
    let (needed, got) = (4 * u64::from(setup.factors()) * u64::from(patches), factors.size());
    if needed > got {
        return Err(Error::FactorsTooShort { needed, got });
    }
    let is_storage = |buffer: &wgpu::Buffer| buffer.usage().contains(wgpu::BufferUsages::STORAGE);
    let outputs_are_storage = match outputs {
        Outputs::CountOnly => true,
        Outputs::Buffers { points, indices } => is_storage(points) && is_storage(indices),
    };
    if is_storage(factors) && outputs_are_storage { Ok(()) } else { Err(Error::NotStorage) }
}

fn capacity(setup: Setup, outputs: Outputs<'_>) -> Capacity {
    let Outputs::Buffers { points, indices } = outputs else { return Capacity::default() };
    let elements = |size: u64, each: u32| u32::try_from(size / u64::from(each)).unwrap_or(u32::MAX);
    let points = elements(points.size(), 8);
    let numbered = match (setup.index_type, setup.numbering) {
        (IndexType::U16, Numbering::PerBatch) => points.min(1 << 16),
        _ => points,
    };
    Capacity {
        points: numbered,
        primitives: elements(indices.size() / 8 * 8, setup.primitive_bytes()),
    }
}

//! A batch of patches, which is made once and encoded in each frame.

pub(crate) mod buffers;
mod dispatches;
pub(crate) mod outputs;
pub(crate) mod read_back;
#[cfg(feature = "measure")]
mod taps;
pub(crate) mod tessellator;

use crate::device::limits;
use crate::device::pipelines::Pipelines;
use crate::error::Error;
use buffers::Buffers;
use dispatches::{Dispatch, dispatches};
use outputs::{Outputs, Patches};
use tess_gpu::{Capacity, Limits, Plan, Resource, Setup, Stage, Workgroups, Written};

/// Patches of one [`Setup`], with the caller's buffers and all intermediate buffers and bind
/// groups.
///
/// The number of patches is fixed. Each run reads their factors from the buffer.
#[derive(Debug)]
pub struct Batch {
    plan: Plan,
    buffers: Buffers,
    dispatches: Vec<Dispatch>,
}

impl Batch {
    pub(crate) fn new(
        (pipelines, limits): (&mut Pipelines, Limits),
        setup: Setup,
        patches: Patches<'_>,
        outputs: Outputs<'_>,
    ) -> Result<Self, Error> {
        let Patches { count, groups, factors } = patches;
        limits::check(pipelines.device())?;
        let plan = plan(setup, count, outputs, limits).with_groups(check_groups(count, groups)?);
        check(&plan, factors, outputs)?;
        let buffers = Buffers::new(pipelines, &plan, setup, patches, outputs)?;
        let dispatches = dispatches(pipelines, setup, &plan, &buffers)?;
        Ok(Self { plan, buffers, dispatches })
    }

    /// Records all stages, from factors to draw arguments, in one compute pass.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        self.encode_each(encoder, |_, _| {});
    }

    /// As [`Self::encode`], but calls `after` after each dispatch, to time single stages.
    pub(crate) fn encode_each(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        mut after: impl FnMut(&mut wgpu::ComputePass<'_>, Stage),
    ) {
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
                    let arguments = self.buffers.of(Resource::Arguments);
                    pass.dispatch_workgroups_indirect(arguments, *at);
                }
            }
            after(&mut pass, *stage);
        }
    }

    /// The batch's division into portions and windows.
    #[must_use]
    pub const fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The buffer of a [`Status`](tess_gpu::layout::Status), valid after the batch has run.
    #[must_use]
    pub fn status(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Status)
    }

    /// The arguments of `draw_indexed_indirect` at offset 0, after the batch has run: see
    /// [`tess_gpu::layout::DrawIndexed`].
    #[must_use]
    pub fn draw_arguments(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Arguments)
    }

    /// The arguments of one `draw_indexed_indirect` for each group, in order, 20 bytes each, after
    /// the batch has run. A batch without groups has none.
    #[must_use]
    pub fn group_arguments(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Draws)
    }

    pub(crate) const fn buffers(&self) -> &Buffers {
        &self.buffers
    }

    /// The [`tess_gpu::layout::Topology`] of each patch, after the batch has run.
    #[must_use]
    pub fn topologies(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Topologies)
    }

    /// The packed factor contexts ([`tess_gpu::layout::pack_context`]), after the batch has run.
    #[must_use]
    pub fn contexts(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Contexts)
    }

    /// The offsets of patches, blocks and sections, after the batch has run.
    #[must_use]
    pub fn offsets(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Offsets)
    }

    /// The [`tess_gpu::layout::Job`] of each part of the batch, 256 bytes apart. A shader that uses
    /// [`tess_gpu::Pull`] binds the first.
    #[must_use]
    pub fn jobs(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Job)
    }

    /// The number of the first patch of each tile of the output, after the batch has run.
    #[must_use]
    pub fn tiles(&self) -> &wgpu::Buffer {
        self.buffers.of(Resource::Tiles)
    }
}

/// The plan of a batch with these outputs.
fn plan(setup: Setup, patches: u32, outputs: Outputs<'_>, limits: Limits) -> Plan {
    let room = capacity(setup, outputs);
    match outputs {
        Outputs::CountOnly | Outputs::Buffers { .. } => Plan::new(setup, patches, room, limits),
        Outputs::Indices { .. } => Plan::writing(Written::Indices, setup, patches, room, limits),
        Outputs::Arguments(_) => Plan::writing(Written::Arguments, setup, patches, room, limits),
    }
}

/// The number of groups. Refuses groups that do not ascend within the batch.
pub(crate) fn check_groups(patches: u32, groups: &[u32]) -> Result<u32, Error> {
    let mut least = 0;
    for (group, &begin) in groups.iter().enumerate() {
        if begin < least || begin > patches {
            return Err(Error::MisplacedGroup { group, begin, range: [least, patches] });
        }
        least = begin;
    }
    u32::try_from(groups.len()).map_err(|_| Error::TooManyGroups { got: groups.len() })
}

/// Refuses buffers that the batch cannot use.
fn check(plan: &Plan, factors: &wgpu::Buffer, outputs: Outputs<'_>) -> Result<(), Error> {
    if plan.patches() > MAX_PATCHES {
        return Err(Error::TooManyPatches { got: plan.patches() as usize });
    }
    let (needed, got) = (plan.buffer_size(Resource::Factors), factors.size());
    if needed > got {
        return Err(Error::FactorsTooShort { needed, got });
    }
    if matches!(outputs, Outputs::Indices { .. } | Outputs::Arguments(_)) && plan.portions() > 1 {
        let (got, most) = (plan.patches(), plan.portion_patches());
        return Err(Error::TooManyToPull { got, most });
    }
    let mut own = vec![(Resource::Factors, factors)];
    match outputs {
        Outputs::CountOnly | Outputs::Arguments(_) => {}
        Outputs::Indices { indices, .. } => own.push((Resource::Indices, indices)),
        Outputs::Buffers { points, indices } => {
            own.extend([(Resource::Points, points), (Resource::Indices, indices)]);
        }
    }
    for (number, &(resource, buffer)) in own.iter().enumerate() {
        if !buffer.usage().contains(wgpu::BufferUsages::STORAGE) {
            return Err(Error::NotStorage { buffer: resource });
        }
        if let Some(&(other, _)) = own[..number].iter().find(|&&(_, other)| other == buffer) {
            return Err(Error::SharedBuffer { buffers: [other, resource] });
        }
    }
    Ok(())
}

/// The most patches of a batch: a packed point has 30 bits for its patch's number.
const MAX_PATCHES: u32 = 1 << 30;

/// The points and primitives for which the outputs have room.
fn capacity(setup: Setup, outputs: Outputs<'_>) -> Capacity {
    let elements = |size: u64, each: u32| u32::try_from(size / u64::from(each)).unwrap_or(u32::MAX);
    let (points, indices) = match outputs {
        Outputs::CountOnly => return Capacity::default(),
        Outputs::Arguments(capacity) => return capacity,
        Outputs::Buffers { points, indices } => (elements(points.size(), 8), indices),
        Outputs::Indices { points, indices } => (points, indices),
    };
    let primitives = elements(indices.size() / 8 * 8, setup.primitive_bytes());
    Capacity { points, primitives }
}

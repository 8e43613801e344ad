//! A batch of patches, ready to be encoded again and again.

use crate::bindings::Resource;
use crate::layout::{Job, Status};
use crate::runner::{Tessellator, gpu};
use crate::setup::{IndexType, Numbering, Setup};
use crate::shaders::Stage;
use crate::sizes::{ALIGNMENT, Capacity, Plan, Span};
use std::fmt;

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

#[derive(Debug)]
struct Dispatch {
    stage: Stage,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    workgroups: Workgroups,
}

#[derive(Debug)]
enum Workgroups {
    Direct([u32; 3]),
    /// At this offset of the arguments.
    Indirect(u64),
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

    /// A [`Status`] after the batch has run.
    #[must_use]
    pub const fn status(&self) -> &wgpu::Buffer {
        &self.status
    }

    /// The arguments of `draw_indexed_indirect` at offset 0, after the batch has run: see
    /// [`crate::layout::DrawIndexed`].
    #[must_use]
    pub const fn draw_arguments(&self) -> &wgpu::Buffer {
        &self.arguments
    }

    /// The [`crate::layout::Topology`] of each patch, after the batch has run.
    #[must_use]
    pub const fn topologies(&self) -> &wgpu::Buffer {
        &self.topologies
    }

    /// The packed factor contexts ([`crate::layout::pack_context`]), after the batch has run.
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

/// Everything that the stages bind.
struct Buffers {
    jobs: wgpu::Buffer,
    factors: wgpu::Buffer,
    tables: wgpu::Buffer,
    topologies: wgpu::Buffer,
    contexts: wgpu::Buffer,
    offsets: wgpu::Buffer,
    status: wgpu::Buffer,
    tiles: wgpu::Buffer,
    arguments: wgpu::Buffer,
    points: wgpu::Buffer,
    indices: wgpu::Buffer,
}

impl Buffers {
    fn new(
        tessellator: &mut Tessellator,
        plan: &Plan,
        setup: Setup,
        factors: &wgpu::Buffer,
        outputs: Outputs<'_>,
    ) -> Self {
        use wgpu::BufferUsages as Usage;
        let tables = tessellator.tables(setup.config.split);
        let device = tessellator.device();
        let storage = Usage::STORAGE | Usage::COPY_SRC;
        let make = |label, size, more| gpu::empty(device, label, size, storage | more);
        let all = |region: fn(&Plan, u32) -> Span| region(plan, plan.chunks().max(1)).offset;
        let jobs = all_jobs(plan);
        // Without outputs there are no windows, so nothing binds what stands for them here.
        let (points, indices) = match outputs {
            Outputs::CountOnly => (factors, factors),
            Outputs::Buffers { points, indices } => (points, indices),
        };
        Self {
            jobs: gpu::filled(device, "jobs", &jobs, Usage::UNIFORM),
            factors: factors.clone(),
            tables,
            topologies: make("topologies", all(Plan::topologies), Usage::empty()),
            contexts: make("contexts", all(Plan::contexts), Usage::empty()),
            offsets: make("offsets", all(Plan::offsets), Usage::empty()),
            status: make("status", plan.status_size(), Usage::COPY_DST),
            tiles: make("tiles", plan.tiles_size(), Usage::empty()),
            arguments: make("arguments", plan.arguments_size(), Usage::INDIRECT),
            points: points.clone(),
            indices: indices.clone(),
        }
    }
}

/// A job of no patches, then for each chunk its own and those of its windows.
fn all_jobs(plan: &Plan) -> Vec<u8> {
    let mut jobs = vec![plan.empty_job()];
    for chunk in 0..plan.chunks() {
        jobs.push(plan.job(chunk));
        jobs.extend((0..plan.point_windows()).map(|window| plan.point_job(chunk, window)));
        jobs.extend((0..plan.primitive_windows()).map(|window| plan.primitive_job(chunk, window)));
    }
    let mut bytes = Vec::new();
    for job in &jobs {
        bytes.extend_from_slice(bytemuck::bytes_of(job));
        bytes.extend_from_slice(&[0; PADDING]);
    }
    bytes
}

/// Turns a plan into dispatches.
struct Encoding<'a> {
    tessellator: &'a mut Tessellator,
    setup: Setup,
    plan: &'a Plan,
    buffers: &'a Buffers,
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
    fn all(mut self) -> Vec<Dispatch> {
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
            .map(|(binding, &crate::Binding(resource, _))| wgpu::BindGroupEntry {
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

fn job_span(job: u32) -> Span {
    Span { offset: ALIGNMENT * u64::from(job), size: size_of::<Job>() as u64 }
}

/// Bytes between two jobs.
const PADDING: usize = ALIGNMENT as usize - size_of::<Job>();
const _: () = assert!(size_of::<Status>() == 32, "ranges follow the status at once");

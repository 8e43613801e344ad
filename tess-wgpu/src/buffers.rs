//! The buffers of a batch: the caller's and those in between.

use crate::batch::Outputs;
use crate::{Tessellator, gpu};
use tess_gpu::layout::{Job, Status};
use tess_gpu::setup::Setup;
use tess_gpu::sizes::{ALIGNMENT, Plan, Span};

/// Everything that the stages bind.
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
    pub(crate) points: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
}

impl Buffers {
    pub(crate) fn new(
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

/// Where job `job` lies in the buffer of jobs.
pub(crate) fn job_span(job: u32) -> Span {
    Span { offset: ALIGNMENT * u64::from(job), size: size_of::<Job>() as u64 }
}

/// Bytes between two jobs.
#[expect(clippy::cast_possible_truncation, reason = "an alignment of 256")]
const PADDING: usize = ALIGNMENT as usize - size_of::<Job>();
const _: () = assert!(size_of::<Status>() == 32, "ranges follow the status at once");

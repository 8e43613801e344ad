//! The pass that runs the user's function `domain` once for each point ([`Points::Evaluated`]).
//!
//! The batch writes packed points. This pass reads each one and writes the user's `Vertex`, and
//! draws load vertices instead of calling `domain`. Under WebGPU's default limits, one binding
//! holds 128 MiB, or 4 million vertices of 32 bytes. The buffers are therefore bound in windows:
//!
//! ```text
//! points    | window 0                | window 1                | window 2      |   8 bytes each
//! vertices  | window 0                | window 1                | window 2      |   array_stride bytes each
//! windows   | first, count | ...      | first, count | ...      | first, count |   256 bytes apart
//! ```
//!
//! - A window begins at a multiple of 64 points, so that its offset is a multiple of 256 bytes in
//!   both buffers.
//! - A window's dispatch has a fixed size, one thread for each point of room but at most
//!   [`MOST_WORKGROUPS`] workgroups. Thread `i` of `n` evaluates the points `i`, `i + n`, `i + 2n`,
//!   ... of the window, as far as the frame has points. The host can therefore record it without
//!   the number of points, and a large room with few points costs little.
//! - If a frame does not fit, no vertex is written.

use super::builder::StageBuilder;
use super::choices::Points;
use super::user_groups::UserGroups;
use super::vertex::VertexLayout;
use super::{mistakes, modules, passes, source, wgsl};
use crate::device::{gpu, pipeline};
use crate::error::Error;
use crate::{Batch, Tessellator};
use std::sync::Arc;
use tess_gpu::sizes::ALIGNMENT;
use tess_gpu::{Access, Resource};

/// The most workgroups of a window: enough to occupy a large device.
const MOST_WORKGROUPS: u32 = 4096;
/// A window begins at a multiple of this many points.
const WHOLE: u64 = 64;

/// The pass's pipeline.
#[derive(Clone, Debug)]
pub(super) struct Evaluation {
    pipeline: Arc<wgpu::ComputePipeline>,
    layout: wgpu::BindGroupLayout,
    own_group: u32,
    has_factors: bool,
    stride: u64,
}

/// The bindings of one window, and the workgroups of its dispatch.
#[derive(Clone, Debug)]
pub(super) struct Window {
    group: wgpu::BindGroup,
    workgroups: u32,
}

impl Evaluation {
    /// `None` unless points are evaluated.
    pub(super) async fn new(
        builder: &StageBuilder<'_>,
        tessellator: &Tessellator,
        vertices: &VertexLayout,
    ) -> Result<Option<Self>, Error> {
        if builder.points != Points::Evaluated {
            return Ok(None);
        }
        let program = &builder.program;
        let (user, own_group, has_factors) =
            (program.source, program.own_group(), program.has_factors());
        let mut accesses = vec![(0, Access::Read), (1, Access::ReadWrite)];
        accesses.extend([(2, Access::Read), (3, Access::Read)]);
        accesses.extend(has_factors.then_some((source::FACTORS_BINDING, Access::Read)));
        let layout = passes::layout(tessellator, "evaluate", accesses)?;
        let declared = wgsl::declarations(user);
        let reached = wgsl::reached(&declared, &["domain"]).into_iter().map(|one| one.text);
        let text = |user: &str| source::of_evaluation(user, builder.setup().domain, own_group);
        let text_of_it = text(&reached.collect::<String>());
        let key = program.key(text_of_it, "tess_evaluate", Some(&layout));
        let found = tessellator.pipelines().passes.find(&key);
        let pipeline = match found {
            Some(pipeline) => pipeline,
            None => {
                let device = tessellator.device();
                let module = modules::user_module(device, "domain", user, text(user)).await?;
                passes::pipeline(tessellator, key, || Ok(module))
                    .map_err(|error| mistakes::counted(error, "domain", 4 + u32::from(has_factors)))
                    .map_err(|error| mistakes::explained(error, user, "COMPUTE"))?
            }
        };
        let stride = vertices.array_stride;
        Ok(Some(Self { pipeline, layout, own_group, has_factors, stride }))
    }

    /// The windows over these buffers, which have room for `room` points.
    pub(super) fn windows(
        &self,
        tessellator: &Tessellator,
        (batch, factors): (&Batch, &wgpu::Buffer),
        [points, vertices]: [&wgpu::Buffer; 2],
        room: u32,
    ) -> Result<Vec<Window>, Error> {
        let device = tessellator.device();
        let limit = device.limits().max_storage_buffer_binding_size;
        let most = limit / self.stride.max(8) / WHOLE * WHOLE;
        let starts: Vec<u64> = (0..u64::from(room)).step_by(to_usize(most.max(WHOLE))).collect();
        let mut words = vec![0_u32; to_usize(ALIGNMENT / 4) * starts.len().max(1)];
        let count = |first: u64| (u64::from(room) - first).min(most.max(WHOLE));
        for (number, &first) in starts.iter().enumerate() {
            let at = to_usize(ALIGNMENT / 4) * number;
            words[at..at + 2].copy_from_slice(&[to_u32(first), to_u32(count(first))]);
        }
        let bytes = bytemuck::cast_slice(&words);
        let all = gpu::filled(device, "windows", bytes, wgpu::BufferUsages::STORAGE)?;
        let window = |(number, &first): (u64, &u64)| {
            let part = |buffer, offset, size| {
                let size = std::num::NonZeroU64::new(size);
                wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset, size })
            };
            let count = count(first);
            let mut bound = vec![
                (0, part(points, 8 * first, 8 * count)),
                (1, part(vertices, self.stride * first, self.stride * count)),
                (2, batch.buffers().of(Resource::Status).as_entire_binding()),
                (3, part(&all, ALIGNMENT * number, 8)),
            ];
            if self.has_factors {
                bound.push((source::FACTORS_BINDING, factors.as_entire_binding()));
            }
            let group = pipeline::group(device, "evaluate", &self.layout, bound)?;
            let workgroups = count.div_ceil(passes::WORKGROUP.into());
            Ok(Window { group, workgroups: to_u32(workgroups).min(MOST_WORKGROUPS) })
        };
        (0..).zip(&starts).map(window).collect()
    }

    /// Records the pass; `user` are the user's bind groups.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        user: &UserGroups,
        windows: &[Window],
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("evaluate"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        for (number, group, offsets) in user.iter().take(self.own_group as usize) {
            pass.set_bind_group(number, group, offsets);
        }
        for Window { group, workgroups } in windows {
            pass.set_bind_group(self.own_group, group, &[]);
            pass.dispatch_workgroups(*workgroups, 1, 1);
        }
    }
}

fn to_usize(value: u64) -> usize {
    usize::try_from(value).unwrap_or(usize::MAX)
}

fn to_u32(value: u64) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

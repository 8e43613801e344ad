//! The parts of a stage that depend on the room: the batch, and the buffers that it writes.

use super::TessellationStage;
use super::evaluation::{Evaluation, Window};
use super::gl;
use super::own_group::{OwnGroups, OwnLayout};
use super::room::Form;
use super::vertex::Load;
use crate::device::gpu;
use crate::error::Error;
use crate::{Batch, Outputs, Tessellator};
use std::sync::Arc;
use tess_gpu::Capacity;
use wgpu::BufferUsages as Usage;

/// A batch with room for its output. The frames that it runs share it; a clone is another handle.
#[derive(Clone, Debug)]
pub(super) struct StageOutput {
    pub(super) room: Capacity,
    pub(super) batch: Arc<Batch>,
    pub(super) stored: Stored,
    pub(super) windows: Arc<[Window]>,
    /// Bind groups of the draws.
    own: Arc<OwnGroups>,
}

/// The buffers that a batch writes and a draw reads; `None` where a stage has none.
#[derive(Clone, Debug)]
pub(super) struct Stored {
    pub(super) points: Option<wgpu::Buffer>,
    pub(super) vertices: Option<wgpu::Buffer>,
    pub(super) indices: Option<wgpu::Buffer>,
    /// A vertex buffer that nothing reads, where there are no points and [`gl::attributes`] need
    /// one.
    unread: Option<wgpu::Buffer>,
}

impl Stored {
    /// Buffers for this room.
    pub(super) fn new(device: &wgpu::Device, form: Form, room: Capacity) -> Result<Self, Error> {
        let has_rays = device.features().contains(wgpu::Features::EXPERIMENTAL_RAY_QUERY);
        let is_evaluated = form.vertex_bytes > 0;
        let rays = if has_rays && is_evaluated { Usage::BLAS_INPUT } else { Usage::empty() };
        let make = |label, size, usage| {
            gpu::empty(device, label, size, Usage::STORAGE | Usage::COPY_SRC | usage)
        };
        let primitive_bytes = u64::from(form.setup.primitive_bytes());
        let index_bytes = (u64::from(room.primitives) * primitive_bytes).next_multiple_of(8);
        // A binding of vertices holds one at least.
        let vertex_bytes = u64::from(form.vertex_bytes) * u64::from(room.points.max(1));
        let points = (form.points.are_written())
            .then(|| make("points", 8 * u64::from(room.points), Usage::VERTEX))
            .transpose()?;
        let vertices = is_evaluated
            .then(|| make("vertices", vertex_bytes, Usage::VERTEX | rays))
            .transpose()?;
        let indices = (form.points.has_indices())
            .then(|| make("indices", index_bytes, Usage::INDEX | rays))
            .transpose()?;
        let unread = (points.is_none() && gl::is_gl(device))
            .then(|| gpu::empty(device, "unread", 8, Usage::VERTEX))
            .transpose()?;
        Ok(Self { points, vertices, indices, unread })
    }

    /// The vertex buffer of draws.
    pub(super) fn loaded(&self) -> Option<&wgpu::Buffer> {
        self.vertices.as_ref().or(self.points.as_ref())
    }
}

impl StageOutput {
    /// `factors` and the groups' first patches are those of the batch.
    pub(super) fn new(
        tessellator: &mut Tessellator,
        form: Form,
        (room, stored): (Capacity, Stored),
        (factors, groups): (&wgpu::Buffer, &[u32]),
        evaluation: Option<&Evaluation>,
    ) -> Result<Self, Error> {
        let outputs = match (&stored.points, &stored.indices) {
            (Some(points), Some(indices)) => Outputs::Buffers { points, indices },
            (None, Some(indices)) => Outputs::Indices { points: room.points, indices },
            _ => Outputs::Arguments(room),
        };
        let Form { setup, patches, .. } = form;
        let batch = tessellator.batch_in_groups(setup, patches, groups, factors, outputs)?;
        let windows = match (evaluation, &stored.points, &stored.vertices) {
            (Some(evaluation), Some(points), Some(vertices)) => {
                let of = (&batch, factors);
                evaluation.windows(tessellator, of, [points, vertices], room.points)?
            }
            _ => Vec::new(),
        };
        let (batch, windows, own) = (Arc::new(batch), windows.into(), Arc::default());
        Ok(Self { room, batch, stored, windows, own })
    }

    /// The number of groups that can be drawn one by one.
    pub(super) fn groups(&self) -> u32 {
        self.batch.plan().groups()
    }

    /// The stage's bind group of a draw with this layout.
    pub(super) fn own(
        &self,
        device: &wgpu::Device,
        layout: &OwnLayout,
    ) -> Result<&wgpu::BindGroup, Error> {
        self.own.of(device, layout, (&self.batch, self.stored.vertices.as_ref()))
    }

    /// Bytes of the evaluated vertices; 0 if there are none.
    pub(super) fn vertex_bytes(&self) -> u64 {
        self.stored.vertices.as_ref().map_or(0, wgpu::Buffer::size)
    }

    /// Draws with the arguments of the whole batch or of one of its groups. The caller has set the
    /// pipeline, whose vertex shader loads in this way, and all bind groups.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, load: Load, of_group: Option<u32>) {
        let (arguments, offset) = match of_group {
            None => (self.batch.draw_arguments(), 0),
            Some(group) => {
                (self.batch.group_arguments(), u64::from(group) * TessellationStage::GROUP_BYTES)
            }
        };
        let attributes = self.stored.loaded().or(self.stored.unread.as_ref());
        if let Some(vertices) = attributes.filter(|_| load == Load::Attributes) {
            pass.set_vertex_buffer(0, vertices.slice(..));
        }
        match &self.stored.indices {
            Some(indices) => {
                pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed_indirect(arguments, offset);
            }
            // The first four words of the arguments are those of a draw without indices.
            None => pass.draw_indirect(arguments, offset),
        }
    }
}

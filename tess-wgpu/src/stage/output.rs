//! The parts that depend on the room: the batch, and the buffers that it writes.

use super::DrawBuffers;
use super::choices::Points;
use super::gl;
use super::room::Form;
use crate::device::gpu;
use crate::device::pipeline::group;
use crate::error::Error;
use crate::{Batch, Outputs, Tessellator};
use tess_gpu::layout::Job;
use tess_gpu::{Capacity, Pull, Resource, Span};
use wgpu::BufferUsages as Usage;

/// A batch with room for its output.
#[derive(Debug)]
pub(super) struct StageOutput {
    pub(super) room: Capacity,
    pub(super) batch: Batch,
    pub(super) stored: Stored,
    pulled: Option<wgpu::BindGroup>,
}

/// The buffers that a batch writes and a draw reads, where there are any.
#[derive(Clone, Debug)]
pub(super) struct Stored {
    pub(super) points: Option<wgpu::Buffer>,
    pub(super) indices: Option<wgpu::Buffer>,
    /// A buffer in place of the points where [`gl::attributes`] need a buffer that nothing reads.
    unread: Option<wgpu::Buffer>,
}

impl Stored {
    /// Buffers for this room.
    pub(super) fn new(device: &wgpu::Device, form: Form, room: Capacity) -> Result<Self, Error> {
        let make = |label, size, usage| {
            gpu::empty(device, label, size, Usage::STORAGE | Usage::COPY_SRC | usage)
        };
        let primitive_bytes = u64::from(form.setup.primitive_bytes());
        let index_bytes = (u64::from(room.primitives) * primitive_bytes).next_multiple_of(8);
        let points = (form.points == Points::Stored)
            .then(|| make("points", 8 * u64::from(room.points), Usage::VERTEX))
            .transpose()?;
        let indices = (form.points != Points::PullWithoutIndices)
            .then(|| make("indices", index_bytes, Usage::INDEX))
            .transpose()?;
        let unread = (points.is_none() && gl::is_gl(device))
            .then(|| gpu::empty(device, "unread", 8, Usage::VERTEX))
            .transpose()?;
        Ok(Self { points, indices, unread })
    }
}

impl StageOutput {
    /// `factors` and the groups' first patches are those of the batch; `pulled` is the layout of what
    /// the vertex shader binds, if it computes its points.
    pub(super) fn new(
        tessellator: &mut Tessellator,
        form: Form,
        (room, stored): (Capacity, Stored),
        (factors, groups): (&wgpu::Buffer, &[u32]),
        pulled: Option<&wgpu::BindGroupLayout>,
    ) -> Result<Self, Error> {
        let outputs = match (&stored.points, &stored.indices) {
            (Some(points), Some(indices)) => Outputs::Buffers { points, indices },
            (None, Some(indices)) => Outputs::Indices { points: room.points, indices },
            _ => Outputs::Arguments(room),
        };
        let Form { setup, patches, .. } = form;
        let batch = tessellator.batch_in_groups(setup, patches, groups, factors, outputs)?;
        let pulled = match pulled {
            Some(layout) => Some(bind(tessellator, form, layout, &batch)?),
            None => None,
        };
        Ok(Self { room, batch, stored, pulled })
    }

    /// Draws with the arguments of the whole batch or of one of its groups. Pipeline and user's bind
    /// groups are set; `own_group` is the number of the stage's bind group.
    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        own_group: u32,
        of_group: Option<u32>,
    ) {
        let (arguments, offset) = match of_group {
            None => (self.batch.draw_arguments(), 0),
            Some(group) => {
                (self.batch.group_arguments(), u64::from(group) * DrawBuffers::GROUP_BYTES)
            }
        };
        if let Some(points) = self.stored.points.as_ref().or(self.stored.unread.as_ref()) {
            pass.set_vertex_buffer(0, points.slice(..));
        }
        if let Some(pulled) = &self.pulled {
            pass.set_bind_group(own_group, pulled, &[]);
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

/// The bindings of `Pull::source_for_drawing`.
fn bind(
    tessellator: &Tessellator,
    form: Form,
    layout: &wgpu::BindGroupLayout,
    batch: &Batch,
) -> Result<wgpu::BindGroup, Error> {
    let bound = |resource| match resource {
        Resource::Job => {
            batch.buffers().bound(resource, Span { offset: 0, size: size_of::<Job>() as u64 })
        }
        _ => batch.buffers().of(resource).as_entire_binding(),
    };
    let bindings = Pull { group: 0, first_binding: 0 }
        .bindings(form.setup)
        .map(|(number, resource)| (number, bound(resource)));
    group(tessellator.device(), "pulled", layout, bindings)
}

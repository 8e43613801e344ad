//! The tessellation stage: a hull and a domain function in WGSL, drawn.

mod builder;
mod error;
mod feedback;
mod fit;
mod gl;
mod make;
mod origin;
mod output;
mod passes;
mod room;
pub(crate) mod source;

pub use builder::{Factors, Points, StageBuilder};
pub use error::StageError;
pub use feedback::Feedback;
pub use room::{Overflow, Room};

use crate::error::Error;
use crate::{Tessellator, gpu};
use feedback::Feedbacks;
use fit::Fit;
use origin::Origin;
use output::Output;
use room::Form;
use tess_core::{Config, Domain, PatchFactors};
use tess_gpu::Capacity;
use tess_gpu::layout::factor_words;
use wgpu::BufferUsages as Usage;

/// A tessellation stage for a render pass.
///
/// The user's WGSL declares `struct Vertex` with `@builtin(position)` and whatever is interpolated, and
/// two functions, whose parameters may have any names:
///
/// ```wgsl
/// fn hull(number: u32) -> QuadFactors              // or TriFactors, IsolineFactors, as the domain is
/// fn domain(number: u32, uv: vec2<f32>) -> Vertex  // one vertex of patch `number`
/// ```
///
/// `QuadFactors(edges: vec4<f32>, inside: vec2<f32>)` has the edges u = 0, v = 0, u = 1, v = 1, then u
/// and v; `TriFactors(edges: vec3<f32>, inside: f32)` the edges u = 0, v = 0, w = 0;
/// `IsolineFactors(density: f32, detail: f32)` lines and segments. A patch with an edge factor of 0 is
/// culled. On a triangle the third coordinate is `1.0 - uv.x - uv.y`, exactly.
///
/// Names that begin with `tess_` are the stage's own.
#[derive(Debug)]
pub struct TessellationStage {
    device: wgpu::Device,
    tessellator: Tessellator,
    form: Form,
    room: Room,
    groups: Vec<u32>,
    bind_groups: Vec<wgpu::BindGroup>,
    /// The raw factors of the frame, as the batch reads them.
    factors: wgpu::Buffer,
    /// The number of patches of the frame.
    count: wgpu::Buffer,
    origin: Origin,
    fit: Option<Fit>,
    pulled: Option<wgpu::BindGroupLayout>,
    /// None if the caller draws with its own.
    pipeline: Option<wgpu::RenderPipeline>,
    output: Output,
    feedback: Feedbacks,
    frame: u64,
}

/// What a frame left on the device for an engine that records its own draws: indexed, triangle lists unless the
/// configuration says otherwise, indices of 32 bits.
#[derive(Clone, Copy, Debug)]
pub struct DrawBuffers<'a> {
    /// The vertex buffer, as [`StageBuilder::vertex_shader`] reads it.
    pub points: &'a wgpu::Buffer,
    /// The index buffer.
    pub indices: &'a wgpu::Buffer,
    /// The arguments of `draw_indexed_indirect` for all patches, at offset 0.
    pub arguments: &'a wgpu::Buffer,
    /// The arguments for each group, [`DrawBuffers::GROUP_BYTES`] apart.
    pub group_arguments: &'a wgpu::Buffer,
}

impl DrawBuffers<'_> {
    /// Bytes of the arguments of one group.
    pub const GROUP_BYTES: u64 = size_of::<tess_gpu::layout::DrawIndexed>() as u64;
}

/// How many patches a frame has: a `u32`, or a `u32` in a buffer of the device.
#[derive(Clone, Copy, Debug)]
pub enum PatchCount<'a> {
    /// So many.
    Host(u32),
    /// The number at this offset, a multiple of 4, of a buffer with the usage `COPY_SRC`. If it exceeds
    /// what the stage was made for, the patches beyond are left out.
    Device(&'a wgpu::Buffer, u64),
}

impl From<u32> for PatchCount<'_> {
    fn from(count: u32) -> Self {
        Self::Host(count)
    }
}

impl TessellationStage {
    /// Begins a stage of up to `patches` patches of one domain, with the user's WGSL.
    pub const fn builder(
        source: &str,
        domain: Domain,
        config: Config,
        patches: u32,
    ) -> StageBuilder<'_> {
        StageBuilder::new(source, domain, config, patches)
    }

    /// Records the compute passes of a frame: factors, tessellation. They come before the render pass that
    /// draws the stage, in the same encoder or in one that is submitted before. Their time depends on
    /// what is drawn and, a little, on the most patches that the stage was made for.
    ///
    /// # Errors
    /// [`StageError::TooManyPatches`] or [`StageError::BadPatchCount`] for this number of patches;
    /// [`Error::OutOfMemory`] or [`Error::DeviceLost`]; [`Error::Refused`] for bind groups that do not
    /// go with their layouts.
    pub fn prepare<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<(), Error> {
        self.feedback.take(&self.device, self.frame)?;
        self.grow(encoder)?;
        self.set_count(encoder, patches.into())?;
        self.origin.encode(&self.device, encoder, &self.bind_groups)?;
        if let Some(fit) = &self.fit {
            fit.encode(encoder);
        }
        let batch = &self.output.batch;
        batch.encode(encoder);
        let of = (batch, self.fit.as_ref());
        self.feedback.record(&self.device, encoder, of, self.frame)?;
        self.frame += 1;
        Ok(())
    }

    /// Draws all patches of the last frame that was prepared. A stage that was made without a pipeline takes the
    /// pass's pipeline and bind groups, which must be set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_as(pass, None);
    }

    /// Draws one group of patches. [`Self::set_bind_group`] in front of it gives the group a material of
    /// its own.
    ///
    /// # Errors
    /// [`StageError::NoSuchGroup`].
    pub fn draw_group(&self, pass: &mut wgpu::RenderPass<'_>, group: u32) -> Result<(), Error> {
        if group as usize >= self.groups.len() {
            return Err(StageError::NoSuchGroup { group, groups: self.groups.len() }.into());
        }
        self.draw_as(pass, Some(group));
        Ok(())
    }

    fn draw_as(&self, pass: &mut wgpu::RenderPass<'_>, group: Option<u32>) {
        let mut number = 0;
        if let Some(pipeline) = &self.pipeline {
            pass.set_pipeline(pipeline);
            for own in &self.bind_groups {
                pass.set_bind_group(number, own, &[]);
                number += 1;
            }
        }
        self.output.draw(pass, number, group);
    }

    /// The buffers of the last frame that was prepared, for an engine that records the draws itself. They are
    /// others after a call of [`Self::prepare`] that made more room and after [`Self::set_groups`]. `None`
    /// unless points and indices are stored.
    #[must_use]
    pub const fn buffers(&self) -> Option<DrawBuffers<'_>> {
        match (&self.output.points, &self.output.indices) {
            (Some(points), Some(indices)) => Some(DrawBuffers {
                points,
                indices,
                arguments: self.output.batch.draw_arguments(),
                group_arguments: self.output.batch.group_arguments(),
            }),
            _ => None,
        }
    }

    /// Replaces the groups that [`StageBuilder::groups`] gave, from the next call of [`Self::prepare`] on. Nothing
    /// is compiled; buffers of the same size are made.
    ///
    /// # Errors
    /// [`Error::MisplacedGroup`]; [`Error::OutOfMemory`]. The groups are then what they were.
    pub fn set_groups(&mut self, first_patches: &[u32]) -> Result<(), Error> {
        let of_batch = (&self.factors, first_patches);
        let (room, pulled) = (self.output.room, self.pulled.as_ref());
        self.output = Output::new(&mut self.tessellator, self.form, room, of_batch, pulled)?;
        self.groups = first_patches.to_vec();
        Ok(())
    }

    /// Replaces one of the user's bind groups, by its number; from the next call of `prepare` or `draw`
    /// on.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`].
    pub fn set_bind_group(&mut self, number: u32, group: &wgpu::BindGroup) -> Result<(), Error> {
        let groups = self.bind_groups.len();
        let place = self.bind_groups.get_mut(number as usize);
        *place.ok_or(StageError::NoSuchBindGroup { number, groups })? = group.clone();
        Ok(())
    }

    /// Records new factors from the host, for the patches from the first one on. Patches that never had
    /// factors are culled.
    ///
    /// # Errors
    /// [`StageError::NotHostFactors`], [`StageError::TooManyPatches`], [`Error::WrongDomain`]; and
    /// [`Error::OutOfMemory`].
    pub fn set_factors(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: &[PatchFactors],
    ) -> Result<(), Error> {
        let host = self.origin.host.as_ref().ok_or(StageError::NotHostFactors)?;
        let (got, most) = (u32::try_from(patches.len()).unwrap_or(u32::MAX), self.form.patches);
        if got > most {
            return Err(StageError::TooManyPatches { got, most }.into());
        }
        crate::whole::check_domains(self.form.setup, patches)?;
        let words = factor_words(patches);
        let bytes: &[u8] = bytemuck::cast_slice(&words);
        if bytes.is_empty() {
            return Ok(());
        }
        let staging = gpu::filled(&self.device, "new factors", bytes, Usage::COPY_SRC)?;
        encoder.copy_buffer_to_buffer(&staging, 0, host, 0, bytes.len() as u64);
        Ok(())
    }

    /// What the latest frame needed that has arrived; a frame or two late, `None` at first. It arrives while the
    /// device is polled, which `prepare` does without waiting.
    #[must_use]
    pub const fn feedback(&self) -> Option<Feedback> {
        self.feedback.last()
    }

    /// The room that there is.
    #[must_use]
    pub const fn capacity(&self) -> Capacity {
        self.output.room
    }

    /// The batch that the frames run, and the buffers of its points and indices, where there are any.
    #[cfg(feature = "measure")]
    #[must_use]
    pub const fn inside(&self) -> (&crate::Batch, [Option<&wgpu::Buffer>; 2]) {
        let Output { batch, points, indices, .. } = &self.output;
        (batch, [points.as_ref(), indices.as_ref()])
    }

    /// A user's WGSL with the stage's types and helpers, and `own` behind it.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn joined(user: &str, own: &str) -> String {
        source::of_test(user, own)
    }

    /// Makes more room if a frame needed it and the stage may.
    fn grow(&mut self, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
        let Some(Feedback { points, primitives, .. }) = self.feedback.last() else { return Ok(()) };
        let needed = [points, primitives];
        let Some(room) = self.form.grown(self.room, self.output.room, needed) else {
            return Ok(());
        };
        let own = (&self.factors, &self.groups[..]);
        let pulled = self.pulled.as_ref();
        self.output = match Output::new(&mut self.tessellator, self.form, room, own, pulled) {
            Ok(output) => output,
            // What there is still serves; asking again each frame would not help.
            Err(Error::OutOfMemory) => {
                self.room = Room::Exactly(self.output.room);
                return Ok(());
            }
            Err(error) => return Err(error),
        };
        match &self.fit {
            Some(fit) => fit.set_room(&self.device, encoder, room),
            None => Ok(()),
        }
    }

    /// Records the number of patches where the passes read it.
    fn set_count(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        patches: PatchCount<'_>,
    ) -> Result<(), Error> {
        match patches {
            PatchCount::Host(got) => {
                let most = self.form.patches;
                if got > most {
                    return Err(StageError::TooManyPatches { got, most }.into());
                }
                let bytes = got.to_le_bytes();
                let staging = gpu::filled(&self.device, "patches", &bytes, Usage::COPY_SRC)?;
                encoder.copy_buffer_to_buffer(&staging, 0, &self.count, 0, 4);
            }
            PatchCount::Device(buffer, offset) => {
                let (size, usage) = (buffer.size(), buffer.usage());
                let is_inside = offset.checked_add(4).is_some_and(|end| end <= size);
                if !is_inside || offset % 4 != 0 || !usage.contains(Usage::COPY_SRC) {
                    return Err(StageError::BadPatchCount { offset, size, usage }.into());
                }
                encoder.copy_buffer_to_buffer(buffer, offset, &self.count, 0, 4);
            }
        }
        Ok(())
    }
}

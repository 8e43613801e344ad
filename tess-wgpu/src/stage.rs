//! The tessellation stage: a hull and a domain function in WGSL, drawn.

mod bound;
mod builder;
mod choices;
mod feedback;
mod fit;
mod gl;
mod make;
mod modules;
mod origin;
mod output;
mod passes;
mod room;
pub(crate) mod source;
mod wgsl;

pub use crate::error::StageError;
pub use builder::StageBuilder;
pub use choices::{Factors, Overflow, Points, Room};
pub use feedback::Feedback;

use crate::error::Error;
use crate::{Gpu, Tessellator, gpu};
use bound::Bound;
use feedback::Feedbacks;
use fit::Fit;
use origin::Origin;
use output::{Output, Stored};
use room::Form;
use std::sync::{Mutex, MutexGuard, PoisonError};
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
    bound: Bound,
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
    /// Other groups and their output, from the next frame on.
    next: Option<(Vec<u32>, Output)>,
    feedback: Mutex<Feedbacks>,
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
    /// An encoder that is dropped instead of submitted leaves the stage as it was.
    ///
    /// # Errors
    /// [`StageError::TooManyPatches`] or [`StageError::BadPatchCount`] for this number of patches;
    /// [`Error::OutOfMemory`] or [`Error::DeviceLost`]. Nothing is recorded then, and what was prepared last can still
    /// be drawn.
    pub fn prepare<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<(), Error> {
        locked(&self.feedback).take(&self.device, self.frame)?;
        self.record(encoder, patches.into())
    }

    fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: PatchCount<'_>,
    ) -> Result<(), Error> {
        let (count, offset) = self.count_words(patches)?;
        if let Some((groups, output)) = self.next.take() {
            self.groups = groups;
            self.output = output;
        }
        self.grow()?;
        encoder.copy_buffer_to_buffer(&count, offset, &self.count, 0, 4);
        self.origin.encode(encoder, self.bound.groups());
        if let Some(fit) = &self.fit {
            fit.encode(encoder);
        }
        let batch = &self.output.batch;
        batch.encode(encoder);
        let of = (batch, self.fit.as_ref());
        locked(&self.feedback).record(&self.device, encoder, of, self.frame)?;
        self.frame += 1;
        Ok(())
    }

    /// Makes the room that a frame needs before it is drawn: runs a frame's compute passes, waits for what they
    /// found, and grows as [`Room::Automatic`] says. A frame with the same factors is then exact if the room
    /// allows. Frames of other factors may need more.
    ///
    /// It takes one round trip to the device, so call it after [`StageBuilder::build`] or for a picture that is drawn
    /// once. What the factors are computed from must have been written.
    ///
    /// # Errors
    /// As [`Self::prepare`]; and [`Error::Refused`] in a browser, where only [`Self::make_room_async`] can wait.
    pub fn make_room<'a>(
        &mut self,
        queue: &wgpu::Queue,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<Feedback, Error> {
        let gpu = self.gpu(queue);
        gpu.finish(self.run_once(&gpu, patches.into()))
    }

    /// The same without blocking: see [`Gpu::read_async`].
    ///
    /// # Errors
    /// As [`Self::prepare`].
    pub async fn make_room_async<'a>(
        &mut self,
        queue: &wgpu::Queue,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<Feedback, Error> {
        let gpu = self.gpu(queue);
        self.run_once(&gpu, patches.into()).await
    }

    fn gpu(&self, queue: &wgpu::Queue) -> Gpu {
        let info = self.device.adapter_info();
        Gpu { device: self.device.clone(), queue: queue.clone(), info }
    }

    /// Runs a frame, waits for its numbers and makes room for it.
    async fn run_once(&mut self, gpu: &Gpu, patches: PatchCount<'_>) -> Result<Feedback, Error> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let frame = self.frame;
        self.record(&mut encoder, patches)?;
        gpu.submit(encoder)?;
        let of = (&self.output.batch, self.fit.as_ref());
        let found = feedback::wait(gpu, of, frame).await?;
        locked(&self.feedback).arrived(Some(found));
        self.grow()?;
        Ok(found)
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
            for own in self.bound.groups() {
                pass.set_bind_group(number, own, &[]);
                number += 1;
            }
        }
        self.output.draw(pass, number, group);
    }

    /// The buffers of the last frame that was prepared, for an engine that records the draws itself. A call of
    /// [`Self::prepare`] replaces them if it makes more room or if [`Self::set_groups`] came before it. `None`
    /// unless points and indices are stored.
    #[must_use]
    pub const fn buffers(&self) -> Option<DrawBuffers<'_>> {
        match (&self.output.stored.points, &self.output.stored.indices) {
            (Some(points), Some(indices)) => Some(DrawBuffers {
                points,
                indices,
                arguments: self.output.batch.draw_arguments(),
                group_arguments: self.output.batch.group_arguments(),
            }),
            _ => None,
        }
    }

    /// Replaces the groups that [`StageBuilder::groups`] gave, from the next call of [`Self::prepare`] on. Until then
    /// the frame that was prepared is drawn with its own groups. Nothing is compiled.
    ///
    /// # Errors
    /// [`Error::MisplacedGroup`]; [`Error::OutOfMemory`]. The groups are then what they were.
    pub fn set_groups(&mut self, first_patches: &[u32]) -> Result<(), Error> {
        let output = self.output_of(self.output.room, first_patches, self.output.stored.clone())?;
        self.next = Some((first_patches.to_vec(), output));
        Ok(())
    }

    /// A batch of these groups that writes these buffers.
    fn output_of(
        &mut self,
        room: Capacity,
        groups: &[u32],
        stored: Stored,
    ) -> Result<Output, Error> {
        let of_batch = (&self.factors, groups);
        let pulled = self.pulled.as_ref();
        Output::new(&mut self.tessellator, self.form, (room, stored), of_batch, pulled)
    }

    /// Replaces one of the user's bind groups, by its number, from the next call of `prepare` or `draw`
    /// on.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`]; [`StageError::BadBindGroup`] for a group that does not go with its layout.
    /// The bind groups are then what they were.
    pub fn set_bind_group(&mut self, number: u32, group: &wgpu::BindGroup) -> Result<(), Error> {
        self.bound.set(&self.device, number, group)
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

    /// What the latest frame needed whose numbers have arrived; `None` at first. Numbers arrive a frame or two after
    /// the submission. This asks the device without waiting, as [`Self::prepare`] does.
    #[must_use]
    pub fn feedback(&self) -> Option<Feedback> {
        let mut feedback = locked(&self.feedback);
        // A lost device has nothing new; `prepare` reports it.
        let _ = feedback.take(&self.device, self.frame);
        feedback.last()
    }

    /// The raw factors of the last frame that was submitted, as [`factor_words`] lays them out, with the usages
    /// `STORAGE` and `COPY_SRC`. If the frame did not fit, they are the ones that it was scaled down to. Patches beyond
    /// the frame's number have factors of 0.
    #[must_use]
    pub const fn factors(&self) -> &wgpu::Buffer {
        &self.factors
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
        let Output { batch, stored, .. } = &self.output;
        (batch, [stored.points.as_ref(), stored.indices.as_ref()])
    }

    /// A user's WGSL with the stage's types and helpers, and `own` behind it.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn joined(user: &str, own: &str) -> String {
        source::joined(user, own)
    }

    /// Makes more room if a frame needed it and the stage may.
    fn grow(&mut self) -> Result<(), Error> {
        let last = locked(&self.feedback).last();
        let Some(Feedback { points, primitives, .. }) = last else { return Ok(()) };
        let needed = [points, primitives];
        let Some(room) = self.form.grown(self.room, self.output.room, needed) else {
            return Ok(());
        };
        match self.make_output(room) {
            Ok(()) => Ok(()),
            // What there is still serves; asking again each frame would not help.
            Err(Error::OutOfMemory) => {
                self.room = Room::Exactly(self.output.room);
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    /// Replaces the output by one with this room. On an error everything is as it was.
    fn make_output(&mut self, room: Capacity) -> Result<(), Error> {
        let words = fit::room_words(&self.device, room)?;
        let stored = Stored::new(&self.device, self.form, room)?;
        let groups = self.groups.clone();
        self.output = self.output_of(room, &groups, stored)?;
        if let Some(fit) = &mut self.fit {
            fit.set_room(words);
        }
        Ok(())
    }

    /// The number of patches as a word of a buffer, and its offset there.
    fn count_words(&self, patches: PatchCount<'_>) -> Result<(wgpu::Buffer, u64), Error> {
        match patches {
            PatchCount::Host(got) => {
                let most = self.form.patches;
                if got > most {
                    return Err(StageError::TooManyPatches { got, most }.into());
                }
                let bytes = got.to_le_bytes();
                Ok((gpu::filled(&self.device, "patches", &bytes, Usage::COPY_SRC)?, 0))
            }
            PatchCount::Device(buffer, offset) => {
                let (size, usage) = (buffer.size(), buffer.usage());
                let is_inside = offset.checked_add(4).is_some_and(|end| end <= size);
                if !is_inside || offset % 4 != 0 || !usage.contains(Usage::COPY_SRC) {
                    return Err(StageError::BadPatchCount { offset, size, usage }.into());
                }
                Ok((buffer.clone(), offset))
            }
        }
    }
}

fn locked(feedback: &Mutex<Feedbacks>) -> MutexGuard<'_, Feedbacks> {
    feedback.lock().unwrap_or_else(PoisonError::into_inner)
}

//! The tessellation stage: a hull and a domain function in WGSL, drawn.

mod build;
mod builder;
mod choices;
mod factor_pass;
mod feedback;
mod fit;
mod frames;
mod gl;
mod modules;
mod output;
mod passes;
mod room;
pub(crate) mod source;
mod wgsl;

pub use crate::error::StageError;
pub use builder::StageBuilder;
pub use choices::{Factors, Overflow, PatchCount, Points, Room};
pub use feedback::Feedback;

use crate::Tessellator;
use crate::batch::check_groups;
use crate::device::gpu;
use crate::error::Error;
use factor_pass::FactorPass;
use feedback::Feedbacks;
use fit::Fit;
use output::StageOutput;
use room::{Form, Lull};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tess_core::{Config, Domain, PatchFactors};
use tess_gpu::Capacity;
use tess_gpu::layout::factor_words;
use wgpu::BufferUsages as Usage;

/// A tessellation stage for a render pass.
///
/// The user's WGSL declares `struct Vertex`, with `@builtin(position)` and the members that are interpolated, and
/// two functions. Their parameters may have any names:
///
/// ```wgsl
/// fn hull(number: u32) -> QuadFactors              // or TriFactors, IsolineFactors, as the domain is
/// fn domain(number: u32, uv: vec2<f32>) -> Vertex  // one vertex of patch `number`
/// ```
///
/// | result | members |
/// | --- | --- |
/// | `QuadFactors(edges: vec4<f32>, inside: vec2<f32>)` | edges u = 0, v = 0, u = 1, v = 1; inside along u, along v |
/// | `TriFactors(edges: vec3<f32>, inside: f32)` | edges u = 0, v = 0, w = 0; inside |
/// | `IsolineFactors(density: f32, detail: f32)` | number of lines; segments of each line |
///
/// An edge factor that is 0, negative or NaN culls the patch. On a triangle the third coordinate is exactly
/// `1.0 - uv.x - uv.y`.
///
/// Names that begin with `tess_` are the stage's. A name of WGSL's own that the stage's functions use, such as
/// `distance`, cannot be declared.
#[derive(Debug)]
pub struct TessellationStage {
    device: wgpu::Device,
    tessellator: Tessellator,
    form: Form,
    room: Room,
    lull: Lull,
    groups: Vec<u32>,
    /// Groups in place of those that the batch was made with, copied there in each frame.
    begins: Option<wgpu::Buffer>,
    bind_groups: Vec<UserGroup>,
    /// The raw factors of the frame, as the batch reads them.
    factors: wgpu::Buffer,
    /// The number of patches of the frame.
    count: wgpu::Buffer,
    factor_pass: FactorPass,
    fit: Option<Fit>,
    pulled: Option<wgpu::BindGroupLayout>,
    /// None if the caller draws with its own.
    pipeline: Option<Arc<wgpu::RenderPipeline>>,
    output: StageOutput,
    /// Other groups and their output, from the next frame on.
    next: Option<(Vec<u32>, StageOutput)>,
    feedback: Mutex<Feedbacks>,
    frame: u64,
}

/// A bind group of the user's, and its dynamic offsets.
type UserGroup = (wgpu::BindGroup, Vec<wgpu::DynamicOffset>);

/// The buffers of a frame, for an engine that records its own draws. Draws are indexed, with indices of 32 bits.
/// Primitives are triangles unless the configuration's output says otherwise.
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

    /// Draws all patches of the last frame that was prepared. A stage without a pipeline draws with the pass's pipeline
    /// and bind groups, which must be set.
    ///
    /// A render bundle would keep buffers that [`Self::prepare`] may replace, so there is no call that draws in one.
    /// Record your own with [`Self::buffers`], anew whenever [`Self::capacity`] changes.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_as(pass, None);
    }

    /// Draws one group of patches. Call [`Self::set_bind_group`] before it to give the group its own material.
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
            for (own, offsets) in &self.bind_groups {
                pass.set_bind_group(number, own, offsets);
                number += 1;
            }
        }
        self.output.draw(pass, number, group);
    }

    /// The buffers of the last frame that was prepared, for an engine that records the draws itself. A call of
    /// [`Self::prepare`] replaces them if it makes more room or if [`Self::set_groups`] gave another number of groups.
    ///
    /// # Errors
    /// [`StageError::NothingStored`] unless points and indices are stored.
    pub fn buffers(&self) -> Result<DrawBuffers<'_>, Error> {
        match (&self.output.stored.points, &self.output.stored.indices) {
            (Some(points), Some(indices)) => Ok(DrawBuffers {
                points,
                indices,
                arguments: self.output.batch.draw_arguments(),
                group_arguments: self.output.batch.group_arguments(),
            }),
            _ => Err(Error::Stage(StageError::NothingStored)),
        }
    }

    /// Replaces the groups that [`StageBuilder::groups`] gave, from the next call of [`Self::prepare`] on. Until then
    /// the frame that was prepared is drawn with its own groups. Nothing is compiled; as many groups as before are a copy
    /// of their numbers.
    ///
    /// # Errors
    /// [`Error::MisplacedGroup`]; [`Error::OutOfMemory`]. The groups are then what they were.
    pub fn set_groups(&mut self, first_patches: &[u32]) -> Result<(), Error> {
        if self.next.is_none() && first_patches.len() == self.groups.len() {
            check_groups(self.form.patches, first_patches)?;
            let bytes = bytemuck::cast_slice(first_patches);
            self.begins = Some(gpu::filled(&self.device, "new groups", bytes, Usage::COPY_SRC)?);
            self.groups = first_patches.to_vec();
            return Ok(());
        }
        let output = self.output_of(self.output.room, first_patches, self.output.stored.clone())?;
        self.next = Some((first_patches.to_vec(), output));
        Ok(())
    }

    /// Replaces one of the user's bind groups, by its number, from the next call of `prepare` or `draw` on.
    ///
    /// A group of another layout than the builder got is an error of wgpu's when the frame's encoder is finished. It
    /// names the group's number and the binding.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`]. The bind groups are then what they were.
    pub fn set_bind_group(&mut self, number: u32, group: &wgpu::BindGroup) -> Result<(), Error> {
        self.user_group(number)?.0.clone_from(group);
        Ok(())
    }

    /// The dynamic offsets of one of the user's bind groups, in bytes and in the order of its bindings, from the next
    /// call of `prepare` or `draw` on. At first there are none. Too many or too few are an error of wgpu's when the
    /// frame's encoder is finished.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`]. The offsets are then what they were.
    pub fn set_dynamic_offsets(&mut self, number: u32, offsets: &[u32]) -> Result<(), Error> {
        self.user_group(number)?.1 = offsets.to_vec();
        Ok(())
    }

    fn user_group(&mut self, number: u32) -> Result<&mut UserGroup, Error> {
        let groups = self.bind_groups.len();
        let own = self.bind_groups.get_mut(number as usize);
        Ok(own.ok_or(StageError::NoSuchBindGroup { number, groups })?)
    }

    /// Records new factors from the host for the first `patches.len()` patches. Patches that never had
    /// factors are culled.
    ///
    /// # Errors
    /// [`StageError::NotHostFactors`], [`StageError::TooManyPatches`], [`StageError::OtherDevice`],
    /// [`Error::WrongDomain`], [`Error::OutOfMemory`].
    pub fn set_factors(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: &[PatchFactors],
    ) -> Result<(), Error> {
        let host = self.factor_pass.host.as_ref().ok_or(StageError::NotHostFactors)?;
        let (got, most) = (u32::try_from(patches.len()).unwrap_or(u32::MAX), self.form.patches);
        if got > most {
            return Err(StageError::TooManyPatches { got, most }.into());
        }
        crate::batch::read_back::check_domains(self.form.setup, patches)?;
        let words = factor_words(patches);
        let bytes: &[u8] = bytemuck::cast_slice(&words);
        if bytes.is_empty() {
            return Ok(());
        }
        let staging = gpu::filled(&self.device, "new factors", bytes, Usage::COPY_SRC)?;
        gpu::recorded(&self.device, || {
            encoder.copy_buffer_to_buffer(&staging, 0, host, 0, bytes.len() as u64);
        })
    }

    /// The needs of the latest frame whose numbers have arrived; `None` at first. Numbers arrive a frame or two after
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

    /// The room for points and primitives that the stage has now.
    #[must_use]
    pub const fn capacity(&self) -> Capacity {
        self.output.room
    }

    /// The batch that the frames run, and the buffers of its points and indices, where there are any.
    #[cfg(feature = "measure")]
    #[must_use]
    pub const fn inside(&self) -> (&crate::Batch, [Option<&wgpu::Buffer>; 2]) {
        let StageOutput { batch, stored, .. } = &self.output;
        (batch, [stored.points.as_ref(), stored.indices.as_ref()])
    }

    /// Gives room back after so many frames that use little of it.
    #[cfg(feature = "measure")]
    pub const fn shrink_after(&mut self, frames: u64) {
        self.lull.patience = frames;
    }

    /// A user's WGSL with the stage's types and helpers, and `own` behind it.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn joined(user: &str, own: &str) -> String {
        source::joined(user, own)
    }
}

fn locked(feedback: &Mutex<Feedbacks>) -> MutexGuard<'_, Feedbacks> {
    feedback.lock().unwrap_or_else(PoisonError::into_inner)
}

//! The tessellation stage: it prepares frames of patches with a hull and a domain function in WGSL,
//! and materials draw them.

mod build;
mod builder;
mod choices;
mod evaluation;
mod factor_pass;
mod feedback;
mod fit;
mod frame;
mod frames;
mod gl;
mod loads;
mod material;
mod mistakes;
mod modules;
mod output;
mod own_group;
mod passes;
mod program;
mod room;
mod shaders;
pub(crate) mod source;
mod user_groups;
mod vertex;
mod wgsl;

pub use crate::error::StageError;
pub use builder::StageBuilder;
pub use choices::{Factors, Overflow, PatchCount, Points, Room};
pub use feedback::Feedback;
pub use frame::Frame;
pub use material::{Material, MaterialBuilder};
pub use shaders::{FixedShaders, ShaderParts, UserShaders};
pub use vertex::VertexLayout;

use crate::Tessellator;
use crate::batch::check_groups;
use crate::device::gpu;
use crate::error::Error;
use evaluation::Evaluation;
use factor_pass::FactorPass;
use feedback::Feedbacks;
use fit::Fit;
use frame::FrameCount;
use output::StageOutput;
use room::{Form, Lull};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tess_core::{Config, Domain, PatchFactors};
use tess_gpu::Capacity;
use tess_gpu::layout::factor_words;
use user_groups::UserGroups;
use wgpu::BufferUsages as Usage;

/// A tessellation stage: the compute passes of each frame, and the room for their output. A
/// [`Material`] draws the frames that it prepares.
///
/// The user's WGSL declares `struct Vertex`, with `@builtin(position)` and the interpolated
/// members, and two functions, whose parameters may have any names:
///
/// ```wgsl
/// fn hull(number: u32) -> QuadFactors              // or TriFactors, IsolineFactors: see the table
/// fn domain(number: u32, uv: vec2<f32>) -> Vertex  // one vertex of patch `number`
/// ```
///
/// | result | members |
/// | --- | --- |
/// | `QuadFactors(edges: vec4<f32>, inside: vec2<f32>)` | edges u = 0, v = 0, u = 1, v = 1; inside along u, along v |
/// | `TriFactors(edges: vec3<f32>, inside: f32)` | edges u = 0, v = 0, w = 0; inside |
/// | `IsolineFactors(density: f32, detail: f32)` | number of lines; segments of each line |
///
/// An edge factor that is 0, negative or NaN culls the patch. On a triangle the third coordinate is
/// exactly `1.0 - uv.x - uv.y`.
///
/// Names that begin with `tess_` are reserved for the stage. The user's WGSL cannot declare a
/// built-in name of WGSL that the stage's functions use, such as `distance`.
#[derive(Debug)]
pub struct TessellationStage {
    tessellator: Tessellator,
    form: Form,
    /// The vertex buffer of draws.
    vertices: VertexLayout,
    bind_groups: UserGroups,
    passes: Passes,
    room: Room,
    lull: Lull,
    /// The first patch of each group. If their number is not that of `output`, the next frame makes
    /// another output.
    groups: Vec<u32>,
    /// The groups, which each frame copies over those in the batch if they have changed but not
    /// their number.
    begins: Option<wgpu::Buffer>,
    /// The number of instances, once [`Self::set_instances`] has set it.
    instances: Option<wgpu::Buffer>,
    output: StageOutput,
    feedback: Mutex<Feedbacks>,
    frames: FrameCount,
    /// Held by the materials without and with a function of `project`.
    kinds: [Arc<()>; 2],
}

/// The compute passes before and after the batch.
#[derive(Debug)]
struct Passes {
    /// The frame's raw factors, as the batch reads them.
    factors: wgpu::Buffer,
    /// The number of patches of the frame.
    count: wgpu::Buffer,
    write: FactorPass,
    /// `None` with [`Overflow::DrawNothing`].
    fit: Option<Fit>,
    /// `None` unless points are evaluated.
    evaluation: Option<Evaluation>,
}

impl TessellationStage {
    /// Bytes of a group's arguments in [`Self::group_indirect`].
    pub const GROUP_BYTES: u64 = size_of::<tess_gpu::layout::DrawIndexed>() as u64;

    /// Returns a builder for a stage of up to `patches` patches of one domain with the user's WGSL.
    pub const fn builder(
        source: &str,
        domain: Domain,
        config: Config,
        patches: u32,
    ) -> StageBuilder<'_> {
        StageBuilder::new(source, domain, config, patches)
    }

    /// The vertex buffer of the last prepared frame, or `None` if the vertex shader computes the
    /// vertices. It holds the user's `Vertex` structs with [`Points::Evaluated`] and packed points
    /// with [`Points::Stored`]; [`Self::vertex_layout`] is its layout. Its usages are `VERTEX`,
    /// `STORAGE` and `COPY_SRC`. Evaluated vertices also have `BLAS_INPUT` if the device was opened
    /// with `EXPERIMENTAL_RAY_QUERY`.
    ///
    /// - **Your own render pass:** set this vertex buffer and [`Self::indices`], and draw with
    ///   [`Self::indirect`].
    /// - **A compute pass:** declare your `struct Vertex` there and bind the buffer as
    ///   `array<Vertex>`, read-only; the first word of [`Self::status`] is the number of vertices.
    ///   Patches, and the points of a patch, follow each other in the model's order.
    /// - **Reading back:** copy part of it; [`Self::feedback`] and [`Self::make_room`] return the
    ///   number of points.
    /// - **Ray tracing:** a bottom-level structure reads `Float32x3` at the beginning of each
    ///   vertex, so make the position in the world the struct's first member. The buffers can be
    ///   longer than the frame's output; see the example `rays`.
    ///
    /// [`Self::prepare`] replaces the buffers when it changes the room, which [`Self::capacity`]
    /// shows, so fetch them in each frame.
    #[must_use]
    pub fn vertices(&self) -> Option<wgpu::Buffer> {
        self.output.stored.loaded().cloned()
    }

    /// The index buffer, with 32-bit indices, or `None` with [`Points::PullWithoutIndices`]. An
    /// index is the number of a vertex of the frame. The configuration's output decides whether
    /// primitives are triangles, lines or points. The usages are `INDEX` and those of
    /// [`Self::vertices`] except `VERTEX`.
    #[must_use]
    pub fn indices(&self) -> Option<wgpu::Buffer> {
        self.output.stored.indices.clone()
    }

    /// The arguments of `draw_indexed_indirect` for all patches, at offset 0, with the usages
    /// `INDIRECT`, `STORAGE` and `COPY_SRC`. Their first word is the number of indices. If there is
    /// no index buffer, the first four words are the arguments of `draw_indirect`.
    #[must_use]
    pub fn indirect(&self) -> wgpu::Buffer {
        self.output.batch.draw_arguments().clone()
    }

    /// The arguments of each group's draw, as in [`Self::indirect`], [`Self::GROUP_BYTES`] apart.
    #[must_use]
    pub fn group_indirect(&self) -> wgpu::Buffer {
        self.output.batch.group_arguments().clone()
    }

    /// The buffer of a [`Status`](tess_gpu::layout::Status), which holds the numbers of points and
    /// primitives, and whether they fitted, once the frame has run. Its usages are `STORAGE` and
    /// `COPY_SRC`.
    #[must_use]
    pub fn status(&self) -> wgpu::Buffer {
        self.output.batch.status().clone()
    }

    /// The layout of [`Self::vertices`].
    #[must_use]
    pub const fn vertex_layout(&self) -> &VertexLayout {
        &self.vertices
    }

    /// Sets the number of instances of every draw, which is 1 at first. It takes effect in the next
    /// call of [`Self::prepare`]. In WGSL, `tess_instance()` returns the number of the instance
    /// that is drawn.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn set_instances(&mut self, instances: u32) -> Result<(), Error> {
        let bytes = instances.to_le_bytes();
        self.instances = Some(gpu::filled(self.device(), "instances", &bytes, Usage::COPY_SRC)?);
        Ok(())
    }

    /// Replaces the groups that [`StageBuilder::groups`] set. The change takes effect in the next
    /// call of [`Self::prepare`]; the prepared frame keeps its groups. Nothing is compiled. If the
    /// number of groups stays the same, their first patches are copied and no buffer is replaced.
    ///
    /// # Errors
    /// [`Error::MisplacedGroup`], [`Error::TooManyGroups`], [`Error::OutOfMemory`]. On an error the
    /// groups stay as they were.
    pub fn set_groups(&mut self, first_patches: &[u32]) -> Result<(), Error> {
        let count = check_groups(self.form.patches, first_patches)?;
        let bytes = bytemuck::cast_slice(first_patches);
        let begins = (count == self.output.groups() && count > 0)
            .then(|| gpu::filled(self.device(), "new groups", bytes, Usage::COPY_SRC))
            .transpose()?;
        self.begins = begins;
        self.groups = first_patches.to_vec();
        Ok(())
    }

    /// Replaces one of the user's bind groups, by its number. The next call of [`Self::prepare`]
    /// uses it; materials have their own.
    ///
    /// If the group's layout differs from the one that the builder got, wgpu reports an error when
    /// the frame's encoder is finished. The error names the group's number and the binding.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`]. On an error the bind groups stay as they were.
    pub fn set_bind_group(&mut self, number: u32, group: &wgpu::BindGroup) -> Result<(), Error> {
        Ok(self.bind_groups.set(number, group)?)
    }

    /// Sets the dynamic offsets of one of the user's bind groups, in bytes and in the order of its
    /// bindings. The next call of [`Self::prepare`] uses them; at first there are none. If there
    /// are too many or too few, wgpu reports an error when the frame's encoder is finished.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`]. On an error the offsets stay as they were.
    pub fn set_dynamic_offsets(&mut self, number: u32, offsets: &[u32]) -> Result<(), Error> {
        Ok(self.bind_groups.set_offsets(number, offsets)?)
    }

    /// Records a copy of new factors from the host to the first `patches.len()` patches. Patches
    /// that never had factors are culled.
    ///
    /// # Errors
    /// [`StageError::NotHostFactors`], [`StageError::TooManyPatches`], [`StageError::OtherDevice`],
    /// [`Error::WrongDomain`], [`Error::OutOfMemory`].
    pub fn set_factors(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: &[PatchFactors],
    ) -> Result<(), Error> {
        let host = self.passes.write.host.as_ref().ok_or(StageError::NotHostFactors)?;
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
        let staging = gpu::filled(self.device(), "new factors", bytes, Usage::COPY_SRC)?;
        gpu::recorded(self.device(), || {
            encoder.copy_buffer_to_buffer(&staging, 0, host, 0, bytes.len() as u64);
        })
    }

    /// The needs of the latest frame whose numbers have arrived; `None` at first. Numbers arrive a
    /// frame or two after the submission. Like [`Self::prepare`], this polls the device and does
    /// not wait.
    #[must_use]
    pub fn feedback(&self) -> Option<Feedback> {
        let mut feedback = locked(&self.feedback);
        // A lost device has nothing new; `prepare` reports it.
        let _ = feedback.take(self.device(), self.frames.get());
        feedback.last()
    }

    /// The raw factors of the last frame that was submitted, as [`factor_words`] lays them out,
    /// with the usages `STORAGE` and `COPY_SRC`. If [`Overflow::Coarser`] scaled them down, they
    /// are the scaled factors. Patches past the frame's number have factors of 0.
    #[must_use]
    pub const fn factors(&self) -> &wgpu::Buffer {
        &self.passes.factors
    }

    /// The room for points and primitives that the stage has now.
    #[must_use]
    pub fn capacity(&self) -> Capacity {
        self.output.room
    }

    const fn device(&self) -> &wgpu::Device {
        self.tessellator.device()
    }

    /// The batch that the frames run, and the buffers of its points and indices, if it has them.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn inside(&self) -> (Arc<crate::Batch>, [Option<wgpu::Buffer>; 2]) {
        let StageOutput { batch, stored, .. } = self.output.clone();
        (batch, [stored.points, stored.indices])
    }

    /// Sets the number of frames with little output after which the room shrinks.
    #[cfg(feature = "measure")]
    pub const fn shrink_after(&mut self, frames: u64) {
        self.lull.patience = frames;
    }

    /// A user's WGSL, followed by the stage's types and helpers and then by `own`.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn joined(user: &str, own: &str) -> String {
        source::joined(user, own)
    }
}

fn locked<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

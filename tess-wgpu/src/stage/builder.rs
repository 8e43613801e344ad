//! The builder of a stage, with a method for each choice.

use super::StageError;
use super::choices::{Factors, Overflow, Points, Room};
use super::program::Program;
use super::room::Form;
use super::source::VertexShader;
use super::vertex::{Load, VertexLayout};
use super::wgsl;
use crate::Tessellator;
use crate::error::Error;
use tess_core::{Config, Domain};
use tess_gpu::{Capacity, Order, Setup};

/// Makes a [`TessellationStage`](super::TessellationStage). Every choice has a default; only
/// [`StageBuilder::build`] must be called.
#[derive(Clone, Debug)]
#[must_use = "the stage is made by `build`"]
pub struct StageBuilder<'a> {
    pub(super) program: Program<'a>,
    domain: Domain,
    config: Config,
    order: Option<Order>,
    pub(super) patches: u32,
    pub(super) factors: Factors<'a>,
    pub(super) points: Points,
    pub(super) room: Room,
    pub(super) first_room: Capacity,
    pub(super) overflow: Overflow,
    pub(super) groups: Vec<u32>,
    pub(super) tessellator: Option<&'a Tessellator>,
}

/// The default budget of [`Room::Automatic`], enough for 16 million small triangles.
const MOST_BYTES: u64 = 256 << 20;

impl<'a> StageBuilder<'a> {
    pub(super) const fn new(source: &'a str, domain: Domain, config: Config, patches: u32) -> Self {
        Self {
            program: Program::new(source),
            domain,
            config,
            order: None,
            patches,
            factors: Factors::Hull,
            points: Points::Stored,
            room: Room::Automatic { most_bytes: MOST_BYTES },
            first_room: Capacity { points: 0, primitives: 0 },
            overflow: Overflow::Coarser,
            groups: Vec::new(),
            tessellator: None,
        }
    }

    /// Adds the user's next bind group: the first call adds `@group(0)`, the second `@group(1)`,
    /// and so on. A device allows 4 by default, of which the stage takes one.
    ///
    /// The compute passes of `hull` and, with [`Points::Evaluated`], of `domain` read them, so the
    /// entries of the layout need the visibility `COMPUTE`. What draws read is given to each
    /// material ([`MaterialBuilder::bind_group`](super::MaterialBuilder::bind_group)). Set dynamic
    /// offsets with [`set_dynamic_offsets`](super::TessellationStage::set_dynamic_offsets). wgpu
    /// checks the group when a frame's encoder is finished: see
    /// [`set_bind_group`](super::TessellationStage::set_bind_group).
    pub fn bind_group(mut self, layout: &wgpu::BindGroupLayout, group: &wgpu::BindGroup) -> Self {
        self.program.bind(layout, group);
        self
    }

    /// Shares pipelines with the stages that were made with the same tessellator or a clone of it.
    /// The tessellation's pipelines depend on the domain, configuration and order; the pipeline of
    /// `hull` on the part of the WGSL that it reaches; the render pipeline of a material on all of
    /// its WGSL and the render state. [`Tessellator::with_pipeline_cache`] adds a pipeline cache of
    /// wgpu's.
    ///
    /// wgpu cannot make pipelines in the background. If a frame must not wait, build stages on
    /// another thread: a stage, its builder and a tessellator are `Send`.
    pub const fn tessellator(mut self, shared: &'a Tessellator) -> Self {
        self.tessellator = Some(shared);
        self
    }

    /// Sets the values of constants that the WGSL declares with `override`, by name.
    pub const fn constants(mut self, values: &'a [(&'a str, f64)]) -> Self {
        self.program.constants = values;
        self
    }

    /// Sets the source of the factors; the default is [`Factors::Hull`].
    pub const fn factors(mut self, factors: Factors<'a>) -> Self {
        self.factors = factors;
        self
    }

    /// Sets the source of the points; the default is [`Points::Stored`].
    pub const fn points(mut self, points: Points) -> Self {
        self.points = points;
        self
    }

    /// Sets the order in which the triangles of a patch are drawn. The default is
    /// [`Order::VertexCache`] if there is an index buffer. Otherwise no vertex cache is used, and
    /// the default is [`Order::Specification`], which takes less time.
    pub const fn order(mut self, order: Order) -> Self {
        self.order = Some(order);
        self
    }

    /// Sets the room for points and indices; the default is [`Room::Automatic`] up to 256 MiB.
    pub const fn room(mut self, room: Room) -> Self {
        self.room = room;
        self
    }

    /// Sets the least room that [`Room::Automatic`] begins with, for example the
    /// [`capacity`](super::TessellationStage::capacity) of a smaller stage that this one replaces.
    pub const fn first_room(mut self, room: Capacity) -> Self {
        self.first_room = room;
        self
    }

    /// Sets the fate of a frame that does not fit; the default is [`Overflow::Coarser`].
    pub const fn overflow(mut self, overflow: Overflow) -> Self {
        self.overflow = overflow;
        self
    }

    /// Divides the patches into groups that can be drawn one by one. A group is given by the number
    /// of its first patch; the numbers ascend ([`crate::Tessellator::batch_in_groups`]).
    pub fn groups(mut self, first_patches: &[u32]) -> Self {
        self.groups = first_patches.to_vec();
        self
    }

    /// The WGSL of the vertex shader, for an engine that makes its own render pipelines, with its
    /// own fragment shaders: for a shadow map, a depth prepass, several cameras. It is the user's
    /// text, unchanged, and then the stage's. The entry point is `tess_vertex`. It takes one vertex
    /// buffer of [`Self::vertex_layout`], and calls the function `project`, if there is one, as
    /// [`MaterialBuilder::project`](super::MaterialBuilder::project) describes. The engine draws
    /// the stage's [`vertices`](super::TessellationStage::vertices),
    /// [`indices`](super::TessellationStage::indices) and
    /// [`indirect`](super::TessellationStage::indirect).
    ///
    /// # Errors
    /// - [`StageError::NothingStored`] if points are pulled: only a material can bind the buffers
    ///   that the text would read. For the same reason, the WGSL cannot call `tess_factors`.
    /// - [`StageError::Wgsl`] if points are evaluated and a member of `Vertex` cannot be an
    ///   attribute.
    pub fn vertex_shader(&self, project: Option<&str>) -> Result<String, Error> {
        let Program { source, .. } = self.program;
        if !self.points.are_written() {
            return Err(StageError::NothingStored.into());
        }
        let vertices = &self.vertex_layout()?;
        let (setup, group) = (self.setup(), self.program.own_group());
        let (points, load) = (self.points, Load::Attributes);
        let shader = VertexShader { setup, points, load, group, project, vertices };
        Ok(shader.with(source))
    }

    /// The layout of the vertex buffer, which holds packed points, or `Vertex` if points are
    /// evaluated.
    ///
    /// # Errors
    /// [`StageError::Wgsl`] if points are evaluated and a member of `Vertex` cannot be an
    /// attribute.
    pub fn vertex_layout(&self) -> Result<VertexLayout, StageError> {
        match self.points {
            Points::Evaluated => VertexLayout::of(&wgsl::declarations(self.program.source)),
            _ => Ok(VertexLayout::packed()),
        }
    }

    /// The parameters that determine the sizes of the stage's buffers.
    pub(super) fn form(&self, device: &wgpu::Device, vertices: &VertexLayout) -> Form {
        let Self { points, patches, .. } = *self;
        let is_evaluated = points == Points::Evaluated;
        let vertex_bytes = if is_evaluated { vertices.array_stride } else { 0 };
        Form {
            setup: self.setup(),
            points,
            vertex_bytes: u32::try_from(vertex_bytes).unwrap_or(u32::MAX),
            patches,
            buffer_limit: device.limits().max_buffer_size,
        }
    }

    /// The setup of the stage's batches.
    pub(super) fn setup(&self) -> Setup {
        let has_indices = self.points.has_indices();
        let default = if has_indices { Order::VertexCache } else { Order::Specification };
        Setup { order: self.order.unwrap_or(default), ..Setup::new(self.domain, self.config) }
    }
}

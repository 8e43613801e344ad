//! The builder of a stage, with a method for each choice.

use super::choices::{Factors, Overflow, Points, Room};
use super::room::Form;
use super::source::{self, VertexShader};
use super::vertex::VertexLayout;
use super::wgsl::{self, Declaration};
use super::{StageError, TessellationStage};
use crate::Tessellator;
use crate::error::Error;
use std::num::NonZeroU32;
use tess_core::{Config, Domain};
use tess_gpu::{Capacity, Order, Setup};

/// Makes a [`TessellationStage`](super::TessellationStage). Every choice has a default; only
/// [`StageBuilder::build`] must be called.
#[derive(Clone, Debug)]
#[must_use = "the stage is made by `build`"]
pub struct StageBuilder<'a> {
    pub(super) source: &'a str,
    domain: Domain,
    config: Config,
    order: Option<Order>,
    pub(super) patches: u32,
    pub(super) layouts: Vec<wgpu::BindGroupLayout>,
    pub(super) bind_groups: Vec<wgpu::BindGroup>,
    pub(super) factors: Factors<'a>,
    pub(super) points: Points,
    pub(super) room: Room,
    pub(super) first_room: Capacity,
    pub(super) overflow: Overflow,
    pub(super) groups: Vec<u32>,
    pub(super) render: Render<'a>,
    /// Whether the stage makes the render pipeline; if not, the caller does.
    pub(super) makes_pipeline: bool,
    pub(super) constants: &'a [(&'a str, f64)],
    pub(super) tessellator: Option<&'a Tessellator>,
    /// The stage whose output this one draws.
    pub(super) output_of: Option<&'a TessellationStage>,
}

/// The part of the render pipeline's state that the user sets.
#[derive(Clone, Debug, Default)]
pub(super) struct Render<'a> {
    pub(super) project: Option<&'a str>,
    pub(super) fragment: Option<&'a str>,
    pub(super) targets: Vec<Option<wgpu::ColorTargetState>>,
    pub(super) depth: Option<wgpu::DepthStencilState>,
    pub(super) multisample: wgpu::MultisampleState,
    pub(super) primitive: wgpu::PrimitiveState,
    pub(super) views: Option<NonZeroU32>,
}

/// The default budget of [`Room::Automatic`], enough for 16 million small triangles.
const MOST_BYTES: u64 = 256 << 20;

impl<'a> StageBuilder<'a> {
    pub(super) const fn new(source: &'a str, domain: Domain, config: Config, patches: u32) -> Self {
        Self {
            source,
            domain,
            config,
            order: None,
            patches,
            layouts: Vec::new(),
            bind_groups: Vec::new(),
            factors: Factors::Hull,
            points: Points::Stored,
            room: Room::Automatic { most_bytes: MOST_BYTES },
            first_room: Capacity { points: 0, primitives: 0 },
            overflow: Overflow::Coarser,
            groups: Vec::new(),
            render: Render {
                project: None,
                fragment: None,
                targets: Vec::new(),
                depth: None,
                multisample: wgpu::MultisampleState {
                    count: 1,
                    mask: !0,
                    alpha_to_coverage_enabled: false,
                },
                primitive: wgpu::PrimitiveState {
                    topology: wgpu::PrimitiveTopology::TriangleList,
                    strip_index_format: None,
                    front_face: wgpu::FrontFace::Ccw,
                    cull_mode: None,
                    unclipped_depth: false,
                    polygon_mode: wgpu::PolygonMode::Fill,
                    conservative: false,
                },
                views: None,
            },
            makes_pipeline: true,
            constants: &[],
            tessellator: None,
            output_of: None,
        }
    }

    /// Adds the user's next bind group: the first call adds `@group(0)`, the second `@group(1)`,
    /// and so on. A device allows 4 by default, of which the stage takes one.
    ///
    /// The entries of the layout need the visibility `COMPUTE` for `hull`, `VERTEX` for `domain`
    /// and the function of [`Self::project`], and `COMPUTE` for `domain` with
    /// [`Points::Evaluated`]. Set dynamic offsets with
    /// [`set_dynamic_offsets`](super::TessellationStage::set_dynamic_offsets). wgpu checks the
    /// group when a frame's encoder is finished: see
    /// [`set_bind_group`](super::TessellationStage::set_bind_group).
    pub fn bind_group(mut self, layout: &wgpu::BindGroupLayout, group: &wgpu::BindGroup) -> Self {
        self.layouts.push(layout.clone());
        self.bind_groups.push(group.clone());
        self
    }

    /// Shares pipelines with the stages that were made with the same tessellator or a clone of it.
    /// The tessellation's pipelines depend on the domain, configuration and order; the pipeline of
    /// `hull` on the part of the WGSL that it reaches; the render pipeline on all of the WGSL and
    /// the render state. A stage for another material therefore makes only one pipeline.
    /// [`Tessellator::with_pipeline_cache`] adds a pipeline cache of wgpu's.
    ///
    /// wgpu cannot make pipelines in the background. If a frame must not wait, build stages on
    /// another thread: a stage, its builder and a tessellator are `Send`.
    pub const fn tessellator(mut self, shared: &'a Tessellator) -> Self {
        self.tessellator = Some(shared);
        self
    }

    /// Draws the output of another stage with this stage's WGSL and state: a further material, a
    /// shadow map, a prepass. Prepare the other stage once for all that draw its output. This one
    /// has no compute passes and needs no `hull`. Unless points are evaluated, its draws call its
    /// own `domain`.
    ///
    /// Both stages must have the same domain, the same configuration and, if points are evaluated,
    /// the same `struct Vertex` except for names. Factors, points, order, room, groups and the most
    /// patches are those of the other stage; what this builder got for them is ignored.
    pub const fn output_of(mut self, other: &'a TessellationStage) -> Self {
        self.output_of = Some(other);
        self
    }

    /// Sets a function of the WGSL, `fn name(vertex: Vertex) -> Vertex`, that every draw calls for
    /// each vertex that `domain` returned. Put there what differs from pass to pass, such as the
    /// camera.
    ///
    /// With [`Points::Evaluated`], `domain` runs once for each point, and the draws call only this
    /// function. Otherwise the vertex shader calls it after `domain`.
    pub const fn project(mut self, function: &'a str) -> Self {
        self.render.project = Some(function);
        self
    }

    /// Draws into all layers of the targets whose bits are set in `mask`, at once. It needs wgpu's
    /// feature `MULTIVIEW`. In WGSL, `tess_view()` returns the layer's number.
    pub const fn views(mut self, mask: NonZeroU32) -> Self {
        self.render.views = Some(mask);
        self
    }

    /// Sets the values of constants that the WGSL declares with `override`, by name.
    pub const fn constants(mut self, values: &'a [(&'a str, f64)]) -> Self {
        self.constants = values;
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

    /// Adds the next colour target of the render passes that draw the stage. A stage without
    /// targets has no fragment shader.
    pub fn target(mut self, target: impl Into<wgpu::ColorTargetState>) -> Self {
        self.render.targets.push(Some(target.into()));
        self
    }

    /// Chooses the fragment shader by name, which is needed if the user's WGSL has several.
    pub const fn fragment(mut self, entry_point: &'a str) -> Self {
        self.render.fragment = Some(entry_point);
        self
    }

    /// Sets depth and stencil; by default there are none.
    pub fn depth(mut self, depth: wgpu::DepthStencilState) -> Self {
        self.render.depth = Some(depth);
        self
    }

    /// Sets multisampling; the default is one sample.
    pub const fn multisample(mut self, multisample: wgpu::MultisampleState) -> Self {
        self.render.multisample = multisample;
        self
    }

    /// Sets culling, front face and polygon mode. The topology is ignored: the configuration's
    /// output decides it.
    pub const fn primitive(mut self, primitive: wgpu::PrimitiveState) -> Self {
        self.render.primitive = primitive;
        self
    }

    /// Leaves the render pipelines to an engine that makes its own from [`Self::vertex_shader`] and
    /// its own fragment shaders: for a shadow map, a depth prepass, several cameras. The engine
    /// draws with [`TessellationStage::draw`](super::TessellationStage::draw) or
    /// [`TessellationStage::indirect`](super::TessellationStage::indirect).
    ///
    /// The stage then ignores the render state, and only its compute passes use the bind groups.
    /// Points must be [`Points::Stored`] or [`Points::Evaluated`].
    pub const fn without_pipeline(mut self) -> Self {
        self.makes_pipeline = false;
        self
    }

    /// The WGSL of the vertex shader, for an engine that makes the render pipeline: the user's
    /// text, unchanged, and then the stage's. The entry point is `tess_vertex`. It takes one vertex
    /// buffer of [`Self::vertex_layout`]. If points are pulled, or if the WGSL calls
    /// `tess_factors`, only the stage can use the text, because it does not expose the buffers that
    /// the text binds.
    ///
    /// # Errors
    /// [`StageError::Wgsl`] if points are evaluated and a member of `Vertex` cannot be an
    /// attribute.
    pub fn vertex_shader(&self) -> Result<String, Error> {
        Ok(self.shader(&self.vertex_layout()?).with(self.source))
    }

    /// The layout of the vertex buffer, which holds packed points, or `Vertex` if points are
    /// evaluated.
    ///
    /// # Errors
    /// [`StageError::Wgsl`] if points are evaluated and a member of `Vertex` cannot be an
    /// attribute.
    pub fn vertex_layout(&self) -> Result<VertexLayout, StageError> {
        match self.points {
            Points::Evaluated => VertexLayout::of(&wgsl::declarations(self.source)),
            _ => Ok(VertexLayout::packed()),
        }
    }

    pub(super) fn shader<'b>(&'b self, vertices: &'b VertexLayout) -> VertexShader<'b> {
        let (points, project) = (self.points, self.render.project);
        VertexShader { setup: self.setup(), points, group: self.own_group(), project, vertices }
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

    /// The pipeline constants, keyed by name or, if the constant has the attribute `@id`, by
    /// number.
    pub(super) fn constants_of(&self, declared: &[Declaration<'_>]) -> Vec<(String, u64)> {
        let key = |name: &str| {
            let declared = declared.iter().find(|one| one.name == name);
            declared.and_then(|one| one.attribute("id")).unwrap_or(name).to_owned()
        };
        self.constants.iter().map(|&(name, value)| (key(name), value.to_bits())).collect()
    }

    /// Whether the WGSL reads the frame's factors.
    pub(super) fn has_factors(&self) -> bool {
        source::uses(self.source, "tess_factors")
    }

    /// The number of the stage's own bind group: the one after the user's.
    pub(super) fn own_group(&self) -> u32 {
        u32::try_from(self.layouts.len()).unwrap_or(u32::MAX)
    }
}

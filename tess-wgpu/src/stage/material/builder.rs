//! The builder of a material, with a method for each choice.

use crate::stage::TessellationStage;
use crate::stage::program::Program;
use std::num::NonZeroU32;

/// Makes a [`Material`](super::Material). Every choice has a default; only
/// [`MaterialBuilder::build`] must be called.
#[derive(Clone, Debug)]
#[must_use = "the material is made by `build`"]
pub struct MaterialBuilder<'a> {
    pub(super) stage: &'a TessellationStage,
    pub(super) program: Program<'a>,
    pub(super) render: Render<'a>,
    pub(super) project: Project<'a>,
}

/// What happens to the vertices that `domain` returns.
#[derive(Clone, Copy, Debug)]
pub(super) enum Project<'a> {
    /// They are drawn as they are, because nothing else was asked for.
    Unset,
    /// They are drawn as they are, as the user said.
    Nothing,
    /// This function of the WGSL is called for each.
    Function(&'a str),
}

/// The part of the render pipeline's state that the user sets.
#[derive(Clone, Debug, Default)]
pub(super) struct Render<'a> {
    pub(super) fragment: Option<&'a str>,
    pub(super) targets: Vec<Option<wgpu::ColorTargetState>>,
    pub(super) depth: Option<wgpu::DepthStencilState>,
    pub(super) multisample: wgpu::MultisampleState,
    pub(super) primitive: wgpu::PrimitiveState,
    pub(super) views: Option<NonZeroU32>,
}

impl<'a> MaterialBuilder<'a> {
    pub(in crate::stage) fn new(stage: &'a TessellationStage, source: &'a str) -> Self {
        let (program, render) = (Program::new(source), Render::default());
        Self { stage, program, render, project: Project::Unset }
    }

    /// Adds the user's next bind group of the draws: the first call adds `@group(0)`, the second
    /// `@group(1)`, and so on. A device allows 4 by default, of which draws take one if points are
    /// pulled or if the WGSL calls `tess_factors`, and where it is left for large evaluated
    /// vertices.
    ///
    /// The entries of the layout need the visibility `VERTEX` for the function of
    /// [`Self::project`] and for `domain`, unless points are evaluated, and `FRAGMENT` for the
    /// fragment shader. Set dynamic offsets with
    /// [`set_dynamic_offsets`](super::Material::set_dynamic_offsets).
    pub fn bind_group(mut self, layout: &wgpu::BindGroupLayout, group: &wgpu::BindGroup) -> Self {
        self.program.bind(layout, group);
        self
    }

    /// Sets the values of constants that the WGSL declares with `override`, by name.
    pub const fn constants(mut self, values: &'a [(&'a str, f64)]) -> Self {
        self.program.constants = values;
        self
    }

    /// Sets a function of the WGSL, `fn name(vertex: Vertex) -> Vertex`, that every draw calls for
    /// each vertex that `domain` returned. Put there what differs from pass to pass, such as the
    /// camera.
    ///
    /// With [`Points::Evaluated`](crate::stage::Points), `domain` runs once for each point, and the
    /// draws call only this function. Otherwise the vertex shader calls it after `domain`.
    pub const fn project(mut self, function: &'a str) -> Self {
        self.project = Project::Function(function);
        self
    }

    /// Draws the vertices where `domain` put them, although other materials of the stage call a
    /// function of [`Self::project`]. Without either call, [`Self::build`] refuses a material that
    /// differs from others in this: it would be drawn in the wrong place.
    pub const fn unprojected(mut self) -> Self {
        self.project = Project::Nothing;
        self
    }

    /// Draws into all layers of the targets whose bits are set in `mask`, at once. It needs wgpu's
    /// feature `MULTIVIEW`. In WGSL, `tess_view()` returns the layer's number.
    pub const fn views(mut self, mask: NonZeroU32) -> Self {
        self.render.views = Some(mask);
        self
    }

    /// Adds the next colour target of the render passes that draw the stage. A
    /// material without targets has no fragment shader.
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
}

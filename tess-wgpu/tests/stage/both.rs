//! A stage with one material, made from one WGSL with one list of bind groups, as most tests need.

use std::ops::{Deref, DerefMut};
use tess_core::{Config, Domain};
use tess_gpu::{Capacity, Order};
use tess_wgpu::stage::{
    Factors, Frame, Material, MaterialBuilder, Overflow, PatchCount, Points, Room, StageBuilder,
};
use tess_wgpu::{Error, TessellationStage, Tessellator};

/// A stage, its material and the last frame. It can be used as the stage.
#[derive(Debug)]
pub(crate) struct Both {
    stage: TessellationStage,
    pub(crate) material: Material,
    pub(crate) frame: Option<Frame>,
}

/// The builders of a stage and of its material.
#[derive(Clone)]
pub(crate) struct Builder<'a> {
    source: &'a str,
    stage: StageBuilder<'a>,
    groups: Vec<(wgpu::BindGroupLayout, wgpu::BindGroup)>,
    constants: &'a [(&'a str, f64)],
    project: Option<&'a str>,
    fragment: Option<&'a str>,
    target: Option<wgpu::ColorTargetState>,
    depth: Option<wgpu::DepthStencilState>,
    primitive: wgpu::PrimitiveState,
    views: Option<std::num::NonZeroU32>,
}

/// Methods that pass a choice on to the stage's builder.
macro_rules! of_stage {
    ($($name:ident: $kind:ty),*) => {
        $(pub(crate) fn $name(mut self, value: $kind) -> Self {
            self.stage = self.stage.$name(value);
            self
        })*
    };
}

/// Methods that keep a choice for the material's builder.
macro_rules! of_material {
    ($($name:ident: $kind:ty),*) => {
        $(pub(crate) fn $name(mut self, value: $kind) -> Self {
            self.$name = Some(value);
            self
        })*
    };
}

#[allow(dead_code, reason = "the tests of OpenGL use few of them")]
impl<'a> Builder<'a> {
    pub(crate) fn new(source: &'a str, domain: Domain, config: Config, patches: u32) -> Self {
        Self {
            source,
            stage: TessellationStage::builder(source, domain, config, patches),
            groups: Vec::new(),
            constants: &[],
            project: None,
            fragment: None,
            target: None,
            depth: None,
            primitive: wgpu::PrimitiveState::default(),
            views: None,
        }
    }

    of_stage! {
        factors: Factors<'a>, points: Points, order: Order, room: Room, first_room: Capacity,
        overflow: Overflow, groups: &[u32], tessellator: &'a Tessellator
    }

    of_material! { project: &'a str, fragment: &'a str, views: std::num::NonZeroU32 }

    pub(crate) fn bind_group(
        mut self,
        layout: &wgpu::BindGroupLayout,
        group: &wgpu::BindGroup,
    ) -> Self {
        self.groups.push((layout.clone(), group.clone()));
        self.stage = self.stage.bind_group(layout, group);
        self
    }

    pub(crate) fn constants(mut self, values: &'a [(&'a str, f64)]) -> Self {
        self.constants = values;
        self.stage = self.stage.constants(values);
        self
    }

    pub(crate) fn target(mut self, target: impl Into<wgpu::ColorTargetState>) -> Self {
        self.target = Some(target.into());
        self
    }

    pub(crate) fn depth(mut self, depth: wgpu::DepthStencilState) -> Self {
        self.depth = Some(depth);
        self
    }

    pub(crate) fn primitive(mut self, primitive: wgpu::PrimitiveState) -> Self {
        self.primitive = primitive;
        self
    }

    /// The stage's builder.
    pub(crate) fn of_stage(&self) -> StageBuilder<'a> {
        self.stage.clone()
    }

    /// The material's builder for this stage.
    pub(crate) fn of_material<'b>(&'b self, stage: &'b TessellationStage) -> MaterialBuilder<'b>
    where
        'a: 'b,
    {
        let mut material = stage.material(self.source).constants(self.constants);
        for (layout, group) in &self.groups {
            material = material.bind_group(layout, group);
        }
        material = material.primitive(self.primitive);
        material = self.project.into_iter().fold(material, MaterialBuilder::project);
        material = self.fragment.into_iter().fold(material, MaterialBuilder::fragment);
        material = self.target.clone().into_iter().fold(material, MaterialBuilder::target);
        material = self.depth.clone().into_iter().fold(material, MaterialBuilder::depth);
        self.views.into_iter().fold(material, MaterialBuilder::views)
    }

    pub(crate) fn build(self, device: &wgpu::Device) -> Result<Both, Error> {
        let stage = self.stage.clone().build(device)?;
        let material = self.of_material(&stage).build()?;
        Ok(Both { stage, material, frame: None })
    }

    pub(crate) async fn build_async(self, device: &wgpu::Device) -> Result<Both, Error> {
        let stage = self.stage.clone().build_async(device).await?;
        let material = self.of_material(&stage).build_async().await?;
        Ok(Both { stage, material, frame: None })
    }
}

#[allow(dead_code, reason = "the tests of OpenGL use few of them")]
impl Both {
    /// Prepares a frame, and keeps it.
    pub(crate) fn prepare<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<(), Error> {
        self.frame = Some(self.stage.prepare(encoder, patches)?);
        Ok(())
    }

    /// The last prepared frame.
    pub(crate) fn frame(&self) -> &Frame {
        self.frame.as_ref().expect("one is prepared")
    }

    /// Draws the last prepared frame with the material.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.material.draw(pass, self.frame()).expect("it is the stage's last frame");
    }

    pub(crate) fn draw_group(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        group: u32,
    ) -> Result<(), Error> {
        self.material.draw_group(pass, self.frame(), group)
    }

    /// Replaces a bind group of both.
    pub(crate) fn set_bind_group(
        &mut self,
        number: u32,
        group: &wgpu::BindGroup,
    ) -> Result<(), Error> {
        self.stage.set_bind_group(number, group)?;
        self.material.set_bind_group(number, group)
    }

    pub(crate) fn set_dynamic_offsets(&mut self, number: u32, all: &[u32]) -> Result<(), Error> {
        self.stage.set_dynamic_offsets(number, all)?;
        self.material.set_dynamic_offsets(number, all)
    }
}

impl Deref for Both {
    type Target = TessellationStage;

    fn deref(&self) -> &TessellationStage {
        &self.stage
    }
}

impl DerefMut for Both {
    fn deref_mut(&mut self) -> &mut TessellationStage {
        &mut self.stage
    }
}

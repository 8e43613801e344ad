//! The teapot in the tessellation stage.

use crate::app::{self, Args, Frame, Show};
use crate::bindings::{Bound, bind};
use crate::teapot;
use std::error::Error;
use tess_gpu::surfaces;
use tess_wgpu::stage::{self, Material};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// The user's WGSL: the formulas of a surface, and the functions that call them.
fn wgsl() -> String {
    let stage = include_str!("stage.wgsl");
    [surfaces::BEZIER, surfaces::BEZIER_FACTORS, &teapot::source()[surfaces::BEZIER.len()..], stage]
        .join("\n")
}

/// The teapot.
pub(crate) struct Teapot {
    stage: TessellationStage,
    material: Material,
    /// The frame to draw.
    shown: Option<stage::Frame>,
}

impl Show for Teapot {
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, _: &Args) -> Result<Self, Box<dyn Error>> {
        let nets = teapot::nets();
        let nets = gpu.upload("nets", bytemuck::cast_slice(&nets), Usage::STORAGE)?;
        let (layout, group) = bind(gpu, &[Bound::Read(&nets)]);
        let setup = teapot::setup();
        let wgsl = wgsl();
        let builder =
            TessellationStage::builder(&wgsl, setup.domain, setup.config, teapot::PATCHES);
        let stage = builder.bind_group(&layout, &group).build(&gpu.device)?;
        let material = stage
            .material(&wgsl)
            .bind_group(&layout, &group)
            .target(format)
            .fragment("shade")
            .depth(app::depth())
            .build()?;
        Ok(Self { stage, material, shown: None })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        self.shown = Some(self.stage.prepare(frame.encoder, teapot::PATCHES)?);
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        self.shown.as_ref().map_or(Ok(()), |frame| self.material.draw(pass, frame))
    }

    fn title(&self) -> String {
        let drawn = self.stage.feedback().map_or(0, |feedback| feedback.drawn);
        format!("teapot: {drawn} triangles")
    }
}

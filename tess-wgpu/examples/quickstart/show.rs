//! A sea in the tessellation stage.

use crate::app::{self, Args, Frame, Show};
use crate::bindings::{Bound, bind};
use crate::camera::Camera;
use glam::Vec3;
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::stage::{self, Material};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

const PATCHES: u32 = 16 * 16;

/// The sea.
pub(crate) struct Quickstart {
    stage: TessellationStage,
    material: Material,
    /// The frame to draw.
    shown: Option<stage::Frame>,
    frame: wgpu::Buffer,
}

impl Show for Quickstart {
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, _: &Args) -> Result<Self, Box<dyn Error>> {
        let frame = gpu.buffer("frame", 96, Usage::UNIFORM | Usage::COPY_DST)?;
        let (layout, group) = bind(gpu, &[Bound::Uniform(&frame)]);
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let wgsl = include_str!("sea.wgsl");
        let stage = TessellationStage::builder(wgsl, Domain::Quad, config, PATCHES)
            .bind_group(&layout, &group)
            .build(&gpu.device)?;
        let material = stage
            .material(wgsl)
            .bind_group(&layout, &group)
            .target(format)
            .depth(app::depth())
            .build()?;
        Ok(Self { stage, material, shown: None, frame })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        let (eye, target) = (Vec3::new(8.0, -3.0, 2.5), Vec3::new(8.0, 4.0, 0.0));
        let camera = Camera { eye, target, up: Vec3::Z, zoom: 1.6 };
        let [width, height] = frame.size.map(|size| size as f32);
        let mut words = camera.clip_from_world(width / height).to_cols_array().to_vec();
        words.extend(eye.extend(frame.seconds).to_array());
        words.extend([0.5 * height * camera.zoom, 0.0, 0.0, 0.0]);
        frame.gpu.queue.write_buffer(&self.frame, 0, bytemuck::cast_slice(&words));
        self.shown = Some(self.stage.prepare(frame.encoder, PATCHES)?);
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        self.shown.as_ref().map_or(Ok(()), |frame| self.material.draw(pass, frame))
    }

    fn title(&self) -> String {
        let drawn = self.stage.feedback().map_or(0, |feedback| feedback.drawn);
        format!("quickstart: {drawn} triangles")
    }
}

//! A toy animal of PN triangles in the tessellation stage.

use crate::app::{self, Args, Frame, Show};
use crate::bindings::{Bound, bind};
use crate::camera::Camera;
use crate::gltf;
use glam::Vec3;
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::surfaces;
use tess_wgpu::stage::{self, Material};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// The animal.
pub(crate) struct Character {
    stage: TessellationStage,
    material: Material,
    /// The frame to draw.
    shown: Option<stage::Frame>,
    frame: wgpu::Buffer,
    triangles: u32,
}

impl Show for Character {
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>> {
        let text = match args.text("model") {
            Some(path) => std::fs::read_to_string(path)?,
            None => gltf::write(&gltf::animal()),
        };
        let mesh = gltf::read(&text)?;
        // Position and normal of each corner, each followed by an unused word.
        let corner =
            |(p, n): (&[f32; 3], &[f32; 3])| [p[0], p[1], p[2], 0.0, n[0], n[1], n[2], 0.0];
        let corners: Vec<_> = mesh.positions.iter().zip(&mesh.normals).map(corner).collect();
        let corners = gpu.upload("corners", bytemuck::cast_slice(&corners), Usage::STORAGE)?;
        let bytes = bytemuck::cast_slice(&mesh.triangles);
        let indices = gpu.upload("triangles", bytes, Usage::STORAGE)?;
        let frame = gpu.buffer("frame", 96, Usage::UNIFORM | Usage::COPY_DST)?;
        let bound = [Bound::Uniform(&frame), Bound::Read(&corners), Bound::Read(&indices)];
        let (layout, group) = bind(gpu, &bound);
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        let own = include_str!("character.wgsl");
        let wgsl =
            [surfaces::BEZIER, surfaces::POINT_NORMAL, surfaces::PN_TRIANGLE, own].join("\n");
        let triangles = u32::try_from(mesh.triangles.len())?;
        let stage = TessellationStage::builder(&wgsl, Domain::Triangle, config, triangles)
            .bind_group(&layout, &group)
            .build(&gpu.device)?;
        let material = stage
            .material(&wgsl)
            .bind_group(&layout, &group)
            .target(format)
            .depth(app::depth())
            .build()?;
        Ok(Self { stage, material, shown: None, frame, triangles })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        let target = Vec3::new(0.5, 0.1, 1.7);
        let angle = 0.6 * frame.seconds - 2.1;
        let eye = target + Vec3::new(5.6 * libm::cosf(angle), 5.6 * libm::sinf(angle), 1.2);
        let camera = Camera { eye, target, up: Vec3::Z, zoom: 2.7 };
        let [width, height] = frame.size.map(|size| size as f32);
        let mut words = camera.clip_from_world(width / height).to_cols_array().to_vec();
        words.extend(eye.extend(0.5 * height * camera.zoom).to_array());
        frame.gpu.queue.write_buffer(&self.frame, 0, bytemuck::cast_slice(&words));
        self.shown = Some(self.stage.prepare(frame.encoder, self.triangles)?);
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        self.shown.as_ref().map_or(Ok(()), |frame| self.material.draw(pass, frame))
    }

    fn title(&self) -> String {
        let drawn = self.stage.feedback().map_or(0, |feedback| feedback.drawn);
        format!("character: {} triangles become {drawn}", self.triangles)
    }
}

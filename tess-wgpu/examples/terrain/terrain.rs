//! A terrain, tessellated with factors by size on the screen.

#[path = "../shared/hills.rs"]
mod hills;

use crate::app::{self, Args, Frame, Show};
use crate::bindings::{Bound, bind};
use crate::camera::Camera;
use glam::Vec3;
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::stage::{self, Material, Points, Room};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// The terrain. Keys: `w` for a wireframe, `+` and `-` for the pixels of a segment, `p` for the
/// source of points.
pub(crate) struct Terrain {
    stage: TessellationStage,
    material: Material,
    /// The frame to draw.
    shown: Option<stage::Frame>,
    frame: wgpu::Buffer,
    bound: (wgpu::BindGroupLayout, wgpu::BindGroup),
    format: wgpu::TextureFormat,
    /// Patches along each side.
    grid: u32,
    most_bytes: u64,
    points: Points,
    wireframe: bool,
    /// The wanted length of a segment in pixels.
    pub(crate) segment: f32,
}

/// Texels along each side of the height map.
const TEXELS: u32 = 512;

impl Show for Terrain {
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>> {
        let frame = gpu.buffer("frame", 96, Usage::UNIFORM | Usage::COPY_DST)?;
        let heights = hills::heights(TEXELS);
        let texels = bytemuck::cast_slice(&heights);
        let heights = app::image(gpu, wgpu::TextureFormat::R32Float, [TEXELS; 2], texels);
        let bound = bind(gpu, &[Bound::Uniform(&frame), Bound::Texture(&heights)]);
        let grid = args.number("grid", 64)?;
        let most_bytes = args.number("bytes", 256 << 20)?;
        let points = points(args.text("points").unwrap_or("stored"))?;
        let points_of = [points_of(points, most_bytes)];
        let (stage, material) = stage(gpu, format, &bound, grid, points_of, false)?;
        let segment = args.number("segment", 8.0)?;
        Ok(Self {
            stage,
            material,
            shown: None,
            frame,
            bound,
            format,
            grid,
            most_bytes,
            points,
            wireframe: false,
            segment,
        })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        let camera = flight(frame.seconds);
        let [width, height] = frame.size.map(|size| size as f32);
        let mut words = camera.clip_from_world(width / height).to_cols_array().to_vec();
        words.extend(camera.eye.extend(0.5 * height * camera.zoom).to_array());
        words.extend([self.segment, f32::from_bits(self.grid), 0.0, 0.0]);
        frame.gpu.queue.write_buffer(&self.frame, 0, bytemuck::cast_slice(&words));
        self.shown = Some(self.stage.prepare(frame.encoder, self.grid * self.grid)?);
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        self.shown.as_ref().map_or(Ok(()), |frame| self.material.draw(pass, frame))
    }

    fn press(&mut self, gpu: &Gpu, key: &str) -> Result<(), Box<dyn Error>> {
        match key {
            "+" => self.segment = (self.segment * 0.8).max(0.25),
            "-" => self.segment = (self.segment * 1.25).min(200.0),
            "w" => self.wireframe = !self.wireframe && can_wireframe(gpu),
            "p" => {
                self.points = match self.points {
                    Points::Stored => Points::Pull,
                    Points::Pull => Points::PullWithoutIndices,
                    Points::PullWithoutIndices => Points::Evaluated,
                    Points::Evaluated => Points::Stored,
                }
            }
            _ => return Ok(()),
        }
        self.remake(gpu)
    }

    fn title(&self) -> String {
        let Self { points, segment, .. } = self;
        let drawn = self.stage.feedback().map_or(0, |feedback| feedback.drawn);
        format!("terrain: {drawn} triangles, {segment:.1} pixels a segment, points: {points:?}")
    }
}

impl Terrain {
    /// The stage, for measurements.
    pub(crate) const fn stage(&self) -> &TessellationStage {
        &self.stage
    }

    fn remake(&mut self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        let points = [points_of(self.points, self.most_bytes)];
        let made = stage(gpu, self.format, &self.bound, self.grid, points, self.wireframe)?;
        (self.stage, self.material, self.shown) = (made.0, made.1, None);
        Ok(())
    }
}

/// The source of points that a word names.
pub(crate) fn points(word: &str) -> Result<Points, String> {
    match word {
        "stored" => Ok(Points::Stored),
        "pull" => Ok(Points::Pull),
        "none" => Ok(Points::PullWithoutIndices),
        "evaluated" => Ok(Points::Evaluated),
        _ => Err(format!("--points {word} is not one of stored, pull, none and evaluated")),
    }
}

fn points_of(points: Points, most_bytes: u64) -> (Points, Room) {
    (points, Room::Automatic { most_bytes })
}

fn can_wireframe(gpu: &Gpu) -> bool {
    gpu.device.features().contains(wgpu::Features::POLYGON_MODE_LINE)
}

fn stage(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    (layout, group): &(wgpu::BindGroupLayout, wgpu::BindGroup),
    grid: u32,
    [(points, room)]: [(Points, Room); 1],
    wireframe: bool,
) -> Result<(TessellationStage, Material), tess_wgpu::Error> {
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let polygon_mode = if wireframe { wgpu::PolygonMode::Line } else { wgpu::PolygonMode::Fill };
    let wgsl = include_str!("terrain.wgsl");
    let stage = TessellationStage::builder(wgsl, Domain::Quad, config, grid * grid)
        .bind_group(layout, group)
        .points(points)
        .room(room)
        .build(&gpu.device)?;
    let material = stage
        .material(wgsl)
        .bind_group(layout, group)
        .target(format)
        .depth(app::depth())
        .primitive(wgpu::PrimitiveState { polygon_mode, ..Default::default() })
        .build()?;
    Ok((stage, material))
}

/// The camera's place after a number of seconds, on a circle over the terrain.
fn flight(seconds: f32) -> Camera {
    let angle = 0.12 * seconds - 2.0;
    let at = |angle: f32, radius: f32, height| {
        Vec3::new(32.0 + radius * libm::cosf(angle), 32.0 + radius * libm::sinf(angle), height)
    };
    Camera {
        eye: at(angle, 24.0, 11.0),
        target: at(angle + 0.9, 16.0, 4.0),
        up: Vec3::Z,
        zoom: 1.5,
    }
}

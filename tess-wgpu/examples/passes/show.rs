//! Hills: tessellated once, evaluated once, and drawn five times.

use crate::app::{self, Args, DEPTH, Frame, Show};
use crate::bindings::{Bound, bind};
use crate::camera::Camera;
use crate::terrain;
use glam::{Mat4, Vec3};
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::stage::{self, Material, MaterialBuilder};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::{BufferUsages as Usage, CompareFunction as Compare};

const PATCHES: u32 = 8 * 8;
/// The width and height of the shadow map in pixels.
const SHADOWS: u32 = 2048;

/// The direction of the sun.
pub(crate) fn toward_sun() -> Vec3 {
    Vec3::new(0.62, -0.45, 0.35).normalize()
}

/// The cameras, for pictures of this aspect ratio (width over height).
pub(crate) fn cameras(aspect: f32) -> [Mat4; 2] {
    let target = Vec3::new(4.0, 4.0, 0.2);
    [Vec3::new(4.0, -6.0, 5.0), Vec3::new(-4.5, 1.0, 4.0)]
        .map(|eye| Camera { eye, target, up: Vec3::Z, zoom: 1.7 }.clip_from_world(aspect))
}

/// The sun's camera, which sees all of the hills.
fn sun() -> Mat4 {
    let away = -toward_sun();
    let right = away.cross(Vec3::Z).normalize();
    let middle = Vec3::new(4.0, 4.0, 0.5);
    let row = |axis: Vec3, far: f32, plus: f32| (axis / far).extend(plus - axis.dot(middle) / far);
    let rows = [row(right, 6.0, 0.0), row(right.cross(away), 6.0, 0.0), row(away, 12.0, 0.5)];
    Mat4::from_rows(rows[0], rows[1], rows[2], glam::Vec4::W)
}

/// The stage, and the materials that draw its frames.
pub(crate) struct Passes {
    stage: TessellationStage,
    shown: Option<stage::Frame>,
    into_shadows: Material,
    /// For the left and the right camera: first only depth, unless `--prepass off`, then colour.
    cameras: [Vec<Material>; 2],
    frame: wgpu::Buffer,
    shadows: wgpu::TextureView,
    size: [u32; 2],
}

impl Show for Passes {
    /// `--prepass off` leaves out the depth-only passes; `--points stored` calls `domain` in each
    /// pass.
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>> {
        let frame = gpu.buffer("frame", 208, Usage::UNIFORM | Usage::COPY_DST)?;
        let (layout, group) = bind(gpu, &[Bound::Uniform(&frame)]);
        let shadows = app::view_of(&app::texture(gpu, DEPTH, [SHADOWS; 2]));
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            compare: Some(Compare::LessEqual),
            ..Default::default()
        });
        let (of_shadows, lit) = bind(gpu, &[Bound::Depth(&shadows), Bound::Comparison(&sampler)]);
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let wgsl = include_str!("hills.wgsl");
        let stage = TessellationStage::builder(wgsl, Domain::Quad, config, PATCHES)
            .bind_group(&layout, &group)
            .points(terrain::points(args.text("points").unwrap_or("evaluated"))?)
            .build(&gpu.device)?;
        let pass = |camera, compare| {
            let pass = stage.material(wgsl).bind_group(&layout, &group);
            pass.project(camera).depth(depth(compare))
        };
        let into_shadows = pass("sun", Compare::Less).build()?;
        let has_prepass = args.text("prepass") != Some("off");
        let cameras = ["left", "right"].map(|camera| {
            let nothing =
                wgpu::ColorTargetState { write_mask: wgpu::ColorWrites::empty(), ..format.into() };
            let prepass = pass(camera, Compare::Less).target(nothing).fragment("nothing");
            let compare = if has_prepass { Compare::Equal } else { Compare::Less };
            let colour = pass(camera, compare).bind_group(&of_shadows, &lit);
            let colour = colour.target(format).fragment("shade");
            let prepass = has_prepass.then_some(prepass);
            let passes = prepass.into_iter().chain([colour]);
            passes.map(MaterialBuilder::build).collect::<Result<Vec<_>, _>>()
        });
        let [left, right] = cameras;
        let cameras = [left?, right?];
        let (shown, size) = (None, [1; 2]);
        Ok(Self { stage, shown, into_shadows, cameras, frame, shadows, size })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        self.size = frame.size;
        let [left, right] = cameras(0.5 * frame.size[0] as f32 / frame.size[1] as f32);
        let mut words: Vec<f32> =
            [left, right, sun()].iter().flat_map(Mat4::to_cols_array).collect();
        words.extend(toward_sun().extend(0.0).to_array());
        frame.gpu.queue.write_buffer(&self.frame, 0, bytemuck::cast_slice(&words));
        // Once for all later passes.
        let shown = self.shown.insert(self.stage.prepare(frame.encoder, PATCHES)?);
        let depth_ops =
            wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store };
        let mut pass = frame.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.shadows,
                depth_ops: Some(depth_ops),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        Ok(self.into_shadows.draw(&mut pass, shown)?)
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        let [width, height] = [self.size[0] / 2, self.size[1]].map(|size| size as f32);
        let Some(shown) = &self.shown else { return Ok(()) };
        for (x, materials) in [0.0, width].into_iter().zip(&self.cameras) {
            pass.set_viewport(x, 0.0, width, height, 0.0, 1.0);
            materials.iter().try_for_each(|material| material.draw(pass, shown))?;
        }
        Ok(())
    }

    fn title(&self) -> String {
        "passes: a shadow map, two cameras".to_owned()
    }
}

fn depth(compare: Compare) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        depth_write_enabled: Some(compare != Compare::Equal),
        depth_compare: Some(compare),
        ..app::depth()
    }
}

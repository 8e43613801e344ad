//! Hills, and the place of them that a pixel shows, which is found on the device and read back.

use crate::app::{self, Args, Frame, Show};
use crate::bindings::{Bound, bind};
use crate::camera::Camera;
use glam::{Mat4, Vec2, Vec3};
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::stage::{self, Material, Points};
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

const PATCHES: u32 = 8 * 8;
const WGSL: &str = include_str!("hills.wgsl");
/// The number of triangles of the hills: 64 patches of factor 16.
const TRIANGLES: u32 = 64 * 512;

/// As `Picked` of hills.wgsl.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Picked {
    pub(crate) distance: f32,
    pub(crate) triangle: u32,
    reserved: [u32; 2],
    pub(crate) corners: [Vertex; 3],
}

/// As `Vertex` of hills.wgsl.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Vertex {
    position: [f32; 4],
    pub(crate) world: [f32; 3],
    pub(crate) number: u32,
}

/// Bytes of a [`Picked`].
const PICKED_BYTES: u64 = size_of::<Picked>() as u64;

/// The camera.
pub(crate) fn camera() -> Camera {
    let (eye, target) = (Vec3::new(4.0, -6.0, 5.0), Vec3::new(4.0, 4.0, 0.2));
    Camera { eye, target, up: Vec3::Z, zoom: 2.2 }
}

/// The direction from the eye through a place of the picture. Places run from (0, 0) at the upper
/// left to (1, 1).
pub(crate) fn direction(camera: &Camera, at: Vec2, aspect: f32) -> Vec3 {
    let forward = (camera.target - camera.eye).normalize_or(Vec3::Z);
    let right = forward.cross(camera.up).normalize_or(Vec3::X);
    let [x, y] = [(2.0 * at.x - 1.0) * aspect, 1.0 - 2.0 * at.y];
    (forward + (right * x + right.cross(forward) * y) / camera.zoom).normalize_or(Vec3::Z)
}

/// The stage, and the passes that find the triangle.
pub(crate) struct Pick {
    stage: TessellationStage,
    material: Material,
    /// The frame to draw.
    shown: Option<stage::Frame>,
    frame: wgpu::Buffer,
    picked: wgpu::Buffer,
    passes: [wgpu::ComputePipeline; 3],
    at: Vec2,
}

impl Show for Pick {
    /// `--x` and `--y` are the place in the picture, from 0 to 1.
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>> {
        let frame = gpu.buffer("frame", 96, Usage::UNIFORM | Usage::COPY_DST)?;
        let usage = Usage::STORAGE | Usage::COPY_DST | Usage::COPY_SRC;
        let picked = gpu.buffer("picked", PICKED_BYTES, usage)?;
        let (layout, group) = bind(gpu, &[Bound::Uniform(&frame)]);
        let (of_picked, shown) = bind(gpu, &[Bound::Read(&picked)]);
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let stage = TessellationStage::builder(WGSL, Domain::Quad, config, PATCHES)
            .bind_group(&layout, &group)
            .points(Points::Evaluated)
            .build(&gpu.device)?;
        let material = stage
            .material(WGSL)
            .bind_group(&layout, &group)
            .bind_group(&of_picked, &shown)
            .project("seen")
            .target(format)
            .depth(app::depth())
            .build()?;
        let at = Vec2::new(args.number("x", 0.36)?, args.number("y", 0.55)?);
        Ok(Self { stage, material, shown: None, frame, picked, passes: passes(gpu), at })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        let aspect = frame.size[0] as f32 / frame.size[1] as f32;
        let camera = camera();
        let mut words = Mat4::to_cols_array(&camera.clip_from_world(aspect)).to_vec();
        words.extend(camera.eye.extend(1.0).to_array());
        words.extend(direction(&camera, self.at, aspect).extend(0.0).to_array());
        frame.gpu.queue.write_buffer(&self.frame, 0, bytemuck::cast_slice(&words));
        // Nothing has been hit yet.
        frame.gpu.queue.write_buffer(&self.picked, 0, &[0xff; 8]);
        self.shown = Some(self.stage.prepare(frame.encoder, PATCHES)?);
        self.find(frame.gpu, frame.encoder)
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        self.shown.as_ref().map_or(Ok(()), |frame| self.material.draw(pass, frame))
    }

    fn check(&self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        match self.picked(gpu)? {
            None => println!("the ray hits nothing"),
            Some(Picked { triangle, corners, .. }) => {
                let [a, b, c] = corners.map(|corner| corner.world);
                println!("triangle {triangle}, patch {}: {a:?} {b:?} {c:?}", corners[0].number);
            }
        }
        Ok(())
    }

    fn title(&self) -> String {
        "pick: the place that a pixel shows".to_owned()
    }
}

impl Pick {
    /// Records the passes over the stage's vertices and indices. They are bound in each frame,
    /// because a later frame may have other buffers.
    fn find(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> Result<(), Box<dyn Error>> {
        let vertices = self.stage.vertices().ok_or("vertices are stored")?;
        let indices = self.stage.indices().ok_or("indices are stored")?;
        let draw = self.stage.indirect();
        let bound = [&self.frame, &vertices, &indices, &draw, &self.picked];
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        for (pipeline, workgroups) in self.passes.iter().zip([TRIANGLES / 64, TRIANGLES / 64, 1]) {
            let layout = pipeline.get_bind_group_layout(0);
            let group = crate::bindings::group(&gpu.device, &layout, crate::bindings::whole(bound));
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(workgroups, 1, 1);
        }
        Ok(())
    }

    /// The found triangle, after the frame has run.
    pub(crate) fn picked(&self, gpu: &Gpu) -> Result<Option<Picked>, tess_wgpu::Error> {
        let bytes = gpu.read(&self.picked, PICKED_BYTES)?;
        let picked: Picked = bytemuck::pod_read_unaligned(&bytes);
        Ok((picked.triangle != u32::MAX).then_some(picked))
    }
}

/// The entry points of pick.wgsl, in order. All bind the same five buffers.
fn passes(gpu: &Gpu) -> [wgpu::ComputePipeline; 3] {
    // The structs of hills.wgsl, which its bindings follow.
    let structs = WGSL.split("@group").next().unwrap_or_default();
    let text = structs.to_owned() + include_str!("pick.wgsl");
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("pick"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let buffer =
        |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let read = buffer(wgpu::BufferBindingType::Storage { read_only: true });
    let written = buffer(wgpu::BufferBindingType::Storage { read_only: false });
    let types = [buffer(wgpu::BufferBindingType::Uniform), read, read, read, written];
    let layout = crate::bindings::layout(&gpu.device, wgpu::ShaderStages::COMPUTE, types);
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("pick"),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    ["find", "take", "copy_corners"].map(|entry_point| {
        gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: Some(&layout),
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: Default::default(),
            cache: None,
        })
    })
}

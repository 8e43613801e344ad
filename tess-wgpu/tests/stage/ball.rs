//! A ball of quads in the stage: its mesh, its frames, and the position of each point.

use crate::bindings::{Bound, bind};
use crate::camera::Camera;
use crate::common::objects::{compute, dispatch, group, image, layout, storage, whole};
use glam::Vec3;
use std::collections::BTreeMap;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::layout::{PackedPoint, Status};
use tess_wgpu::stage::Room;
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// Quads along an edge of the cube that the ball is made of.
const CELLS: i16 = 2;
/// The number of quads.
pub(crate) const QUADS: u32 = 6 * (CELLS as u32) * (CELLS as u32);

/// A vertex of a frame: its place in clip space and in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    pub(crate) uv: [u32; 2],
    pub(crate) clip: [f32; 4],
    pub(crate) world: [f32; 4],
}

/// A frame's values for the shaders: `View` of ball.wgsl.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct View {
    pub(crate) clip_from_world: [[f32; 4]; 4],
    pub(crate) eye: [f32; 4],
    pub(crate) rule: u32,
    pub(crate) culls: u32,
    pub(crate) displacement: f32,
    pub(crate) reserved: u32,
}

impl View {
    /// Frame `frame` of a flight around the ball.
    pub(crate) fn flight(frame: u16, culls: bool) -> Self {
        let t = f32::from(frame);
        let away = 1.3 + 0.04 * f32::from(frame % 60);
        let direction = Vec3::new(libm::cosf(0.13 * t), libm::sinf(0.17 * t), 0.3 * libm::sinf(t));
        let eye = direction.normalize_or(Vec3::X) * away;
        let target = Vec3::new(0.2 * libm::sinf(0.7 * t), 0.1, 0.0);
        let clip = Camera { eye, target, up: Vec3::Z, zoom: 2.0 }.clip_from_world(1.0);
        Self {
            clip_from_world: clip.to_cols_array_2d(),
            eye: eye.extend(1.0).to_array(),
            rule: u32::from(frame % 3),
            culls: culls.into(),
            displacement: 0.15,
            reserved: 0,
        }
    }
}

/// The stage with the ball's buffers.
#[derive(Debug)]
pub(crate) struct Ball {
    pub(crate) gpu: Gpu,
    pub(crate) quads: Vec<[u32; 4]>,
    stage: TessellationStage,
    group: wgpu::BindGroup,
    view: wgpu::Buffer,
    evaluate: wgpu::ComputePipeline,
}

/// The corners of all quads, and the four of each quad, which begin at any of them and run in
/// either direction.
fn mesh() -> (Vec<[f32; 4]>, Vec<[u32; 4]>) {
    let mut numbers: BTreeMap<[i16; 3], u32> = BTreeMap::new();
    let mut corners = Vec::new();
    let mut quads: Vec<[u32; 4]> = Vec::new();
    for face in 0..6 {
        let (axis, side) = (face % 3, if face < 3 { -CELLS } else { CELLS });
        for cell in 0..CELLS * CELLS {
            let [i, j] = [2 * (cell % CELLS) - CELLS, 2 * (cell / CELLS) - CELLS];
            let mut quad = [[i, j], [i + 2, j], [i + 2, j + 2], [i, j + 2]].map(|[a, b]| {
                let mut at = [side; 3];
                at[(axis + 1) % 3] = a;
                at[(axis + 2) % 3] = b;
                *numbers.entry(at).or_insert_with(|| {
                    // No coordinate is a short binary number, because these hide differences of
                    // rounding.
                    let [x, y, z] = at.map(|c| 0.731_234_5 * f32::from(c));
                    corners.push([x, y, z, 0.0]);
                    u32::try_from(corners.len() - 1).expect("few corners")
                })
            });
            if quads.len() % 5 == 2 {
                quad.reverse();
            }
            quad.rotate_left(quads.len() % 4);
            quads.push(quad);
        }
    }
    (corners, quads)
}

impl Ball {
    /// The stage with this edit of the user's WGSL.
    pub(crate) fn new(edit: impl Fn(&str) -> String) -> Self {
        let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
        let (corners, quads) = mesh();
        let upload = |bytes: &[u8], usage| gpu.upload("ball", bytes, usage).expect("there is room");
        let view =
            upload(bytemuck::bytes_of(&View::flight(0, false)), Usage::UNIFORM | Usage::COPY_DST);
        let quad_buffer = upload(bytemuck::cast_slice(&quads), Usage::STORAGE);
        let corner_buffer = upload(bytemuck::cast_slice(&corners), Usage::STORAGE);
        // Heights that all differ.
        let texels: Vec<u8> = (0..=255_u8).map(|k| k.wrapping_mul(89) ^ (k >> 3)).collect();
        let heights = image(&gpu, wgpu::TextureFormat::R8Unorm, [16, 16], &texels);
        let source = edit(include_str!("ball.wgsl"));
        let read = [Bound::Read(&quad_buffer), Bound::Read(&corner_buffer)];
        let all = [Bound::Uniform(&view), read[0], read[1], Bound::Texture(&heights)];
        let (users, group) = bind(&gpu, &all);
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        let stage = TessellationStage::builder(&source, Domain::Quad, config, QUADS)
            .bind_group(&users, &group)
            .room(Room::WorstCase)
            .build(&gpu.device)
            .unwrap_or_else(|error| panic!("{error}"));
        let joined = TessellationStage::joined(&source, include_str!("positions.wgsl"));
        let own = [true, false, true].map(storage);
        let own = layout(&gpu.device, wgpu::ShaderStages::COMPUTE, own);
        let evaluate = compute(&gpu.device, joined, "evaluate", &[&users, &own]);
        Self { gpu, quads, stage, group, view, evaluate }
    }

    /// The points of each quad in a frame.
    pub(crate) fn frame(&mut self, view: View) -> Vec<Vec<Placed>> {
        self.gpu.queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&view));
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.stage.prepare(&mut encoder, QUADS).expect("it is prepared");
        self.gpu.run(encoder).expect("the device finishes");
        let (batch, [points, _]) = self.stage.inside();
        let points = points.expect("they are stored");
        let status: Status =
            bytemuck::pod_read_unaligned(&self.gpu.read(batch.status(), 32).expect("it answers"));
        let count = u32::try_from(status.points()).expect("few points");
        let usage = Usage::STORAGE | Usage::COPY_SRC;
        let size = u64::from(count);
        let placed = self.gpu.buffer("placed", 32 * size, usage).expect("there is room");
        let layout = self.evaluate.get_bind_group_layout(1);
        let own = group(&self.gpu.device, &layout, whole([&points, &placed, batch.status()]));
        let groups = [&self.group, &own];
        let workgroups = count.div_ceil(64);
        dispatch(&self.gpu, &self.evaluate, &groups, workgroups).expect("the device finishes");
        let points = self.gpu.read(&points, 8 * size).expect("it answers");
        let placed = self.gpu.read(&placed, 32 * size).expect("it answers");
        of_quads(&bytemuck::pod_collect_to_vec(&points), &bytemuck::pod_collect_to_vec(&placed))
    }
}

fn of_quads(points: &[[u32; 2]], placed: &[[[f32; 4]; 2]]) -> Vec<Vec<Placed>> {
    let mut all = vec![Vec::new(); QUADS as usize];
    for (&words, &[clip, world]) in points.iter().zip(placed) {
        let packed = PackedPoint(words);
        let point = packed.point();
        let uv = [point.u.to_bits(), point.v.to_bits()];
        all[packed.patch() as usize].push(Placed { uv, clip, world });
    }
    all
}

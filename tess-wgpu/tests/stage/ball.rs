//! A ball of quads in the stage: its mesh, its frames, and the position of each point.

use crate::camera::Camera;
use glam::Vec3;
use std::collections::BTreeMap;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::layout::{PackedPoint, Status};
use tess_wgpu::stage::Room;
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// Quads along an edge of the cube that the ball is made of.
const CELLS: i16 = 2;
/// The quads.
pub(crate) const QUADS: u32 = 6 * (CELLS as u32) * (CELLS as u32);

/// A vertex of a frame: where it is in clip space and in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    pub(crate) uv: [u32; 2],
    pub(crate) clip: [f32; 4],
    pub(crate) world: [f32; 4],
}

/// A frame's values for the shaders, as `View` of ball.wgsl.
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

/// The corners of all quads, and each quad's, beginning anywhere and in both directions.
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
                    // No coordinate is a short binary number: such ones hide what rounds differently.
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
    /// With the user's WGSL changed like this.
    pub(crate) fn new(edit: impl Fn(&str) -> String) -> Self {
        let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
        let (corners, quads) = mesh();
        let upload = |bytes: &[u8], usage| gpu.upload("ball", bytes, usage).expect("there is room");
        let view =
            upload(bytemuck::bytes_of(&View::flight(0, false)), Usage::UNIFORM | Usage::COPY_DST);
        let quad_buffer = upload(bytemuck::cast_slice(&quads), Usage::STORAGE);
        let corner_buffer = upload(bytemuck::cast_slice(&corners), Usage::STORAGE);
        let heights = heights(&gpu).create_view(&Default::default());
        let source = edit(include_str!("ball.wgsl"));
        let (layout, group) = bind(&gpu, [&view, &quad_buffer, &corner_buffer], &heights);
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        let stage = TessellationStage::builder(&source, Domain::Quad, config, QUADS)
            .bind_group(&layout, &group)
            .target(wgpu::TextureFormat::Rgba8Unorm)
            .room(Room::WorstCase)
            .build(&gpu.device)
            .unwrap_or_else(|error| panic!("{error}"));
        let joined = TessellationStage::joined(&source, include_str!("positions.wgsl"));
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("positions"),
            source: wgpu::ShaderSource::Wgsl(joined.into()),
        });
        let evaluate = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("positions"),
            layout: Some(&pipeline_layout(&gpu, &layout)),
            module: &module,
            entry_point: Some("evaluate"),
            compilation_options: Default::default(),
            cache: None,
        });
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
        let buffers = [points, &placed, batch.status()];
        let entries = [0, 1, 2].map(|binding: u32| wgpu::BindGroupEntry {
            binding,
            resource: buffers[binding as usize].as_entire_binding(),
        });
        let own = self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.evaluate.get_bind_group_layout(1),
            entries: &entries,
        });
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.evaluate);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_bind_group(1, &own, &[]);
        pass.dispatch_workgroups(count.div_ceil(64), 1, 1);
        drop(pass);
        self.gpu.run(encoder).expect("the device finishes");
        let points = self.gpu.read(points, 8 * size).expect("it answers");
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

/// A texture of 16 x 16 unlike heights.
fn heights(gpu: &Gpu) -> wgpu::Texture {
    let size = wgpu::Extent3d { width: 16, height: 16, depth_or_array_layers: 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("heights"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::R8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let texels: Vec<u8> = (0..=255_u8).map(|k| k.wrapping_mul(89) ^ (k >> 3)).collect();
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(16), rows_per_image: None };
    gpu.queue.write_texture(texture.as_image_copy(), &texels, layout, size);
    texture
}

const BOTH: wgpu::ShaderStages = wgpu::ShaderStages::COMPUTE.union(wgpu::ShaderStages::VERTEX);

fn bind(
    gpu: &Gpu,
    buffers: [&wgpu::Buffer; 3],
    heights: &wgpu::TextureView,
) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let read = wgpu::BufferBindingType::Storage { read_only: true };
    let buffer =
        |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let kinds = [buffer(wgpu::BufferBindingType::Uniform), buffer(read), buffer(read), texture];
    let entries: Vec<_> = (0..)
        .zip(kinds)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: BOTH,
            ty,
            count: None,
        })
        .collect();
    let entries = &entries;
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: None, entries };
    let layout = gpu.device.create_bind_group_layout(&descriptor);
    let resources = buffers.map(|buffer| buffer.as_entire_binding());
    let resources = resources.into_iter().chain([wgpu::BindingResource::TextureView(heights)]);
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
        .collect();
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    });
    (layout, group)
}

/// The ball's bindings in group 0, and points, positions and status in group 1.
fn pipeline_layout(gpu: &Gpu, user: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
    let entries = [true, false, true].map(|read_only| wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    });
    let mut number = 0;
    let entries = entries.map(|entry| {
        number += 1;
        wgpu::BindGroupLayoutEntry { binding: number - 1, ..entry }
    });
    let own = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries,
    });
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(user), Some(&own)],
        immediate_size: 0,
    })
}

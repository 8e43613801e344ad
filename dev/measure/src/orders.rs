//! Times drawing the triangles of quads in several orders, which says what an order could gain.

use crate::Result;
use crate::timing::device_time;
use std::time::Duration;
use tess_core::{
    Config, DomainPoint, OutputPrimitive, Partitioning, Patch, PrimitiveOrigin, QuadFactors,
};
use tess_core::{Order, cache_order::COLUMN};
use tess_gpu::layout::PackedPoint;
use tess_wgpu::{Gpu, Stopwatch, Wanted};

/// Triangles of a draw.
const TRIANGLES: u32 = 8 << 20;
/// How long each order is drawn.
const LONG_ENOUGH: Duration = Duration::from_millis(400);
/// Pixels along a side of the picture: triangles are too small to fill any.
const PICTURE: u32 = 64;
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Patches in a square grid, slightly curved.
const SHADER: &str = "
struct Vertex { @builtin(position) position: vec4<f32> }
override IN_A_ROW: u32;

@vertex
fn vertex(@location(0) words: vec2<u32>) -> Vertex {
    let uv = vec2<f32>(vec2(words.x & 0x1ffffu, (words.x >> 17u) | ((words.y & 3u) << 15u))) / 65536.0;
    let number = words.y >> 2u;
    let cell = vec2<f32>(vec2(number % IN_A_ROW, number / IN_A_ROW));
    let bent = uv + 0.05 * sin(6.2831853 * uv.yx);
    return Vertex(vec4((cell + bent) * (2.0 / f32(IN_A_ROW)) - 1.0, 0.5, 1.0));
}

@fragment
fn fragment(@builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return vec4(select(0.5, 1.0, front));
}
";

/// What the place of a triangle follows from.
struct Triangle {
    number: u32,
    origin: PrimitiveOrigin,
    /// Column and row of its cell, as the patch of an integer factor is a grid.
    cell: [u32; 2],
}

/// An order: its name, and the key by which triangles are sorted.
type Candidate = (String, Box<dyn Fn(&Triangle) -> [u32; 4]>);

/// Prints thousand million triangles a second, for each factor and order.
pub(crate) fn run() -> Result<()> {
    let gpu = pollster::block_on(Gpu::open_with(Wanted::Everything, Stopwatch::FEATURES))?;
    let stopwatch = Stopwatch::new(&gpu)?;
    println!("{}: drawing alone, G triangles/s", gpu.name());
    for factor in [8_u8, 16, 64] {
        let factors = QuadFactors::uniform(f32::from(factor));
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let patch = Patch::new(config, factors);
        for (name, key) in candidates() {
            let indices = sorted(&patch, factor.into(), key.as_ref());
            if name == format!("columns of {COLUMN}") {
                let drawing = patch.tessellate_in(Order::VertexCache).indices;
                assert_eq!(indices, drawing, "the vertex-cache order has columns of {COLUMN}");
            }
            let rate = draw(&gpu, &stopwatch, &patch, &indices)?;
            println!("factor {factor:<3} {name:<18} {rate:>7.3}");
        }
    }
    Ok(())
}

/// The orders that are drawn.
fn candidates() -> Vec<Candidate> {
    let mut all: Vec<Candidate> =
        vec![("specification".into(), Box::new(|triangle| [triangle.number, 0, 0, 0]))];
    for width in [2, 3, 4, 5, 6, 8, 12] {
        all.push((format!("columns of {width}"), Box::new(move |t| in_columns(t, width))));
    }
    for width in [2, 3, 4, 5, 6, 8, 14] {
        let strips = move |t: &Triangle| [t.cell[0] / width, t.cell[1], t.cell[0], t.number];
        all.push((format!("strips of {width}"), Box::new(strips)));
    }
    all
}

/// As `tess_core::cache_order` has it where all factors are equal.
fn in_columns(triangle: &Triangle, width: u32) -> [u32; 4] {
    let (ring, edge, step) = match triangle.origin {
        PrimitiveOrigin::Transition { edge, step } => (1, edge, step),
        PrimitiveOrigin::Ring { ring, edge, step } => (ring, edge, step),
        _ => return [u32::MAX, triangle.number, 0, 0],
    };
    [edge, (step + 2 * ring - 1) / (2 * width), ring, step]
}

/// The indices of a patch, triangles sorted by a key.
fn sorted(patch: &Patch, factor: u32, key: &dyn Fn(&Triangle) -> [u32; 4]) -> Vec<u32> {
    let whole = patch.tessellate();
    let mut triangles: Vec<Triangle> = (0..patch.counts().primitives)
        .filter_map(|number| {
            let corners = &whole.indices[3 * number as usize..][..3];
            let least = |coordinate: fn(&DomainPoint) -> u32| {
                corners.iter().map(|&i| coordinate(&whole.points[i as usize])).min().unwrap_or(0)
            };
            let least = [least(|p| p.u.to_bits()), least(|p| p.v.to_bits())];
            // The middle of the cell that begins there, as locations are rounded.
            let cell = least.map(|bits| ((bits + 32768 / factor) * factor) >> 16);
            Some(Triangle { number, origin: patch.locate_primitive(number)?, cell })
        })
        .collect();
    triangles.sort_by_key(|triangle| key(triangle));
    let corners = |t: Triangle| whole.indices[3 * t.number as usize..][..3].to_vec();
    triangles.into_iter().flat_map(corners).collect()
}

/// Draws copies of a patch with these indices; thousand million triangles a second.
#[expect(clippy::float_arithmetic, reason = "a rate")]
fn draw(gpu: &Gpu, stopwatch: &Stopwatch, patch: &Patch, indices: &[u32]) -> Result<f64> {
    let counts = patch.counts();
    let copies = TRIANGLES / counts.primitives;
    let points: Vec<DomainPoint> = patch.points().collect();
    let packed: Vec<PackedPoint> = (0..copies)
        .flat_map(|copy| points.iter().map(move |&point| PackedPoint::new(point, copy)))
        .collect();
    let all: Vec<u32> = (0..copies)
        .flat_map(|copy| indices.iter().map(move |index| copy * counts.points + index))
        .collect();
    let points = gpu.upload("points", bytemuck::cast_slice(&packed), wgpu::BufferUsages::VERTEX)?;
    let indices = gpu.upload("indices", bytemuck::cast_slice(&all), wgpu::BufferUsages::INDEX)?;
    let pipeline = pipeline(gpu, copies.isqrt() + 1);
    let picture = picture(gpu);
    let microseconds = device_time(gpu, stopwatch, LONG_ENOUGH, |encoder| {
        let mut pass = begin(encoder, &picture);
        pass.set_pipeline(&pipeline);
        pass.set_vertex_buffer(0, points.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..counts.indices * copies, 0, 0..1);
    })?;
    Ok(f64::from(copies * counts.primitives) / microseconds / 1e3)
}

fn picture(gpu: &Gpu) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: wgpu::Extent3d { width: PICTURE, height: PICTURE, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    picture: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: picture,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    })
}

fn pipeline(gpu: &Gpu, in_a_row: u32) -> wgpu::RenderPipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("orders"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let constants = [("IN_A_ROW", f64::from(in_a_row))];
    let compilation_options =
        wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("orders"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: compilation_options.clone(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 8,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Uint32x2],
            })],
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(FORMAT.into())],
        }),
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        multiview_mask: None,
        cache: None,
    })
}

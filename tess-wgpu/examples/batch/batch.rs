//! The picture: factors, tessellation and an indexed indirect draw, recorded into one command
//! buffer; nothing is read back before the pixels are finished.

#[allow(clippy::duplicate_mod, reason = "tests load several examples")]
#[path = "../shared/picture.rs"]
pub(crate) mod picture;

use picture::{Scene, group, whole};
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::Setup;
use tess_wgpu::Gpu;
use wgpu::BufferUsages as Usage;

/// No part of the terrain has this colour.
pub(crate) const BACKGROUND: [u8; 4] = [255, 0, 255, 255];
const MAGENTA: wgpu::Color = wgpu::Color { r: 1.0, g: 0.0, b: 1.0, a: 1.0 };

const FACTORS: &str = include_str!("factors.wgsl");
const DRAW: &str = include_str!("draw.wgsl");
const GRID: u32 = 32;

/// Renders the terrain; `wrong_patch` gets one wrong edge factor. The pixels are RGBA, row by row.
pub(crate) fn render(gpu: &Gpu, wrong_patch: Option<u32>) -> Result<Vec<u8>, Box<dyn Error>> {
    let edges = gpu.buffer("edges", 2 * 4 * u64::from(GRID * (GRID + 1)), Usage::STORAGE)?;
    let factors = gpu.buffer("factors", 24 * u64::from(GRID * GRID), Usage::STORAGE)?;
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let scene = Scene {
        setup: Setup::new(Domain::Quad, config),
        patches: GRID * GRID,
        factors: &factors,
        room: [16 << 20, 48 << 20],
        source: DRAW,
        read: None,
        meshes: &[],
        // The underside is not drawn, so a crack shows the background through it.
        cull: Some(wgpu::Face::Back),
        background: MAGENTA,
    };
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encode_factors(gpu, &mut encoder, [&edges, &factors], wrong_patch);
    picture::render(gpu, encoder, &scene)
}

/// How many pixels show the background.
pub(crate) fn background_pixels(pixels: &[u8]) -> usize {
    pixels.chunks_exact(4).filter(|&pixel| pixel == BACKGROUND).count()
}

fn encode_factors(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    buffers: [&wgpu::Buffer; 2],
    wrong_patch: Option<u32>,
) {
    let wrong = wrong_patch.unwrap_or(u32::MAX);
    let module = picture::module(gpu, &FACTORS.replace("0xffffffffu", &format!("{wrong}u")));
    let measure = (&module, "measure_edges");
    encode_compute(gpu, encoder, measure, &buffers[..1], GRID * (GRID + 1));
    encode_compute(gpu, encoder, (&module, "gather_factors"), &buffers, GRID * GRID);
}

/// Records a compute pass of `threads` threads in workgroups of 64, over `buffers` as bindings
/// 0, 1, ... of group 0.
fn encode_compute(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    (module, entry_point): (&wgpu::ShaderModule, &str),
    buffers: &[&wgpu::Buffer],
    threads: u32,
) {
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry_point),
        layout: None,
        module,
        entry_point: Some(entry_point),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    let layout = pipeline.get_bind_group_layout(0);
    let group = group(&gpu.device, &layout, whole(buffers.iter().copied()));
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(threads.div_ceil(64), 1, 1);
}

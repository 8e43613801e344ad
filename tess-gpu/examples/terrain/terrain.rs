//! The picture: factors, tessellation and an indexed indirect draw, recorded into one command
//! buffer; nothing is read back but the finished pixels.

use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::Setup;
use tess_gpu::runner::{Gpu, Outputs, Tessellator};
use wgpu::BufferUsages as Usage;

/// Pixels across.
pub(crate) const WIDTH: u32 = 960;
/// Pixels down.
pub(crate) const HEIGHT: u32 = 720;
/// No part of the terrain has this colour.
pub(crate) const BACKGROUND: [u8; 4] = [255, 0, 255, 255];

const FACTORS: &str = include_str!("factors.wgsl");
const DRAW: &str = include_str!("draw.wgsl");
const GRID: u32 = 32;
const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Renders the terrain; `wrong_patch` gets one wrong edge factor. The pixels are RGBA, row by row.
pub(crate) fn render(gpu: &Gpu, wrong_patch: Option<u32>) -> Result<Vec<u8>, String> {
    let storage = Usage::STORAGE;
    let edges = gpu.buffer("edges", 2 * 4 * u64::from(GRID * (GRID + 1)), storage);
    let factors = gpu.buffer("factors", 24 * u64::from(GRID * GRID), storage);
    // Room for this picture's output; the status would say if it were too little.
    let points = gpu.buffer("points", 16 << 20, storage | Usage::VERTEX);
    let indices = gpu.buffer("indices", 48 << 20, storage | Usage::INDEX);
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let outputs = Outputs::Buffers { points: &points, indices: &indices };
    let batch = Tessellator::new(&gpu.device)
        .batch(Setup::new(Domain::Quad, config), GRID * GRID, &factors, outputs)
        .map_err(|error| error.to_string())?;
    let color = texture(gpu, COLOR, wgpu::TextureUsages::COPY_SRC);
    let depth = texture(gpu, DEPTH, wgpu::TextureUsages::empty());
    let pixels =
        gpu.buffer("pixels", u64::from(4 * WIDTH * HEIGHT), Usage::COPY_DST | Usage::COPY_SRC);

    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encode_factors(gpu, &mut encoder, [&edges, &factors], wrong_patch);
    batch.encode(&mut encoder);
    {
        let mut pass = begin_render_pass(&mut encoder, &color, &depth);
        pass.set_pipeline(&render_pipeline(gpu));
        pass.set_vertex_buffer(0, points.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed_indirect(batch.draw_arguments(), 0);
    }
    encoder.copy_texture_to_buffer(
        color.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &pixels,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * WIDTH),
                rows_per_image: None,
            },
        },
        color.size(),
    );
    gpu.run(encoder)?;
    gpu.read(&pixels, pixels.size())
}

/// How many pixels show the background.
pub(crate) fn background_pixels(pixels: &[u8]) -> usize {
    pixels.chunks_exact(4).filter(|&pixel| pixel == BACKGROUND).count()
}

fn module(gpu: &Gpu, source: &str) -> wgpu::ShaderModule {
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn encode_factors(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    buffers: [&wgpu::Buffer; 2],
    wrong_patch: Option<u32>,
) {
    let wrong = wrong_patch.unwrap_or(u32::MAX);
    let source = FACTORS.replace("0xffffffffu", &format!("{wrong}u"));
    let module = module(gpu, &source);
    for (entry_point, threads, bindings) in
        [("measure_edges", GRID * (GRID + 1), 1), ("gather_factors", GRID * GRID, 2)]
    {
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .take(bindings)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(entry_point),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(threads.div_ceil(64), 1, 1);
    }
}

fn texture(gpu: &Gpu, format: wgpu::TextureFormat, more: wgpu::TextureUsages) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: WIDTH, height: HEIGHT, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | more,
        view_formats: &[],
    })
}

fn begin_render_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    color: &wgpu::Texture,
    depth: &wgpu::Texture,
) -> wgpu::RenderPass<'a> {
    let color = color.create_view(&wgpu::TextureViewDescriptor::default());
    let depth = depth.create_view(&wgpu::TextureViewDescriptor::default());
    let magenta = wgpu::Color { r: 1.0, g: 0.0, b: 1.0, a: 1.0 };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(magenta),
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Discard,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

fn render_pipeline(gpu: &Gpu) -> wgpu::RenderPipeline {
    let module = module(gpu, DRAW);
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("terrain"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("place_vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 8,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Uint32x2],
            })],
        },
        primitive: wgpu::PrimitiveState {
            // The underside is not drawn, so a crack shows the background through it.
            front_face: wgpu::FrontFace::Ccw,
            cull_mode: Some(wgpu::Face::Back),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(COLOR.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

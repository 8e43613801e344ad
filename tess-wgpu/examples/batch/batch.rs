//! Factors, tessellation and an indexed indirect draw, recorded into one command buffer; nothing is
//! read back.

use crate::app::{Args, Frame, Show};
use crate::bindings::{group, whole};
use crate::scene::{self, Drawn, Scene};
use std::error::Error;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::Setup;
use tess_wgpu::Gpu;
use wgpu::BufferUsages as Usage;

/// No part of the terrain has this colour.
const MAGENTA: wgpu::Color = wgpu::Color { r: 1.0, g: 0.0, b: 1.0, a: 1.0 };

const FACTORS: &str = include_str!("factors.wgsl");
const DRAW: &str = include_str!("draw.wgsl");
const GRID: u32 = 32;

/// The terrain. `--wrong PATCH` gives one patch one wrong edge factor.
pub(crate) struct Batch {
    /// The passes that compute the factors.
    passes: [Compute; 2],
    drawn: Drawn,
}

impl Show for Batch {
    const BACKGROUND: wgpu::Color = MAGENTA;

    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>> {
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
            // The underside is not drawn, so the background shows through a crack.
            cull: Some(wgpu::Face::Back),
        };
        let wrong = args.number("wrong", u32::MAX)?;
        let module = scene::module(gpu, &FACTORS.replace("0xffffffffu", &format!("{wrong}u")));
        let measure = Compute::new(gpu, (&module, "measure_edges"), &[&edges], GRID * (GRID + 1));
        let gather = (&module, "gather_factors");
        let gather = Compute::new(gpu, gather, &[&edges, &factors], GRID * GRID);
        Ok(Self { passes: [measure, gather], drawn: Drawn::new(gpu, format, &scene)? })
    }

    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>> {
        for compute in &self.passes {
            let mut pass =
                frame.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&compute.pipeline);
            pass.set_bind_group(0, &compute.group, &[]);
            pass.dispatch_workgroups(compute.workgroups, 1, 1);
        }
        self.drawn.prepare(frame.encoder);
        Ok(())
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error> {
        self.drawn.draw(pass);
        Ok(())
    }

    fn check(&self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        self.drawn.check(gpu)
    }

    fn title(&self) -> String {
        "batch".to_owned()
    }
}

/// A compute pass.
struct Compute {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    workgroups: u32,
}

impl Compute {
    /// A pass of `threads` threads in workgroups of 64, with `buffers` as bindings 0, 1, ... of
    /// group 0.
    fn new(
        gpu: &Gpu,
        (module, entry_point): (&wgpu::ShaderModule, &str),
        buffers: &[&wgpu::Buffer],
        threads: u32,
    ) -> Self {
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let layout = pipeline.get_bind_group_layout(0);
        let group = group(&gpu.device, &layout, whole(buffers.iter().copied()));
        Self { pipeline, group, workgroups: threads.div_ceil(64) }
    }
}

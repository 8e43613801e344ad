//! The WGSL of docs/porting.md is what the stage takes.

use crate::bindings::{Bound, bind};
use crate::common::objects;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::surfaces;
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// The blocks of WGSL.
fn blocks() -> Vec<&'static str> {
    let text = include_str!("../../../docs/porting.md");
    text.split("```wgsl\n").skip(1).filter_map(|rest| rest.split("```").next()).collect()
}

#[test]
fn the_blocks_of_the_porting_guide_compile() {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let buffer = |usage| gpu.buffer("any", 4096, usage).expect("there is room");
    let [uniform, read] = [Usage::UNIFORM, Usage::STORAGE].map(buffer);
    let usage = wgpu::TextureUsages::TEXTURE_BINDING;
    let texture =
        objects::view_of(&objects::plain(&gpu, wgpu::TextureFormat::R8Unorm, [1, 1], usage));
    let blocks = blocks();
    assert_eq!(blocks.len(), 3, "terrain, PN triangles, GLSL");
    for (number, block) in blocks.into_iter().enumerate() {
        let (domain, third) = match number {
            1 => (Domain::Triangle, Bound::Read(&read)),
            _ => (Domain::Quad, Bound::Texture(&texture)),
        };
        let bound = bind(&gpu, &[Bound::Uniform(&uniform), Bound::Read(&read), third]);
        let build = |wgsl: &str| {
            let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
            TessellationStage::builder(wgsl, domain, config, 10)
                .bind_group(&bound.0, &bound.1)
                .depth(wgpu::DepthStencilState {
                    format: wgpu::TextureFormat::Depth32Float,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(wgpu::CompareFunction::Less),
                    stencil: wgpu::StencilState::default(),
                    bias: wgpu::DepthBiasState::default(),
                })
                .build(&gpu.device)
        };
        let wgsl = [surfaces::BEZIER, surfaces::POINT_NORMAL, block].join("\n");
        build(&wgsl).unwrap_or_else(|error| panic!("block {number}: {error}"));
        let wrong = wgsl.replace("-> Vertex", "-> vec4f");
        assert!(build(&wrong).is_err(), "block {number} with a wrong domain function");
    }
}

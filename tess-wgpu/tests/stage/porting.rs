//! The stage accepts the WGSL of docs/porting.md.

use crate::bindings::{Bound, bind};
use crate::both::Builder;
use crate::common::objects;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, QuadFactors};
use tess_gpu::surfaces;
use tess_wgpu::{Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

/// The blocks of WGSL.
fn blocks() -> Vec<&'static str> {
    let text = include_str!("../../../docs/porting.md");
    text.split("```wgsl\n").skip(1).filter_map(|rest| rest.split("```").next()).collect()
}

#[test]
#[ignore = "slow: every block of a guide"]
fn the_blocks_of_the_porting_guide_compile() {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let buffer = |usage| gpu.buffer("any", 4096, usage).expect("there is room");
    let [uniform, read] = [Usage::UNIFORM, Usage::STORAGE].map(buffer);
    let usage = wgpu::TextureUsages::TEXTURE_BINDING;
    let texture =
        objects::view_of(&objects::plain(&gpu, wgpu::TextureFormat::R8Unorm, [1, 1], usage));
    let blocks = blocks();
    assert_eq!(blocks.len(), 4, "terrain, PN triangles, GLSL, a quadtree");
    for (number, block) in blocks.into_iter().enumerate() {
        let (domain, third) = match number {
            1 => (Domain::Triangle, Bound::Read(&read)),
            _ => (Domain::Quad, Bound::Texture(&texture)),
        };
        let bound = bind(&gpu, &[Bound::Uniform(&uniform), Bound::Read(&read), third]);
        let build = |wgsl: &str| {
            let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
            Builder::new(wgsl, domain, config, 10)
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

/// Two small tiles of the guide's quadtree beside a large one, so far away that all factors are the
/// least ones.
#[test]
fn the_guides_quadtree_is_closed_under_fractional_even() {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let upload = |words: &[u32], usage| {
        gpu.upload("any", bytemuck::cast_slice(words), usage).expect("there is room")
    };
    let (no_one, u0) = (0, 1);
    let tiles = [[0, 0, 2, no_one], [2, 0, 1, u0], [2, 1, 1, u0]].concat();
    let (uniform, tiles) = (upload(&[0; 20], Usage::UNIFORM), upload(&tiles, Usage::STORAGE));
    let usage = wgpu::TextureUsages::TEXTURE_BINDING;
    let heights = objects::plain(&gpu, wgpu::TextureFormat::R8Unorm, [1, 1], usage);
    let heights = objects::view_of(&heights);
    let bound = [Bound::Uniform(&uniform), Bound::Read(&tiles), Bound::Texture(&heights)];
    let (layout, group) = bind(&gpu, &bound);
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let builder = TessellationStage::builder(blocks()[3], Domain::Quad, config, 3);
    let built = builder.bind_group(&layout, &group).build(&gpu.device);
    let mut stage = built.unwrap_or_else(|error| panic!("{error}"));
    stage.make_room(&gpu.queue, 3).expect("the device answers");
    let factors = gpu.read(stage.factors(), 3 * 24).expect("it answers");
    let factors: Vec<f32> = bytemuck::pod_collect_to_vec(&factors);
    // The edge u = 1 of the large tile, and the edges u = 0 of the small ones.
    let [long, short, other] = [factors[2], factors[6], factors[12]];
    assert_eq!([short, other].map(f32::to_bits), [(0.5 * long).to_bits(); 2], "{factors:?}");
    assert!(meets(config.partitioning, long), "factor {long} beside {short}");
}

/// The places of the points on the edge v = 0 of a quad, in 2^-16.
fn edge(partitioning: Partitioning, factor: f32) -> Vec<u32> {
    let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
    let points = Patch::new(config, QuadFactors::uniform(factor)).tessellate().points;
    let on_edge = points.iter().filter(|point| point.v.to_bits() == 0);
    let mut places: Vec<_> = on_edge.map(|point| point.u.to_bits()).collect();
    places.sort_unstable();
    places
}

/// Whether an edge of this factor has the points of two edges of half the length and factor.
fn meets(partitioning: Partitioning, factor: f32) -> bool {
    let short = edge(partitioning, 0.5 * factor);
    let second = short.iter().skip(1).map(|place| 0x8000 + place / 2);
    let both: Vec<_> = short.iter().map(|place| place / 2).chain(second).collect();
    both == edge(partitioning, factor)
}

/// The guide's rule for neighbours of different size.
#[test]
#[ignore = "slow: every block of a guide"]
fn short_edges_have_the_points_of_a_long_one() {
    for factor in [2.0, 4.0, 8.0, 16.0, 32.0, 64.0] {
        for partitioning in [Partitioning::Integer, Partitioning::Pow2] {
            assert!(meets(partitioning, factor), "{partitioning:?} {factor}");
        }
        let is_in_range = factor > 2.0;
        assert_eq!(meets(Partitioning::FractionalEven, factor), is_in_range, "even {factor}");
        assert!(!meets(Partitioning::FractionalOdd, factor), "odd {factor}");
    }
    assert!(!meets(Partitioning::Integer, 6.0), "thirds are rounded");
}

//! Which way triangles turn, as docs/porting.md says.

use crate::drawing::scene;
use crate::model::drawn;
use crate::scene::FORMAT;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::TessellationStage;
use tess_wgpu::stage::Room;
use wgpu::FrontFace;

/// One patch of a domain over the whole picture: u to the right, v upwards or downwards.
fn source(domain: Domain, is_v_up: bool) -> String {
    let (kind, factors) = match domain {
        Domain::Triangle => ("TriFactors", "tess_tri_factors(vec3f(3.0))"),
        _ => ("QuadFactors", "tess_quad_factors(vec4f(3.0))"),
    };
    let y = if is_v_up { "2.0 * uv.y - 1.0" } else { "1.0 - 2.0 * uv.y" };
    format!(
        "struct Vertex {{ @builtin(position) position: vec4f }}\n\
         fn hull(number: u32) -> {kind} {{ return {factors}; }}\n\
         fn domain(number: u32, uv: vec2f) -> Vertex {{\n    \
         return Vertex(vec4f(2.0 * uv.x - 1.0, {y}, 0.5, 1.0));\n}}\n\
         @fragment fn shade() -> @location(0) vec4u {{ return vec4u(0u, 0u, 0u, 1u); }}"
    )
}

#[test]
fn clockwise_triangles_are_counter_clockwise_where_v_points_up() {
    for domain in [Domain::Triangle, Domain::Quad] {
        let scene = scene(domain, Partitioning::FractionalOdd);
        for output in [OutputPrimitive::TriangleCw, OutputPrimitive::TriangleCcw] {
            for is_v_up in [true, false] {
                for front_face in [FrontFace::Ccw, FrontFace::Cw] {
                    let config = Config::new(Partitioning::FractionalOdd, output);
                    let source = source(domain, is_v_up);
                    let mut stage = TessellationStage::builder(&source, domain, config, 1)
                        .target(FORMAT)
                        .room(Room::WorstCase)
                        .primitive(wgpu::PrimitiveState {
                            front_face,
                            cull_mode: Some(wgpu::Face::Back),
                            ..Default::default()
                        })
                        .build(&scene.gpu.device)
                        .unwrap_or_else(|error| panic!("{error}"));
                    let pixels = drawn(&scene.frame(&mut stage, 1.into()).expect("it draws"));
                    let is_clockwise = (output == OutputPrimitive::TriangleCw) != is_v_up;
                    let is_front = is_clockwise == (front_face == FrontFace::Cw);
                    let what = format!("{domain:?}, {output:?}, {front_face:?}, v up: {is_v_up}");
                    assert_eq!(pixels > 10_000, is_front, "{what}: {pixels} pixels");
                    assert!(is_front || pixels == 0, "{what}: {pixels} pixels");
                }
            }
        }
    }
}

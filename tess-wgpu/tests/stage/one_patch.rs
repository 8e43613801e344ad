//! A stage of one patch without bindings, and the part of the picture that it covers.

use crate::both::Builder;
use crate::model::drawn;
use crate::scene::{FORMAT, Scene};
use tess_core::{Config, Domain};
use tess_wgpu::stage::Room;

/// The number of pixels that a patch of factors 3, or of two lines of three segments, covers.
/// `position` is the WGSL of the position in the picture of the domain point `uv`.
pub(crate) fn pixels(
    scene: &Scene,
    domain: Domain,
    config: Config,
    position: &str,
    primitive: wgpu::PrimitiveState,
) -> usize {
    let hull = match domain {
        Domain::Isoline => "IsolineFactors { return IsolineFactors(2.0, 3.0); }",
        Domain::Triangle => "TriFactors { return tess_tri_factors(vec3f(3.0)); }",
        Domain::Quad => "QuadFactors { return tess_quad_factors(vec4f(3.0)); }",
    };
    let source = format!(
        "struct Vertex {{ @builtin(position) position: vec4f }}\n\
         fn hull(number: u32) -> {hull}\n\
         fn domain(number: u32, uv: vec2f) -> Vertex {{\n    \
         return Vertex(vec4f({position}, 0.5, 1.0));\n}}\n\
         @fragment fn shade() -> @location(0) vec4u {{ return vec4u(0u, 0u, 0u, 1u); }}"
    );
    let mut stage = Builder::new(&source, domain, config, 1)
        .target(FORMAT)
        .room(Room::WorstCase)
        .primitive(primitive)
        .build(&scene.gpu.device)
        .unwrap_or_else(|error| panic!("{error}"));
    drawn(&scene.frame(&mut stage, 1.into()).expect("it draws"))
}

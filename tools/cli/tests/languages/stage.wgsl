// A stage with a resource of each kind that SDL binds.
@group(0) @binding(3) var<uniform> eye: vec4f;
@group(0) @binding(1) var<storage, read> heights: array<f32>;
@group(1) @binding(0) var map: texture_2d<f32>;
SAMPLER
struct Vertex { @builtin(position) position: vec4f, @location(0) uv: vec2f, @location(1) height: f32 }

fn hull(number: u32) -> QuadFactors {
    return tess_quad_factors(eye * heights[number]);
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    return Vertex(eye + heights[number], uv, tess_factors(number).inside.x);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    return SAMPLED * vertex.height;
}

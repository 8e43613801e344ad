// Patches in a grid of 4 x 2, each 64 pixels wide. Every pixel holds the first vertex of its triangle (on OpenGL, the
// last). scene.rs puts in the hull function of the domain.

@group(0) @binding(0) var<storage, read> given: array<f32>;

struct Vertex {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) uv: vec2<f32>,
    @location(1) @interpolate(flat) number: u32,
}

// Names that the stage's own shaders have too.
const ONE = 1.0;

fn place(number: u32) -> vec2<f32> {
    return vec2<f32>(f32(number % 4u), f32(number / 4u));
}

HULL

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    let at = place(number) + uv;
    return Vertex(vec4<f32>(0.5 * at.x - ONE, ONE - at.y, 0.5, 1.0), uv, number);
}

@fragment
fn identify(vertex: Vertex) -> @location(0) vec4<u32> {
    return vec4<u32>(bitcast<vec2<u32>>(vertex.uv), vertex.number, 1u);
}

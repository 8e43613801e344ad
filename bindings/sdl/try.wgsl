// For try.c: no function `hull`, and a resource of each kind.
@group(0) @binding(0) var<storage, read> shades: array<f32>;
@group(0) @binding(1) var colours: texture_2d<f32>;
@group(0) @binding(2) var linear: sampler;
@group(1) @binding(0) var<uniform> offset: vec4f;

struct Vertex { @builtin(position) position: vec4f, @location(0) shade: f32 }

// Every patch covers the whole picture, and each instance is brighter than the one before it.
fn domain(number: u32, uv: vec2f) -> Vertex {
    let corner = 4.0 * uv - 1.0;
    return Vertex(vec4f(corner, 0.5, 1.0) + offset, shades[number] * f32(tess_instance() + 1u));
}

@fragment
fn colour(vertex: Vertex) -> @location(0) vec4f {
    return textureSample(colours, linear, vec2f(0.5)) * vertex.shade;
}

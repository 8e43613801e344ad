// A terrain of four by four quads, seen from above; patches have fractional factors that the host knows exactly.

struct Vertex {
    @builtin(position) position: vec4f,
    @location(0) height: f32,
}

fn hull(number: u32) -> QuadFactors {
    let first = 1.5 + 0.75 * f32(number % 8u);
    return tess_quad_factors(vec4f(first, first + 2.0, first + 9.25, first + 1.0));
}

fn height(at: vec2f) -> f32 {
    return 0.5 + 0.25 * (sin(9.0 * at.x) + sin(7.0 * at.y));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let at = (vec2f(f32(number % 4u), f32(number / 4u)) + uv) / 4.0;
    let high = height(at);
    return Vertex(vec4f(1.8 * at - 0.9, 0.0, 1.0) + vec4f(0.0, 0.1 * high, 0.5 * high, 0.0), high);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    return vec4f(vertex.height, 0.5, 1.0 - vertex.height, 1.0);
}

// The functions of the stage. shading.wgsl comes before this text.

fn hull(number: u32) -> QuadFactors {
    return tess_quad_factors(vec4f(16.0));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let at = vec2f(f32(number % 8u), f32(number / 8u)) + uv;
    let world = vec3f(at, height(at));
    return Vertex(vec4f(world, 1.0), world);
}

fn seen(vertex: Vertex) -> Vertex {
    return Vertex(frame.clip_from_world * vertex.position, vertex.world);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    return colour_of(vertex.world);
}

fn hull(number: u32) -> TriFactors {
    return pn_factors(number);
}

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    let at = tess_place(number);
    let point = pn_point(at, uv);
    return tess_vertex_of(at, point.position, point.normal, uv, vec4<f32>(1.0));
}

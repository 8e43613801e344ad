// The teapot's hull and domain functions. Needs bezier.wgsl, bezier_factors.wgsl and draw.wgsl.

// The factor of an edge of a net, by its control points; the same from both sides.
fn edge_factor(net: array<vec4f, 16>, first: u32, step: u32) -> f32 {
    var all = net;
    var edge: array<vec4f, 4>;
    for (var k = 0u; k < 4u; k++) {
        edge[k] = all[first + k * step];
    }
    return bezier_edge_by_distance(edge, EYE, 140.0);
}

fn hull(number: u32) -> QuadFactors {
    let net = nets[number];
    return tess_quad_factors(vec4f(
        edge_factor(net, 0u, 4u), edge_factor(net, 0u, 1u),
        edge_factor(net, 3u, 4u), edge_factor(net, 12u, 1u)));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let at = PatchPoint(number, uv.x, uv.y);
    let world = teapot_position(at);
    return Vertex(project(world), world, teapot_normal(at));
}

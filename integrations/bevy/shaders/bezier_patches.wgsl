// Bicubic Bezier patches. bezier.rs writes the words: 16 control points per patch, three numbers each, rows along v.
// Needs tess_gpu::surfaces' BEZIER.

fn control(at: TessPlace, k: u32) -> vec3<f32> {
    return tess_vec3(at, 3u * (16u * at.patch_number + k));
}

fn net_of(at: TessPlace) -> array<vec4<f32>, 16> {
    var net: array<vec4<f32>, 16>;
    for (var k = 0u; k < 16u; k++) {
        net[k] = vec4<f32>(control(at, k), 1.0);
    }
    return net;
}

// An edge's factor depends on its two ends.
fn hull(number: u32) -> QuadFactors {
    let at = tess_place(number);
    let a = tess_to_world(at, control(at, 0u));
    let b = tess_to_world(at, control(at, 3u));
    let c = tess_to_world(at, control(at, 15u));
    let d = tess_to_world(at, control(at, 12u));
    return tess_quad_factors(vec4<f32>(
        tess_edge(at, a, d), tess_edge(at, a, b), tess_edge(at, b, c), tess_edge(at, d, c)));
}

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    let at = tess_place(number);
    let net = net_of(at);
    let position = bezier_patch_position(net, uv.x, uv.y);
    let normal = bezier_patch_normal(net, uv.x, uv.y);
    return tess_vertex_of(at, position, normal, uv, vec4<f32>(1.0));
}

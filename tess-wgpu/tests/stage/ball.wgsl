// A ball of quads whose corners have different orders, displaced by a texture.

struct View {
    clip_from_world: mat4x4<f32>,
    eye: vec4<f32>,
    // The rule of the factors, and whether patches are culled.
    rule: u32,
    culls: u32,
    displacement: f32,
    reserved: u32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<storage, read> quads: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> corners: array<vec4<f32>>;
@group(0) @binding(3) var heights: texture_2d<f32>;

struct Vertex {
    @builtin(position) position: vec4<f32>,
    @location(0) world: vec3<f32>,
}

fn corner(number: u32, k: u32) -> vec4<f32> {
    return corners[quads[number][k]];
}

fn edge(a: vec4<f32>, b: vec4<f32>) -> f32 {
    let p = normalize(a.xyz);
    let q = normalize(b.xyz);
    if view.rule == 0u {
        return tess_edge_by_screen_size(p, q, view.eye.xyz, 600.0, 8.0);
    }
    if view.rule == 1u {
        return tess_edge_by_distance(p, q, view.eye.xyz, 9.0);
    }
    return tess_edge_by_curvature(p, p, q, q, 0.0001 * length(view.eye.xyz));
}

fn is_culled(number: u32) -> bool {
    var middle = vec3<f32>(0.0);
    for (var k = 0u; k < 4u; k++) {
        middle += 0.25 * normalize(corner(number, k).xyz);
    }
    var radius = 0.0;
    var cosine = 1.0;
    let axis = normalize(middle);
    for (var k = 0u; k < 4u; k++) {
        let p = normalize(corner(number, k).xyz);
        radius = max(radius, distance(p, middle));
        cosine = min(cosine, dot(axis, p));
    }
    radius += 0.1 + view.displacement;
    return tess_is_outside(view.clip_from_world, middle, radius)
        || tess_faces_away(middle, radius, axis, sqrt(1.0 - cosine * cosine), view.eye.xyz);
}

fn hull(number: u32) -> QuadFactors {
    if view.culls == 1u && is_culled(number) {
        return QuadFactors();
    }
    let a = corner(number, 0u);
    let b = corner(number, 1u);
    let c = corner(number, 2u);
    let d = corner(number, 3u);
    return tess_quad_factors(vec4<f32>(edge(a, d), edge(a, b), edge(b, c), edge(d, c)));
}

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    var around: array<vec4<f32>, 4>;
    for (var k = 0u; k < 4u; k++) {
        around[k] = corner(number, k);
    }
    let direction = normalize(tess_on_quad(around, uv).xyz);
    let height = tess_sample(heights, 0.5 * direction.xy + 0.5);
    let world = direction * (1.0 + view.displacement * height);
    return Vertex(view.clip_from_world * vec4<f32>(world, 1.0), world);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4<f32> {
    return vec4<f32>(vertex.world, 1.0);
}

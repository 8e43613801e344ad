// A mesh of PN triangles, displaced along their normals. Needs tess_gpu::surfaces::BEZIER,
// POINT_NORMAL and PN_TRIANGLE.

struct Frame {
    clip_from_world: mat4x4f,
    eye: vec3f,
    pixels_per_unit: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> corners: array<PnCorner>;
@group(0) @binding(2) var<storage, read> triangles: array<array<u32, 3>>;

struct Vertex {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
}

fn corner(number: u32, k: u32) -> PnCorner {
    return corners[triangles[number][k]];
}

// The greater of the factors by curvature and by size on the screen.
fn edge(a: PnCorner, b: PnCorner) -> f32 {
    let curved = tess_edge_by_curvature(a.position, a.normal, b.position, b.normal, 0.002);
    let size = tess_edge_by_screen_size(a.position, b.position, frame.eye, frame.pixels_per_unit, 5.0);
    return max(curved, size);
}

fn hull(number: u32) -> TriFactors {
    let a = corner(number, 0u);
    let b = corner(number, 1u);
    let c = corner(number, 2u);
    return tess_tri_factors(vec3f(edge(b, c), edge(a, c), edge(a, b)));
}

fn rounded(number: u32, uv: vec2f) -> PnPoint {
    return pn_triangle_point(corner(number, 0u), corner(number, 1u), corner(number, 2u), uv);
}

// The displacement of a place, which looks like wool. It depends only on the place, so that edges stay closed.
fn height(at: vec3f) -> f32 {
    let p = 27.0 * at;
    return 0.014 * (sin(p.x) * sin(p.y + 0.7 * sin(p.z)) + 0.6 * sin(1.7 * p.z + p.x) * cos(1.9 * p.y));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let at = rounded(number, uv);
    let world = at.position + height(at.position) * at.normal;
    return Vertex(frame.clip_from_world * vec4f(world, 1.0), world, at.normal);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    let flat_normal = normalize(cross(dpdx(vertex.world), dpdy(vertex.world)));
    let to_eye = normalize(frame.eye - vertex.world);
    let normal = select(-flat_normal, flat_normal, dot(flat_normal, to_eye) > 0.0);
    let light = 0.35 + 0.65 * max(dot(normalize(normal + vertex.normal), normalize(vec3f(0.5, -0.8, 0.7))), 0.0);
    let wool = mix(vec3f(0.78, 0.52, 0.32), vec3f(0.95, 0.85, 0.70), smoothstep(1.9, 2.3, vertex.world.z));
    return vec4f(light * wool, 1.0);
}

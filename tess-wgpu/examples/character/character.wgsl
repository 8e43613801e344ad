// A mesh of PN triangles, displaced along their normals. Needs tess_surface::shaders::BEZIER and POINT_NORMAL.

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

// A point of the rounded surface.
struct Rounded {
    position: vec3f,
    normal: vec3f,
}

fn corner(number: u32, k: u32) -> PnCorner {
    return corners[triangles[number][k]];
}

// Fine enough for the curve, and for pixels.
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

// A point on the edge from a to b, the same from both sides.
fn on_edge(a: PnCorner, b: PnCorner, t: f32) -> Rounded {
    let curve = array<vec4f, 4>(
        vec4f(a.position, 1.0), vec4f(pn_edge_point(a, b), 1.0),
        vec4f(pn_edge_point(b, a), 1.0), vec4f(b.position, 1.0));
    let position = bezier_edge(curve, t);
    let middle = pn_edge_normal(a, b);
    if bezier_is_reversed(curve) {
        return Rounded(position, normalize(pn_normal_along(b.normal, middle, a.normal, 1.0 - t)));
    }
    return Rounded(position, normalize(pn_normal_along(a.normal, middle, b.normal, t)));
}

fn inside(a: PnCorner, b: PnCorner, c: PnCorner, uv: vec2f) -> Rounded {
    let edges = array<vec3f, 6>(
        pn_edge_point(c, b), pn_edge_point(b, c), pn_edge_point(c, a),
        pn_edge_point(a, c), pn_edge_point(b, a), pn_edge_point(a, b));
    let middles = array<vec3f, 3>(pn_edge_normal(b, c), pn_edge_normal(a, c), pn_edge_normal(a, b));
    return Rounded(
        pn_triangle_position(array<vec3f, 3>(a.position, b.position, c.position), edges, uv.x, uv.y),
        pn_triangle_normal(array<vec3f, 3>(a.normal, b.normal, c.normal), middles, uv.x, uv.y));
}

fn rounded(number: u32, uv: vec2f) -> Rounded {
    let a = corner(number, 0u);
    let b = corner(number, 1u);
    let c = corner(number, 2u);
    if uv.x <= 0.0 {
        return on_edge(c, b, uv.y);
    }
    if uv.y <= 0.0 {
        return on_edge(c, a, uv.x);
    }
    if 1.0 - uv.x - uv.y <= 0.0 {
        return on_edge(b, a, uv.x);
    }
    return inside(a, b, c, uv);
}

// How far a place is displaced: wool. It depends on the place alone, so that edges stay closed.
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

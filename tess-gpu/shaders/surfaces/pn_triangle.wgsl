// A point-normal triangle at a domain point. Needs bezier.wgsl, pn.wgsl and pn_edge.wgsl. Position and normal of a point
// on an edge are computed from the edge's two ends, in the same direction for both triangles.

struct PnPoint {
    position: vec3f,
    // Of unit length.
    normal: vec3f,
}

// A point on the edge from a to b, the same from both sides.
fn pn_on_edge(a: PnCorner, b: PnCorner, t: f32) -> PnPoint {
    let curve = array<vec4f, 4>(
        vec4f(a.position, 1.0), vec4f(pn_edge_point(a, b), 1.0),
        vec4f(pn_edge_point(b, a), 1.0), vec4f(b.position, 1.0));
    let position = bezier_edge(curve, t);
    let middle = pn_edge_normal(a, b);
    if bezier_is_reversed(curve) {
        return PnPoint(position, normalize(pn_normal_along(b.normal, middle, a.normal, 1.0 - t)));
    }
    return PnPoint(position, normalize(pn_normal_along(a.normal, middle, b.normal, t)));
}

fn pn_inside(a: PnCorner, b: PnCorner, c: PnCorner, uv: vec2f) -> PnPoint {
    let edges = array<vec3f, 6>(
        pn_edge_point(c, b), pn_edge_point(b, c), pn_edge_point(c, a),
        pn_edge_point(a, c), pn_edge_point(b, a), pn_edge_point(a, b));
    let middles = array<vec3f, 3>(pn_edge_normal(b, c), pn_edge_normal(a, c), pn_edge_normal(a, b));
    return PnPoint(
        pn_triangle_position(array<vec3f, 3>(a.position, b.position, c.position), edges, uv.x, uv.y),
        pn_triangle_normal(array<vec3f, 3>(a.normal, b.normal, c.normal), middles, uv.x, uv.y));
}

// The triangle with corners at u = 1, v = 1, w = 1.
fn pn_triangle_point(a: PnCorner, b: PnCorner, c: PnCorner, uv: vec2f) -> PnPoint {
    if uv.x <= 0.0 {
        return pn_on_edge(c, b, uv.y);
    }
    if uv.y <= 0.0 {
        return pn_on_edge(c, a, uv.x);
    }
    if 1.0 - uv.x - uv.y <= 0.0 {
        return pn_on_edge(b, a, uv.x);
    }
    return pn_inside(a, b, c, uv);
}

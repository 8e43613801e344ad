// Point-normal triangles (Vlachos et al. 2001) and quads. The formulas of pn.rs. Needs pn_edge.wgsl.

struct PnCorner {
    position: vec3f,
    normal: vec3f,
}

// The inner control point next to `near` on the edge to `far`.
fn pn_edge_point(near: PnCorner, far: PnCorner) -> vec3f {
    return tess_pn_edge_point(near.position, near.normal, far.position);
}

// The middle coefficient of the quadratic normal along an edge.
fn pn_edge_normal(a: PnCorner, b: PnCorner) -> vec3f {
    let along = b.position - a.position;
    let sum = a.normal + b.normal;
    let reflected = sum - along * (2.0 * dot(along, sum) / dot(along, along));
    return reflected * inverseSqrt(max(dot(reflected, reflected), 1e-30));
}

// The quadratic normal along an edge, not of unit length.
fn pn_normal_along(a: vec3f, middle: vec3f, b: vec3f, t: f32) -> vec3f {
    let s = 1.0 - t;
    return a * (s * s) + middle * (s * t) + b * (t * t);
}

// The cubic triangle with corners at u = 1, v = 1, w = 1, whose edges' inner control points are
// those of u = 0 (from w to v), v = 0 (from w to u) and w = 0 (from v to u).
fn pn_triangle_position(corners: array<vec3f, 3>, edges: array<vec3f, 6>, u: f32, v: f32) -> vec3f {
    let w = 1.0 - u - v;
    let e = (edges[0] + edges[1] + edges[2] + edges[3] + edges[4] + edges[5]) / 6.0;
    let center = e + (e - (corners[0] + corners[1] + corners[2]) / 3.0) * 0.5;
    let by_u = corners[0] * (u * u) + edges[4] * (v * v) + edges[2] * (w * w)
        + 2.0 * (edges[5] * (u * v) + edges[3] * (u * w) + center * (v * w));
    let by_v = edges[5] * (u * u) + corners[1] * (v * v) + edges[0] * (w * w)
        + 2.0 * (edges[4] * (u * v) + center * (u * w) + edges[1] * (v * w));
    let by_w = edges[3] * (u * u) + edges[1] * (v * v) + corners[2] * (w * w)
        + 2.0 * (center * (u * v) + edges[2] * (u * w) + edges[0] * (v * w));
    return by_u * u + by_v * v + by_w * w;
}

// The quadratic normal of a triangle: normals of the corners and middle coefficients of the
// edges u = 0, v = 0, w = 0.
fn pn_triangle_normal(corners: array<vec3f, 3>, edges: array<vec3f, 3>, u: f32, v: f32) -> vec3f {
    let w = 1.0 - u - v;
    let normal = corners[0] * (u * u) + corners[1] * (v * v) + corners[2] * (w * w)
        + edges[2] * (u * v) + edges[0] * (v * w) + edges[1] * (u * w);
    return normalize(normal);
}

// The blended normal of a quad, corners at (0,0), (1,0), (1,1), (0,1), edges u = 0, v = 0, u = 1,
// v = 1.
fn pn_quad_normal(corners: array<vec3f, 4>, edges: array<vec3f, 4>, u: f32, v: f32) -> vec3f {
    let left = pn_normal_along(corners[0], edges[0], corners[3], v);
    let right = pn_normal_along(corners[1], edges[2], corners[2], v);
    let below = pn_normal_along(corners[0], edges[1], corners[1], u);
    let above = pn_normal_along(corners[3], edges[3], corners[2], u);
    let bilinear = mix(mix(corners[0], corners[1], u), mix(corners[3], corners[2], u), v);
    return normalize(mix(left, right, u) + mix(below, above, v) - bilinear);
}

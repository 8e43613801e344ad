// Factor rules for cubic edges, given by their control points in either direction. The formulas of FactorRule::edge in
// factors.rs. Needs bezier.wgsl, factors.wgsl and pn_edge.wgsl.

// As tess_edge_by_distance; the middle is the curve's point at t = 0.5.
fn bezier_edge_by_distance(edge: array<vec4f, 4>, eye: vec3f, scale: f32) -> f32 {
    return tess_quotient(scale, distance(eye, bezier_edge(edge, 0.5)));
}

// The length of the control polygon, added up in canonical direction.
fn bezier_length_bound(edge: array<vec4f, 4>) -> f32 {
    let a = bezier_project(edge[0]);
    let b = bezier_project(edge[1]);
    let c = bezier_project(edge[2]);
    let d = bezier_project(edge[3]);
    let reversed = bezier_is_reversed(edge);
    let first = select(distance(a, b), distance(c, d), reversed);
    let last = select(distance(c, d), distance(a, b), reversed);
    return first + distance(b, c) + last;
}

// As tess_edge_by_screen_size; the length is that of the control polygon.
fn bezier_edge_by_screen_size(edge: array<vec4f, 4>, eye: vec3f, pixels_per_unit: f32, segment: f32) -> f32 {
    let pixels = bezier_length_bound(edge) * pixels_per_unit;
    return tess_quotient(pixels, distance(eye, bezier_edge(edge, 0.5)) * segment);
}

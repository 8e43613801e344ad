// The result of a hull function, in the specification's order (section 1). A factor of 0 culls the patch:
// `QuadFactors()` is a patch that is not drawn.

struct QuadFactors {
    // Along u = 0, v = 0, u = 1, v = 1.
    edges: vec4<f32>,
    // Along u and along v.
    inside: vec2<f32>,
}

// The factors of a quad from those of its edges; each inside factor is the mean of the two edges in its direction.
fn tess_quad_factors(edges: vec4<f32>) -> QuadFactors {
    return QuadFactors(edges, tess_inside_quad(edges));
}

struct TriFactors {
    // Along u = 0, v = 0, w = 0.
    edges: vec3<f32>,
    inside: f32,
}

// The factors of a triangle from those of its edges; the inside factor is their mean.
fn tess_tri_factors(edges: vec3<f32>) -> TriFactors {
    return TriFactors(edges, tess_inside_triangle(edges));
}

struct IsolineFactors {
    // The number of lines, and the number of segments of each line.
    density: f32,
    detail: f32,
}

// Factor rules, each a function of the edge in canonical direction. The formulas of factors.rs
// and bend.rs. Needs bezier.wgsl.

// Factors are 1..64; NaN counts as 1.
fn factor_in_range(factor: f32) -> f32 {
    if factor > 1.0 {
        return min(factor, 64.0);
    }
    return 1.0;
}

// Inversely proportional to the distance from the eye.
fn factor_by_distance(edge: array<vec4f, 4>, eye: vec3f, scale: f32) -> f32 {
    return factor_in_range(scale / distance(eye, bezier_edge(edge, 0.5)));
}

// The length of the control polygon, the same from both sides.
fn factor_length_bound(edge: array<vec4f, 4>) -> f32 {
    let a = bezier_project(edge[0]);
    let b = bezier_project(edge[1]);
    let c = bezier_project(edge[2]);
    let d = bezier_project(edge[3]);
    return (distance(a, b) + distance(c, d)) + distance(b, c);
}

// Segments of about this many pixels; pixels_per_unit is a length of 1 seen at distance 1.
fn factor_by_screen_space(edge: array<vec4f, 4>, eye: vec3f, pixels_per_unit: f32, segment: f32) -> f32 {
    let pixels = factor_length_bound(edge) * pixels_per_unit;
    return factor_in_range(pixels / (distance(eye, bezier_edge(edge, 0.5)) * segment));
}

// Deviation of at most `tolerance`; bend as bend.rs bounds it, the larger one of both sides.
fn factor_by_flatness(bend: f32, tolerance: f32) -> f32 {
    return factor_in_range(sqrt(bend / (4.0 * tolerance)));
}

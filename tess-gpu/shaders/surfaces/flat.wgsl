// Points on lines, bilinear quads and flat triangles, closed along edges: a point on an edge follows from the edge's
// two corners alone. The formulas of curve.rs (lines) and patch.rs. Corners are whatever is interpolated: a position
// and one number more, texture coordinates, a colour; leave unused components 0.

// Whether a sorts before b, component by component.
fn tess_is_before(a: vec4<f32>, b: vec4<f32>) -> bool {
    for (var i = 0u; i < 4u; i++) {
        if a[i] != b[i] {
            return a[i] < b[i];
        }
    }
    return false;
}

// A point between two corners, t from 0 at a to 1 at b. tess_along(a, b, t) is tess_along(b, a, 1 - t) to the bit
// where 1 - t is exact, as for every domain point; the ends are the corners themselves.
fn tess_along(a: vec4<f32>, b: vec4<f32>, t: f32) -> vec4<f32> {
    if t <= 0.0 {
        return a;
    }
    if t >= 1.0 {
        return b;
    }
    if tess_is_before(b, a) {
        return b + (a - b) * (1.0 - t);
    }
    return a + (b - a) * t;
}

// A point of a bilinear quad; corners at (0,0), (1,0), (1,1), (0,1).
fn tess_on_quad(corners: array<vec4<f32>, 4>, uv: vec2<f32>) -> vec4<f32> {
    if uv.x <= 0.0 {
        return tess_along(corners[0], corners[3], uv.y);
    }
    if uv.x >= 1.0 {
        return tess_along(corners[1], corners[2], uv.y);
    }
    if uv.y <= 0.0 {
        return tess_along(corners[0], corners[1], uv.x);
    }
    if uv.y >= 1.0 {
        return tess_along(corners[3], corners[2], uv.x);
    }
    let low = corners[0] + (corners[1] - corners[0]) * uv.x;
    let high = corners[3] + (corners[2] - corners[3]) * uv.x;
    return low + (high - low) * uv.y;
}

// A point of a flat triangle; corners at u = 1, v = 1, w = 1.
fn tess_on_triangle(corners: array<vec4<f32>, 3>, uv: vec2<f32>) -> vec4<f32> {
    let w = 1.0 - uv.x - uv.y;
    if uv.x <= 0.0 {
        return tess_along(corners[2], corners[1], uv.y);
    }
    if uv.y <= 0.0 {
        return tess_along(corners[2], corners[0], uv.x);
    }
    if w <= 0.0 {
        return tess_along(corners[1], corners[0], uv.x);
    }
    return corners[2] + (corners[0] - corners[2]) * uv.x + (corners[1] - corners[2]) * uv.y;
}

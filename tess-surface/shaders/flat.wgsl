// Flat triangles, bilinear quads and displacement along the normal.
// The formulas of patch.rs and height.rs.

// Corners at u = 1, v = 1, w = 1. Along an edge the same from both sides if both are given the
// corners in the same order, such as that of their numbers.
fn flat_triangle(corners: array<vec3f, 3>, u: f32, v: f32) -> vec3f {
    return corners[2] + (corners[0] - corners[2]) * u + (corners[1] - corners[2]) * v;
}

// Corners at (0,0), (1,0), (1,1), (0,1).
fn flat_quad(corners: array<vec3f, 4>, u: f32, v: f32) -> vec3f {
    let low = corners[0] + (corners[1] - corners[0]) * u;
    let high = corners[3] + (corners[2] - corners[3]) * u;
    return low + (high - low) * v;
}

// Position displaced by a height; direction and height must be the same on both sides of an edge.
fn displaced_position(position: vec3f, direction: vec3f, height: f32, scale: f32) -> vec3f {
    return position + direction * (height * scale);
}

// Normal of the displaced surface (Blinn 1978); slopes are the scaled height's by u and v.
fn displaced_normal(normal: vec3f, du: vec3f, dv: vec3f, slope_u: f32, slope_v: f32) -> vec3f {
    let area = length(cross(du, dv));
    if area <= 1e-6 * max(dot(du, du), dot(dv, dv)) {
        return normal;
    }
    return normalize(normal * area + cross(normal, dv) * slope_u + cross(du, normal) * slope_v);
}

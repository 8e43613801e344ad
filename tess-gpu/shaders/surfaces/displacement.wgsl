// Displacement along a direction. The formulas of displaced.rs.

// A position displaced by a height; direction and height must be the same on both sides of an edge.
fn displaced_position(position: vec3f, direction: vec3f, height: f32, scale: f32) -> vec3f {
    return position + direction * (height * scale);
}

// The normal of the displaced surface (Blinn 1978); slopes are the scaled height's derivatives by u and v.
fn displaced_normal(normal: vec3f, du: vec3f, dv: vec3f, slope_u: f32, slope_v: f32) -> vec3f {
    let area = length(cross(du, dv));
    if area <= 1e-6 * max(dot(du, du), dot(dv, dv)) {
        return normal;
    }
    return normalize(normal * area + cross(normal, dv) * slope_u + cross(du, normal) * slope_v);
}

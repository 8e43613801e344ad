// Tests that cull a patch before it is tessellated, with the formulas of culling.rs. Give an invisible patch factors
// of 0.

// Whether a ball is wholly on the negative side of a plane. `plane.xyz` points to the positive side and may have any
// length except 0.
fn tess_is_behind(plane: vec4<f32>, center: vec3<f32>, radius: f32) -> bool {
    return dot(plane.xyz, center) + plane.w < -radius * length(plane.xyz);
}

// Whether a ball is wholly outside one of the six planes of a projection with z from 0 to w. The ball must contain the
// whole patch, including its displacement.
fn tess_is_outside(clip_from_world: mat4x4<f32>, center: vec3<f32>, radius: f32) -> bool {
    let rows = transpose(clip_from_world);
    return tess_is_behind(rows[3] + rows[0], center, radius)
        || tess_is_behind(rows[3] - rows[0], center, radius)
        || tess_is_behind(rows[3] + rows[1], center, radius)
        || tess_is_behind(rows[3] - rows[1], center, radius)
        || tess_is_behind(rows[2], center, radius)
        || tess_is_behind(rows[3] - rows[2], center, radius);
}

// Whether all of a surface faces away from the eye. The surface is inside a ball, and its normals are within an angle
// of less than 90 degrees of the unit vector `axis`; `sine` is the sine of that angle.
fn tess_faces_away(
    center: vec3<f32>, radius: f32, axis: vec3<f32>, sine: f32, eye: vec3<f32>,
) -> bool {
    let seen = center - eye;
    return dot(seen, axis) > sine * length(seen) + radius;
}

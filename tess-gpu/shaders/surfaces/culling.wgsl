// Tests that cull a patch before it is tessellated: give it factors of 0 then. The formulas of culling.rs.

// Whether a ball is wholly on the negative side of a plane: `plane.xyz` points to its positive side and has any
// length but 0.
fn tess_is_behind(plane: vec4<f32>, center: vec3<f32>, radius: f32) -> bool {
    return dot(plane.xyz, center) + plane.w < -radius * length(plane.xyz);
}

// Whether a ball is wholly outside one of the six planes of a projection with z from 0 to w. The ball must hold the
// whole patch, its displacement included.
fn tess_is_outside(clip_from_world: mat4x4<f32>, center: vec3<f32>, radius: f32) -> bool {
    let rows = transpose(clip_from_world);
    return tess_is_behind(rows[3] + rows[0], center, radius)
        || tess_is_behind(rows[3] - rows[0], center, radius)
        || tess_is_behind(rows[3] + rows[1], center, radius)
        || tess_is_behind(rows[3] - rows[1], center, radius)
        || tess_is_behind(rows[2], center, radius)
        || tess_is_behind(rows[3] - rows[2], center, radius);
}

// Whether all of a surface turns its back to the eye. The surface lies in a ball, and its normals are within an angle
// of the unit vector `axis`, less than 90 degrees; `sine` is that angle's sine.
fn tess_faces_away(
    center: vec3<f32>, radius: f32, axis: vec3<f32>, sine: f32, eye: vec3<f32>,
) -> bool {
    let seen = center - eye;
    return dot(seen, axis) > sine * length(seen) + radius;
}

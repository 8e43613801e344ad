// The inner control point of a point-normal edge next to `near`: the third of the way to `far`, moved along the
// unit normal at `near` into the tangent plane there. The formula of edge_points in pn.rs.
fn tess_pn_edge_point(near: vec3<f32>, normal: vec3<f32>, far: vec3<f32>) -> vec3<f32> {
    return (near * 2.0 + far - normal * dot(far - near, normal)) / 3.0;
}

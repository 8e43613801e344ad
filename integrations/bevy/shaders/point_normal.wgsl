// Point-normal triangles. point_normal.rs writes the words: the number of corners, the corners with six
// numbers each, the triangles. Needs tess_gpu::surfaces' BEZIER, POINT_NORMAL and PN_TRIANGLE.

fn pn_corner(at: TessPlace, k: u32) -> PnCorner {
    let corners = tess_uint(at, 0u);
    let corner = 1u + 6u * tess_uint(at, 1u + 6u * corners + 3u * at.patch_number + k);
    return PnCorner(tess_vec3(at, corner), tess_vec3(at, corner + 3u));
}

fn pn_edge(at: TessPlace, a: PnCorner, b: PnCorner) -> f32 {
    return tess_edge(at, tess_to_world(at, a.position), tess_to_world(at, b.position));
}

// Factors by the entity's rule.
fn pn_factors(number: u32) -> TriFactors {
    let at = tess_place(number);
    let a = pn_corner(at, 0u);
    let b = pn_corner(at, 1u);
    let c = pn_corner(at, 2u);
    return tess_tri_factors(vec3<f32>(pn_edge(at, b, c), pn_edge(at, a, c), pn_edge(at, a, b)));
}

// The rounded surface, in local space.
fn pn_point(at: TessPlace, uv: vec2<f32>) -> PnPoint {
    return pn_triangle_point(pn_corner(at, 0u), pn_corner(at, 1u), pn_corner(at, 2u), uv);
}

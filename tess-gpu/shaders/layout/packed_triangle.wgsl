// needs: nothing
// A triangle of a patch of at most 1024 points in one word, 10 bits for each vertex.

fn packed_triangle(triangle: vec3<u32>) -> u32 {
    return triangle.x | (triangle.y << 10u) | (triangle.z << 20u);
}

// Its vertex `which`.
fn packed_vertex(packed: u32, which: u32) -> u32 {
    return (packed >> (10u * which)) & 1023u;
}

// Its indices; `base` is that of the patch's first point.
fn unpacked_triangle(packed: u32, base: u32) -> vec3<u32> {
    return vec3<u32>(base)
        + vec3<u32>(packed & 1023u, (packed >> 10u) & 1023u, packed >> 20u);
}

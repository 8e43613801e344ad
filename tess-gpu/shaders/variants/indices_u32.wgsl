// needs: nothing
// Indices of 32 bits, two at a time.

@group(0) @binding(6) var<storage, read_write> indices_out: array<vec2<u32>>;

// Pair `at` of triangles.
fn write_triangle_pair(at: u32, first: vec3<u32>, second: vec3<u32>) {
    indices_out[3u * at] = first.xy;
    indices_out[3u * at + 1u] = vec2<u32>(first.z, second.x);
    indices_out[3u * at + 2u] = second.yz;
}

// One triangle of pair `at`.
fn write_triangle(at: u32, is_second: bool, triangle: vec3<u32>) {
    if is_second {
        indices_out[3u * at + 1u].y = triangle.x;
        indices_out[3u * at + 2u] = triangle.yz;
    } else {
        indices_out[3u * at] = triangle.xy;
        indices_out[3u * at + 1u].x = triangle.z;
    }
}

// Indices 2 * `at` and the next.
fn write_two(at: u32, first: u32, second: u32) {
    indices_out[at] = vec2<u32>(first, second);
}

fn write_single(at: u32, index: u32) {
    if (at & 1u) == 0u {
        indices_out[at >> 1u].x = index;
    } else {
        indices_out[at >> 1u].y = index;
    }
}

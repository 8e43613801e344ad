// needs: nothing
// Indices of 16 bits, two in a word. The two elements of a pair, which can share a word, are written
// by one thread, or by one dispatch after another, so half a word can be replaced.

@group(0) @binding(6) var<storage, read_write> indices_out: array<u32>;

fn halves(low: u32, high: u32) -> u32 {
    return (low & 0xffffu) | (high << 16u);
}

// Index `at` alone.
fn write_single(at: u32, index: u32) {
    let word = indices_out[at >> 1u];
    let is_high = (at & 1u) != 0u;
    indices_out[at >> 1u] = select(halves(index, word >> 16u), halves(word, index), is_high);
}

// Indices 2 * `at` and the next.
fn write_two(at: u32, first: u32, second: u32) {
    indices_out[at] = halves(first, second);
}

// Pair `at` of triangles.
fn write_triangle_pair(at: u32, first: vec3<u32>, second: vec3<u32>) {
    indices_out[3u * at] = halves(first.x, first.y);
    indices_out[3u * at + 1u] = halves(first.z, second.x);
    indices_out[3u * at + 2u] = halves(second.y, second.z);
}

// One triangle of pair `at`.
fn write_triangle(at: u32, is_second: bool, triangle: vec3<u32>) {
    if is_second {
        write_single(6u * at + 3u, triangle.x);
        indices_out[3u * at + 2u] = halves(triangle.y, triangle.z);
    } else {
        indices_out[3u * at] = halves(triangle.x, triangle.y);
        write_single(6u * at + 2u, triangle.z);
    }
}

// The vertex shader: a packed point (tess_gpu::layout::PackedPoint) to the user's domain function.

@vertex
fn tess_vertex(@location(0) tess_packed: vec2<u32>) -> Vertex {
    let u = tess_packed.x & 0x1ffffu;
    let v = (tess_packed.x >> 17u) | ((tess_packed.y & 3u) << 15u);
    return domain(tess_packed.y >> 2u, vec2<f32>(f32(u), f32(v)) / 65536.0);
}

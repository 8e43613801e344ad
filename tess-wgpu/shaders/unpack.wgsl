// A packed point: tess_gpu::layout::PackedPoint.

struct TessPoint {
    // The patch's number.
    number: u32,
    location: vec2<f32>,
}

fn tess_unpacked(packed: vec2<u32>) -> TessPoint {
    let u = packed.x & 0x1ffffu;
    let v = (packed.x >> 17u) | ((packed.y & 3u) << 15u);
    return TessPoint(packed.y >> 2u, vec2<f32>(f32(u), f32(v)) / 65536.0);
}

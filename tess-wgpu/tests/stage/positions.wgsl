// The position of each point, as the vertex shader computes it.

@group(1) @binding(0) var<storage, read> points: array<vec2<u32>>;
@group(1) @binding(1) var<storage, read_write> positions: array<vec4<f32>>;
@group(1) @binding(2) var<storage, read> status: array<u32>;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < status[0] {
        let packed = points[id.x];
        let u = packed.x & 0x1ffffu;
        let v = (packed.x >> 17u) | ((packed.y & 3u) << 15u);
        let vertex = domain(packed.y >> 2u, vec2<f32>(f32(u), f32(v)) / 65536.0);
        positions[2u * id.x] = vertex.position;
        positions[2u * id.x + 1u] = vec4<f32>(vertex.world, 1.0);
    }
}

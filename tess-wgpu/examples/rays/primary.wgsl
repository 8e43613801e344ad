// The same picture without rasterising: a ray for each pixel. shading.wgsl comes before this text.

@group(1) @binding(1) var<storage, read> vertices: array<Vertex>;
@group(1) @binding(2) var<storage, read> indices: array<u32>;

struct Pixel {
    @builtin(position) position: vec4f,
    @location(0) at: vec2f,
}

// A triangle that covers the picture.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> Pixel {
    let at = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return Pixel(vec4f(at, 0.5, 1.0), at);
}

@fragment
fn trace(pixel: Pixel) -> @location(0) vec4f {
    let direction = frame.forward.xyz + pixel.at.x * frame.right.xyz + pixel.at.y * frame.up.xyz;
    var ray: ray_query;
    rayQueryInitialize(&ray, scene, RayDesc(0u, 0xffu, 0.05, 500.0, frame.eye.xyz, direction));
    rayQueryProceed(&ray);
    let hit = rayQueryGetCommittedIntersection(&ray);
    if hit.kind == RAY_QUERY_INTERSECTION_NONE {
        discard;
    }
    let first = 3u * hit.primitive_index;
    let a = vertices[indices[first]].world;
    let b = vertices[indices[first + 1u]].world;
    let c = vertices[indices[first + 2u]].world;
    let at = hit.barycentrics;
    return colour_of(a * (1.0 - at.x - at.y) + b * at.x + c * at.y);
}

// Draws packed domain points as a displaced, shaded terrain.

const GRID = 32u;
const CAMERA = vec3<f32>(16.0, 7.0, 4.0);
const TARGET = vec3<f32>(16.0, 0.0, 11.0);
const ZOOM = 2.0;
const ASPECT = 1.333333;
const NEAR = 0.5;
const FAR = 100.0;

struct Vertex {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec2<f32>,
    @location(1) patch_uv: vec2<f32>,
}

fn height(p: vec2<f32>) -> f32 {
    return 0.55 * sin(0.9 * p.x + 0.4) * cos(0.8 * p.y) + 0.22 * sin(2.3 * p.x + 1.7 * p.y)
        + 0.1 * cos(5.1 * p.x - 3.9 * p.y);
}

@vertex
fn place_vertex(@location(0) packed: vec2<u32>) -> Vertex {
    let u = f32(packed.x & 0x1ffffu) / 65536.0;
    let v = f32((packed.x >> 17u) | ((packed.y & 3u) << 15u)) / 65536.0;
    let patch_index = packed.y >> 2u;
    let place = vec2<f32>(f32(patch_index % GRID) + u, f32(patch_index / GRID) + v);
    let world = vec3<f32>(place.x, height(place), place.y) - CAMERA;
    let forward = normalize(TARGET - CAMERA);
    let right = normalize(cross(vec3<f32>(0.0, 1.0, 0.0), forward));
    let up = cross(forward, right);
    let depth = dot(world, forward);
    let z = (depth - NEAR) * FAR / (FAR - NEAR);
    let position = vec4<f32>(
        ZOOM / ASPECT * dot(world, right), ZOOM * dot(world, up), z, depth);
    return Vertex(position, place, vec2<f32>(u, v));
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4<f32> {
    let step = vec2<f32>(0.01, 0.0);
    let slope = vec2<f32>(
        height(vertex.place + step.xy) - height(vertex.place - step.xy),
        height(vertex.place + step.yx) - height(vertex.place - step.yx)) / 0.02;
    let normal = normalize(vec3<f32>(-slope.x, 1.0, -slope.y));
    let light = 0.25 + 0.75 * max(dot(normal, normalize(vec3<f32>(0.5, 0.8, -0.4))), 0.0);
    let low = vec3<f32>(0.16, 0.34, 0.20);
    let high = vec3<f32>(0.78, 0.74, 0.62);
    let color = mix(low, high, smoothstep(-0.5, 0.8, height(vertex.place)));
    return vec4<f32>(light * color, 1.0);
}

// 16 x 16 patches of a sea, each 1 wide.

struct Frame {
    clip_from_world: mat4x4f,
    eye: vec3f,
    seconds: f32,
    // The size in pixels of a length of 1 at distance 1.
    pixels_per_unit: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;

struct Vertex {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
}

// A point of the sea, which is the same for both patches of an edge.
fn wave(at: vec2f) -> vec3f {
    let t = 1.3 * frame.seconds;
    let height = 0.16 * sin(1.7 * at.x + 0.6 * at.y + t) + 0.09 * sin(2.9 * at.y - 1.3 * at.x + 1.6 * t)
        + 0.03 * sin(7.0 * at.x + 5.0 * at.y + 2.3 * t);
    return vec3f(at, height);
}

fn corner(number: u32, uv: vec2f) -> vec2f {
    return vec2f(f32(number % 16u), f32(number / 16u)) + uv;
}

fn edge(a: vec2f, b: vec2f) -> f32 {
    return tess_edge_by_screen_size(vec3f(a, 0.0), vec3f(b, 0.0), frame.eye, frame.pixels_per_unit, 10.0);
}

fn hull(number: u32) -> QuadFactors {
    let middle = vec3f(corner(number, vec2f(0.5)), 0.0);
    if tess_is_outside(frame.clip_from_world, middle, 1.0) {
        return QuadFactors(); // all zero: culled
    }
    let a = corner(number, vec2f(0.0, 0.0));
    let b = corner(number, vec2f(1.0, 0.0));
    let c = corner(number, vec2f(1.0, 1.0));
    let d = corner(number, vec2f(0.0, 1.0));
    return tess_quad_factors(vec4f(edge(a, d), edge(a, b), edge(b, c), edge(d, c)));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let world = wave(corner(number, uv));
    return Vertex(frame.clip_from_world * vec4f(world, 1.0), world);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    let at = vertex.world.xy;
    let here = wave(at).z;
    let slope = vec2f(wave(at + vec2f(0.01, 0.0)).z - here, wave(at + vec2f(0.0, 0.01)).z - here) / 0.01;
    let normal = normalize(vec3f(-slope, 1.0));
    let to_eye = normalize(frame.eye - vertex.world);
    let shine = pow(max(dot(normal, normalize(to_eye + vec3f(0.3, 0.8, 0.5))), 0.0), 90.0);
    let glance = pow(1.0 - max(dot(normal, to_eye), 0.0), 3.0);
    return vec4f(mix(vec3f(0.02, 0.22, 0.30), vec3f(0.55, 0.70, 0.80), glance) + 0.6 * shine, 1.0);
}

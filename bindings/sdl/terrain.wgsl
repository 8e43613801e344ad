// A square of terrain, 64 wide, in frame.grid x frame.grid patches, displaced by a texture of heights.

struct Frame {
    clip_from_world: mat4x4f,
    eye: vec3f,
    // The size in pixels of a length of 1 at distance 1.
    pixels_per_unit: f32,
    // The wanted length of a segment in pixels.
    segment: f32,
    grid: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var heights: texture_2d<f32>;

const WIDTH = 64.0;
const HEIGHT = 9.0;

struct Vertex {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
}

// The terrain above a place, 0 to 1 in each direction.
fn ground(place: vec2f) -> vec3f {
    return vec3f(WIDTH * place, HEIGHT * tess_sample(heights, place));
}

// The place of a point of a patch. Both patches of an edge find the same one, so nothing opens between them.
fn place(number: u32, uv: vec2f) -> vec2f {
    return (vec2f(f32(number % frame.grid), f32(number / frame.grid)) + uv) / f32(frame.grid);
}

fn edge(a: vec3f, b: vec3f) -> f32 {
    return tess_edge_by_screen_size(a, b, frame.eye, frame.pixels_per_unit, frame.segment);
}

fn hull(number: u32) -> QuadFactors {
    let a = ground(place(number, vec2f(0.0, 0.0)));
    let b = ground(place(number, vec2f(1.0, 0.0)));
    let c = ground(place(number, vec2f(1.0, 1.0)));
    let d = ground(place(number, vec2f(0.0, 1.0)));
    let middle = vec3f(0.25 * (a.xy + b.xy + c.xy + d.xy), 0.5 * HEIGHT);
    if tess_is_outside(frame.clip_from_world, middle, distance(middle, vec3f(a.xy, 0.0))) {
        return QuadFactors();
    }
    return tess_quad_factors(vec4f(edge(a, d), edge(a, b), edge(b, c), edge(d, c)));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let world = ground(place(number, uv));
    return Vertex(frame.clip_from_world * vec4f(world, 1.0), world);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    let at = vertex.world.xy / WIDTH;
    let step = 1.0 / 256.0;
    let east = ground(at + vec2f(step, 0.0)) - ground(at - vec2f(step, 0.0));
    let north = ground(at + vec2f(0.0, step)) - ground(at - vec2f(0.0, step));
    let normal = normalize(cross(east, north));
    let light = 0.15 + 0.85 * max(dot(normal, normalize(vec3f(0.6, 0.3, 0.6))), 0.0);
    let rock = mix(vec3f(0.25, 0.42, 0.16), vec3f(0.5, 0.46, 0.42), smoothstep(0.25, 0.6, vertex.world.z / HEIGHT));
    let colour = mix(rock, vec3f(0.95), smoothstep(0.7, 0.8, vertex.world.z / HEIGHT) * normal.z);
    let fog = 1.0 - exp(-0.012 * distance(vertex.world, frame.eye));
    return vec4f(mix(light * colour, vec3f(0.62, 0.72, 0.82), fog), 1.0);
}

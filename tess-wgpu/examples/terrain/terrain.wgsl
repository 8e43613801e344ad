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

// The place of a point of a patch. Whole numbers and 1/65536ths add up exactly, so both patches of an edge find the
// same place.
fn place(number: u32, uv: vec2f) -> vec2f {
    let cell = vec2f(f32(number % frame.grid), f32(number / frame.grid));
    return (cell + uv) / f32(frame.grid);
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
    let slope = vec2f(
        tess_sample(heights, at + vec2f(step, 0.0)) - tess_sample(heights, at - vec2f(step, 0.0)),
        tess_sample(heights, at + vec2f(0.0, step)) - tess_sample(heights, at - vec2f(0.0, step)),
    ) * HEIGHT / (2.0 * step * WIDTH);
    let normal = normalize(vec3f(-slope, 1.0));
    let light = 0.25 + 0.85 * max(dot(normal, normalize(vec3f(0.6, -0.5, 0.6))), 0.0);
    let high = smoothstep(0.55, 0.85, vertex.world.z / HEIGHT);
    let grass = mix(vec3f(0.20, 0.34, 0.16), vec3f(0.85, 0.86, 0.88), high);
    let colour = mix(vec3f(0.42, 0.38, 0.33), grass, smoothstep(0.75, 0.9, normal.z));
    let away = 1.0 - exp(-distance(frame.eye, vertex.world) / 70.0);
    return vec4f(mix(light * colour, vec3f(0.75, 0.82, 0.90), away), 1.0);
}

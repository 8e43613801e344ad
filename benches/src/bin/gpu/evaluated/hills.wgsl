// Hills of noise on a grid of patches, seen from above by up to four cameras. FACTOR, SIDE (patches along each side),
// OCTAVES and the members of `Vertex` with their VALUES are put in.

struct Vertex {
    @builtin(position) position: vec4f,
    MEMBERS
}

fn hash(at: vec2f) -> f32 {
    let p = fract(at * vec2f(0.1031, 0.1130));
    let q = p + dot(p, p.yx + 33.33);
    return fract((q.x + q.y) * q.x);
}

// A value from 0 to 1, and its slopes.
fn noise(at: vec2f) -> vec3f {
    let cell = floor(at);
    let t = at - cell;
    let s = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let slope = 30.0 * t * t * (t * (t - 2.0) + 1.0);
    let a = hash(cell);
    let b = hash(cell + vec2f(1.0, 0.0));
    let c = hash(cell + vec2f(0.0, 1.0));
    let d = hash(cell + vec2f(1.0, 1.0));
    let k = a - b - c + d;
    return vec3f(a + (b - a) * s.x + (c - a) * s.y + k * s.x * s.y,
        slope * (vec2f(b - a, c - a) + k * s.yx));
}

fn hull(number: u32) -> QuadFactors {
    return tess_quad_factors(vec4f(FACTOR));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let at = (vec2f(f32(number % SIDE), f32(number / SIDE)) + uv) / f32(SIDE);
    var height = vec3f();
    var scale = 4.0;
    for (var octave = 0; octave < OCTAVES; octave++) {
        height += noise(scale * at) * vec3f(1.0, scale, scale) / scale;
        scale *= 1.5;
    }
    let normal = normalize(vec3f(-height.yz, 4.0));
    return Vertex(vec4f(2.0 * at - 1.0, 0.3 * height.x, 1.0) VALUES);
}

fn seen(vertex: Vertex, by: f32) -> Vertex {
    let at = vertex.position;
    let turned = vec2f(at.x - by * at.z, at.y + by * at.x * at.z);
    var other = vertex;
    other.position = vec4f(turned, 0.1 + 0.5 * at.z, 1.0);
    return other;
}

fn camera_0(vertex: Vertex) -> Vertex {
    return seen(vertex, 0.1);
}

fn camera_1(vertex: Vertex) -> Vertex {
    return seen(vertex, 0.2);
}

fn camera_2(vertex: Vertex) -> Vertex {
    return seen(vertex, 0.3);
}

fn camera_3(vertex: Vertex) -> Vertex {
    return seen(vertex, 0.4);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    return vec4f(vec3f(max(dot(NORMAL, vec3f(0.6, 0.0, 0.8)), 0.0)), 1.0);
}

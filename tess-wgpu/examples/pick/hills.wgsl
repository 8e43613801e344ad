// 8 x 8 patches of hills, each 1 wide, and a red ring around the picked place.

struct Vertex {
    // In the world after `domain`, in clip space after `seen`.
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
    @location(1) @interpolate(flat, either) number: u32,
}

struct Frame {
    clip_from_world: mat4x4f,
    eye: vec4f,
    // From the eye through the picked pixel.
    direction: vec4f,
}

struct Picked {
    // The bits of the distance from the eye; all ones if nothing is hit.
    distance: u32,
    triangle: u32,
    corners: array<Vertex, 3>,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<storage, read> picked: Picked;

fn height(at: vec2f) -> f32 {
    let top = at - vec2f(4.0, 3.5);
    return 0.25 * sin(1.7 * at.x) * sin(1.9 * at.y) + 1.8 * exp(-1.5 * dot(top, top));
}

fn hull(number: u32) -> QuadFactors {
    return tess_quad_factors(vec4f(16.0));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let at = vec2f(f32(number % 8u), f32(number / 8u)) + uv;
    let world = vec3f(at, height(at));
    return Vertex(vec4f(world, 1.0), world, number);
}

fn seen(vertex: Vertex) -> Vertex {
    return Vertex(frame.clip_from_world * vertex.position, vertex.world, vertex.number);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    let at = vertex.world.xy;
    let here = height(at);
    let slope = vec2f(height(at + vec2f(0.01, 0.0)) - here, height(at + vec2f(0.0, 0.01)) - here) / 0.01;
    let light = 0.35 + 0.65 * max(dot(normalize(vec3f(-slope, 1.0)), vec3f(0.6, -0.48, 0.64)), 0.0);
    var colour = vec3f(0.55, 0.62, 0.40);
    if picked.distance != 0xffffffffu {
        let place = frame.eye.xyz + bitcast<f32>(picked.distance) * frame.direction.xyz;
        let away = distance(place, vertex.world);
        if away > 0.12 && away < 0.2 {
            colour = vec3f(0.9, 0.1, 0.1);
        } else if vertex.number == picked.corners[0].number {
            colour = vec3f(0.75, 0.80, 0.45);
        }
    }
    return vec4f(colour * light, 1.0);
}

// 8 x 8 patches of hills, each 1 wide, for two cameras and the sun.

struct Frame {
    // For the left camera, the right one, and the sun.
    clip_from_world: array<mat4x4f, 3>,
    toward_sun: vec4f,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var shadows: texture_depth_2d;
@group(1) @binding(1) var nearer: sampler_comparison;

struct Vertex {
    // In the world after `domain`, in clip space after `left`, `right` or `sun`. A prepass and its colours compute the
    // same bits, so that depths can be equal.
    @builtin(position) @invariant position: vec4f,
    @location(0) world: vec3f,
}

fn height(at: vec2f) -> f32 {
    let top = at - vec2f(4.0, 3.5);
    return 0.25 * sin(1.7 * at.x) * sin(1.9 * at.y) + 1.8 * exp(-1.5 * dot(top, top));
}

fn hull(number: u32) -> QuadFactors {
    let middle = vec3f(f32(number % 8u) + 0.5, f32(number / 8u) + 0.5, 1.0);
    // Culled only if no camera and no shadow map sees it: a patch outside a picture can cast a shadow into it.
    if tess_is_outside(frame.clip_from_world[0], middle, 1.8)
        && tess_is_outside(frame.clip_from_world[1], middle, 1.8)
        && tess_is_outside(frame.clip_from_world[2], middle, 1.8) {
        return QuadFactors();
    }
    return tess_quad_factors(vec4f(16.0));
}

fn domain(number: u32, uv: vec2f) -> Vertex {
    let at = vec2f(f32(number % 8u), f32(number / 8u)) + uv;
    let world = vec3f(at, height(at));
    return Vertex(vec4f(world, 1.0), world);
}

// The cameras and the sun: each pass calls one of these functions for every vertex.

fn left(vertex: Vertex) -> Vertex {
    return Vertex(frame.clip_from_world[0] * vertex.position, vertex.world);
}

fn right(vertex: Vertex) -> Vertex {
    return Vertex(frame.clip_from_world[1] * vertex.position, vertex.world);
}

fn sun(vertex: Vertex) -> Vertex {
    return Vertex(frame.clip_from_world[2] * vertex.position, vertex.world);
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    let at = vertex.world.xy;
    let here = height(at);
    let slope = vec2f(height(at + vec2f(0.01, 0.0)) - here, height(at + vec2f(0.0, 0.01)) - here) / 0.01;
    let toward = max(dot(normalize(vec3f(-slope, 1.0)), frame.toward_sun.xyz), 0.0);
    let of_sun = frame.clip_from_world[2] * vec4f(vertex.world, 1.0);
    let place = vec2f(0.5 + 0.5 * of_sun.x, 0.5 - 0.5 * of_sun.y);
    let lit = textureSampleCompareLevel(shadows, nearer, place, of_sun.z - 0.004);
    return vec4f(vec3f(0.55, 0.62, 0.40) * (0.3 + 0.7 * toward * lit), 1.0);
}

// Draws only depth, in a pass that has a colour target.
@fragment
fn nothing() -> @location(0) vec4f {
    return vec4f();
}

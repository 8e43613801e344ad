enable wgpu_ray_query;

// Hills in the sun. A ray through the traced scene decides whether a place is in shadow.

struct Vertex {
    // In the world after `domain`, where the acceleration structure reads it; in clip space after `seen`.
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
}

struct Frame {
    clip_from_world: mat4x4f,
    eye: vec4f,
    toward_sun: vec4f,
    // A pixel's ray: forward + x * right + y * up, with x and y from -1 to 1.
    forward: vec4f,
    right: vec4f,
    up: vec4f,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var scene: acceleration_structure;

fn height(at: vec2f) -> f32 {
    let top = at - vec2f(4.0, 3.5);
    return 0.25 * sin(1.7 * at.x) * sin(1.9 * at.y) + 1.8 * exp(-1.5 * dot(top, top));
}

fn is_lit(world: vec3f, normal: vec3f) -> bool {
    var ray: ray_query;
    let origin = world + 0.01 * normal;
    // Flag 4: the query ends at the first hit.
    rayQueryInitialize(&ray, scene, RayDesc(4u, 0xffu, 0.0, 100.0, origin, frame.toward_sun.xyz));
    rayQueryProceed(&ray);
    return rayQueryGetCommittedIntersection(&ray).kind == RAY_QUERY_INTERSECTION_NONE;
}

fn colour_of(world: vec3f) -> vec4f {
    let at = world.xy;
    let here = height(at);
    let slope = vec2f(height(at + vec2f(0.01, 0.0)) - here, height(at + vec2f(0.0, 0.01)) - here) / 0.01;
    let normal = normalize(vec3f(-slope, 1.0));
    let toward = max(dot(normal, frame.toward_sun.xyz), 0.0);
    var light = 0.3;
    if toward > 0.0 && is_lit(world, normal) {
        light += 0.7 * toward;
    }
    return vec4f(vec3f(0.55, 0.62, 0.40) * light, 1.0);
}

// Draws packed domain points as the shaded teapot. Needs bezier.wgsl and the function `material`.

const EYE = vec3f(3.2, -7.6, 5.0);
const TARGET = vec3f(0.3, 0.0, 1.45);
const ZOOM = 3.1;
const ASPECT = 1.333333;
const NEAR = 0.5;
const FAR = 100.0;

// For each patch, 16 control points (w x, w y, w z, w), in rows along v.
@group(0) @binding(0) var<storage, read> nets: array<array<vec4f, 16>>;

struct PatchPoint {
    patch_index: u32,
    u: f32,
    v: f32,
}

struct Vertex {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
}

fn unpack(packed: vec2u) -> PatchPoint {
    let u = f32(packed.x & 0x1ffffu) / 65536.0;
    let v = f32((packed.x >> 17u) | ((packed.y & 3u) << 15u)) / 65536.0;
    return PatchPoint(packed.y >> 2u, u, v);
}

fn teapot_position(at: PatchPoint) -> vec3f {
    return bezier_patch_position(nets[at.patch_index], at.u, at.v);
}

fn teapot_normal(at: PatchPoint) -> vec3f {
    return bezier_patch_normal(nets[at.patch_index], at.u, at.v);
}

// From world to clip space; z points up in the world.
fn project(world: vec3f) -> vec4f {
    let forward = normalize(TARGET - EYE);
    let right = normalize(cross(forward, vec3f(0.0, 0.0, 1.0)));
    let up = cross(right, forward);
    let seen = world - EYE;
    let depth = dot(seen, forward);
    let z = (depth - NEAR) * FAR / (FAR - NEAR);
    return vec4f(ZOOM / ASPECT * dot(seen, right), ZOOM * dot(seen, up), z, depth);
}

@vertex
fn place_vertex(@location(0) packed: vec2u) -> Vertex {
    let at = unpack(packed);
    let world = teapot_position(at);
    return Vertex(project(world), world, teapot_normal(at));
}

@fragment
fn shade(vertex: Vertex) -> @location(0) vec4f {
    let to_eye = normalize(EYE - vertex.world);
    var normal = normalize(vertex.normal);
    if dot(normal, to_eye) < 0.0 {
        normal = -normal; // the inside of the spout
    }
    let to_light = normalize(vec3f(0.6, -0.7, 1.1));
    let diffuse = 0.3 + 0.7 * max(dot(normal, to_light), 0.0);
    let shine = pow(max(dot(normal, normalize(to_light + to_eye)), 0.0), 60.0);
    return vec4f(diffuse * material() + 0.45 * shine, 1.0);
}

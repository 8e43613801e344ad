// Finds the nearest triangle on a ray, with a thread for each triangle of the stage's vertices and indices. The structs
// `Vertex` and `Frame` of hills.wgsl come before this text.

struct Nearest {
    distance: atomic<u32>,
    triangle: atomic<u32>,
    corners: array<Vertex, 3>,
}

// The arguments of the stage's draw.
struct Draw {
    indices: u32,
    instances: u32,
    first_index: u32,
    base_vertex: u32,
    first_instance: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(2) var<storage, read> indices: array<u32>;
@group(0) @binding(3) var<storage, read> draw: Draw;
@group(0) @binding(4) var<storage, read_write> nearest: Nearest;

const NOTHING = 0xffffffffu;

// The bits of the distance at which the ray hits a triangle. The bits of positive floats have the order of the floats.
fn hit(triangle: u32) -> u32 {
    if 3u * triangle >= draw.indices {
        return NOTHING;
    }
    let a = vertices[indices[3u * triangle]].world;
    let ab = vertices[indices[3u * triangle + 1u]].world - a;
    let ac = vertices[indices[3u * triangle + 2u]].world - a;
    let across = cross(frame.direction.xyz, ac);
    let area = dot(ab, across);
    let origin = frame.eye.xyz - a;
    let u = dot(origin, across) / area;
    let other = cross(origin, ab);
    let v = dot(frame.direction.xyz, other) / area;
    let distance = dot(ac, other) / area;
    let is_hit = abs(area) > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
    return select(NOTHING, bitcast<u32>(distance), is_hit);
}

fn number_of(id: vec3u, workgroups: vec3u) -> u32 {
    return id.x + id.y * 64u * workgroups.x;
}

@compute @workgroup_size(64)
fn find(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let distance = hit(number_of(id, workgroups));
    if distance != NOTHING {
        atomicMin(&nearest.distance, distance);
    }
}

// The least number of a triangle at that distance.
@compute @workgroup_size(64)
fn take(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let triangle = number_of(id, workgroups);
    let distance = hit(triangle);
    if distance != NOTHING && distance == atomicLoad(&nearest.distance) {
        atomicMin(&nearest.triangle, triangle);
    }
}

// The triangle's corners, as `domain` returned them.
@compute @workgroup_size(3)
fn copy_corners(@builtin(local_invocation_index) corner: u32) {
    let triangle = atomicLoad(&nearest.triangle);
    if triangle != NOTHING {
        nearest.corners[corner] = vertices[indices[3u * triangle + corner]];
    }
}

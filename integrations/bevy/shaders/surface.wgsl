// Functions for hull and domain functions. Everything about an edge is the same from both sides.

// The instance of each patch.
@group(TESS_GROUP) @binding(3) var<storage, read> tess_owners: array<u32>;
// The words of all shapes, one after another.
@group(TESS_GROUP) @binding(4) var<storage, read> tess_words: array<u32>;

// The values of all entities; each entity's values follow their number.
@group(TESS_GROUP) @binding(5) var<storage, read> tess_values: array<u32>;

// A patch of an entity.
struct TessPlace {
    instance: u32,
    // Counted from 0 in each entity.
    patch_number: u32,
    first_word: u32,
    first_value: u32,
    values: u32,
}

// The patch that the number of a hull or domain function means.
fn tess_place(number: u32) -> TessPlace {
    let instance = tess_owners[number];
    let first = tess_instances[instance].first_patch;
    let first_word = tess_instances[instance].first_word;
    let values = tess_instances[instance].first_value;
    return TessPlace(instance, number - first, first_word, values + 1u, tess_values[values]);
}

// A word of the shape.
fn tess_uint(at: TessPlace, word: u32) -> u32 {
    return tess_words[at.first_word + word];
}

fn tess_float(at: TessPlace, word: u32) -> f32 {
    return bitcast<f32>(tess_uint(at, word));
}

fn tess_vec3(at: TessPlace, word: u32) -> vec3<f32> {
    return vec3<f32>(tess_float(at, word), tess_float(at, word + 1u), tess_float(at, word + 2u));
}

// A value of the entity in this frame; 0 if it has fewer.
fn tess_value(at: TessPlace, n: u32) -> f32 {
    if n >= at.values {
        return 0.0;
    }
    return bitcast<f32>(tess_values[at.first_value + n]);
}

fn tess_to_world(at: TessPlace, local: vec3<f32>) -> vec3<f32> {
    return (tess_instances[at.instance].world_from_local * vec4<f32>(local, 1.0)).xyz;
}

// The factor of an edge between two places in world space, by the entity's level of detail. It is 0 if the camera does
// not see the entity.
fn tess_edge(at: TessPlace, a: vec3<f32>, b: vec3<f32>) -> f32 {
    let rule = tess_instances[at.instance].rule;
    let pixels = tess_camera.pixels_per_unit;
    switch u32(rule.x) {
        case 1u: {
            return tess_clamp_factor(rule.y);
        }
        case 2u: {
            if tess_camera.is_orthographic != 0u {
                return tess_quotient(distance(a, b) * pixels, rule.y);
            }
            return tess_edge_by_screen_size(a, b, tess_camera.eye, pixels, rule.y);
        }
        case 3u: {
            return tess_edge_by_distance(a, b, tess_camera.eye, rule.y);
        }
        default: {
            return 0.0;
        }
    }
}

// Whether the camera sees neither a ball in world space nor its shadow.
fn tess_is_unseen(center: vec3<f32>, radius: f32) -> bool {
    for (var i = 0u; i < 6u; i++) {
        if tess_is_behind(tess_camera.planes[i], center, radius) {
            return true;
        }
    }
    return false;
}

// A vertex, from position and normal in local space.
fn tess_vertex_of(
    at: TessPlace, local: vec3<f32>, normal: vec3<f32>, uv: vec2<f32>, color: vec4<f32>,
) -> Vertex {
    let world = tess_to_world(at, local);
    let turned = tess_instances[at.instance].normal_from_local * vec4<f32>(normal, 0.0);
    return Vertex(tess_project(world), world, normalize(turned.xyz), uv, color, at.instance);
}

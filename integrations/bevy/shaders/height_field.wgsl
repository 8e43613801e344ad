// A rectangle of patches over x and z, raised by heights. height_field.rs writes the words, and puts in the number of
// words before the heights (in `texel`).

struct Ground {
    texels: vec2<i32>,
    patches: vec2<u32>,
    size: vec3<f32>,
    lowest: f32,
    highest: f32,
}

fn ground(at: TessPlace) -> Ground {
    return Ground(
        vec2<i32>(i32(tess_uint(at, 0u)), i32(tess_uint(at, 1u))),
        vec2<u32>(tess_uint(at, 2u), tess_uint(at, 3u)),
        tess_vec3(at, 4u), tess_float(at, 7u), tess_float(at, 8u));
}

fn texel(at: TessPlace, texels: vec2<i32>, x: i32, z: i32) -> f32 {
    return tess_float(at, HEADER + u32(z * texels.x + x));
}

// The height at a place, 0 to 1 in each direction: HeightMap::height_at of tess-surface, clamped.
fn height(at: TessPlace, texels: vec2<i32>, place: vec2<f32>) -> f32 {
    let scaled = place * vec2<f32>(texels) - 0.5;
    let below = floor(scaled);
    let part = scaled - below;
    let last = texels - 1;
    let a = clamp(vec2<i32>(below), vec2<i32>(0), last);
    let b = clamp(vec2<i32>(below) + 1, vec2<i32>(0), last);
    return tess_bilinear(vec4<f32>(
        texel(at, texels, a.x, a.y), texel(at, texels, b.x, a.y),
        texel(at, texels, a.x, b.y), texel(at, texels, b.x, b.y)), part);
}

// Whole numbers and 1/65536ths add up exactly, so both patches of an edge find the same place.
fn place_of(at: TessPlace, patches: vec2<u32>, uv: vec2<f32>) -> vec2<f32> {
    let cell = vec2<f32>(f32(at.patch_number % patches.x), f32(at.patch_number / patches.x));
    return (cell + uv) / vec2<f32>(patches);
}

fn raised(size: vec3<f32>, place: vec2<f32>, height: f32) -> vec3<f32> {
    return vec3<f32>((place.x - 0.5) * size.x, height * size.y, (place.y - 0.5) * size.z);
}

fn corner(at: TessPlace, map: Ground, uv: vec2<f32>) -> vec3<f32> {
    let place = place_of(at, map.patches, uv);
    return tess_to_world(at, raised(map.size, place, height(at, map.texels, place)));
}

// Whether the camera sees neither the patch nor its shadow, whatever its heights are.
fn is_unseen(at: TessPlace, map: Ground) -> bool {
    let near = place_of(at, map.patches, vec2<f32>(0.0));
    let far = place_of(at, map.patches, vec2<f32>(1.0));
    let middle = 0.5 * (map.lowest + map.highest);
    let center = tess_to_world(at, raised(map.size, 0.5 * (near + far), middle));
    var radius = 0.0;
    for (var i = 0u; i < 8u; i++) {
        let place = vec2<f32>(select(near.x, far.x, (i & 1u) != 0u), select(near.y, far.y, (i & 2u) != 0u));
        let high = select(map.lowest, map.highest, (i & 4u) != 0u);
        radius = max(radius, distance(center, tess_to_world(at, raised(map.size, place, high))));
    }
    return tess_is_unseen(center, radius);
}

fn hull(number: u32) -> QuadFactors {
    let at = tess_place(number);
    let map = ground(at);
    if is_unseen(at, map) {
        return QuadFactors();
    }
    let a = corner(at, map, vec2<f32>(0.0, 0.0));
    let b = corner(at, map, vec2<f32>(1.0, 0.0));
    let c = corner(at, map, vec2<f32>(1.0, 1.0));
    let d = corner(at, map, vec2<f32>(0.0, 1.0));
    return tess_quad_factors(vec4<f32>(
        tess_edge(at, a, d), tess_edge(at, a, b), tess_edge(at, b, c), tess_edge(at, d, c)));
}

// The normal, from the heights one texel away on each side.
fn slope(at: TessPlace, map: Ground, place: vec2<f32>) -> vec3<f32> {
    let step = 1.0 / vec2<f32>(map.texels);
    let along_x = height(at, map.texels, place + vec2<f32>(step.x, 0.0))
        - height(at, map.texels, place - vec2<f32>(step.x, 0.0));
    let along_z = height(at, map.texels, place + vec2<f32>(0.0, step.y))
        - height(at, map.texels, place - vec2<f32>(0.0, step.y));
    let rise = vec2<f32>(along_x, along_z) * map.size.y / (2.0 * step * map.size.xz);
    return normalize(vec3<f32>(-rise.x, 1.0, -rise.y));
}

// Low, high and steep ground differ in colour.
fn tint(at: TessPlace, map: Ground, high: f32, upward: f32) -> vec4<f32> {
    let part = (high - map.lowest) / max(map.highest - map.lowest, 1e-20);
    let flat_color = mix(tess_vec3(at, 9u), tess_vec3(at, 12u), smoothstep(0.55, 0.85, part));
    return vec4<f32>(mix(tess_vec3(at, 15u), flat_color, smoothstep(0.75, 0.9, upward)), 1.0);
}

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    let at = tess_place(number);
    let map = ground(at);
    let place = place_of(at, map.patches, uv);
    let high = height(at, map.texels, place);
    let normal = slope(at, map, place);
    let color = tint(at, map, high, normal.y);
    return tess_vertex_of(at, raised(map.size, place, high), normal, place, color);
}

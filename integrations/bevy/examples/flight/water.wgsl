// A level of water with waves. The word is its size, the value the time in seconds.

const PATCHES = 16u;

// A place in local space. Whole numbers and 1/65536ths add up exactly, so both patches of an edge find the same one.
fn place(at: TessPlace, uv: vec2<f32>) -> vec2<f32> {
    let cell = vec2<f32>(f32(at.patch_number % PATCHES), f32(at.patch_number / PATCHES));
    return ((cell + uv) / f32(PATCHES) - 0.5) * tess_float(at, 0u);
}

// A wave's height there and its derivatives: `wave` is its direction, its height and its speed.
fn one(wave: vec4<f32>, at: TessPlace, place: vec2<f32>) -> vec3<f32> {
    let phase = dot(wave.xy, place) + wave.w * tess_value(at, 0u);
    return wave.z * vec3<f32>(sin(phase), wave.xy * cos(phase));
}

fn corner(at: TessPlace, u: f32, v: f32) -> vec3<f32> {
    let place = place(at, vec2<f32>(u, v));
    return tess_to_world(at, vec3<f32>(place.x, 0.0, place.y));
}

fn hull(number: u32) -> QuadFactors {
    let at = tess_place(number);
    let a = corner(at, 0.0, 0.0);
    let b = corner(at, 1.0, 0.0);
    let c = corner(at, 1.0, 1.0);
    let d = corner(at, 0.0, 1.0);
    return tess_quad_factors(vec4<f32>(
        tess_edge(at, a, d), tess_edge(at, a, b), tess_edge(at, b, c), tess_edge(at, d, c)));
}

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    let at = tess_place(number);
    let place = place(at, uv);
    let wave = one(vec4<f32>(1.1, 0.6, 0.05, 1.4), at, place)
        + one(vec4<f32>(-0.5, 1.7, 0.04, 1.9), at, place)
        + one(vec4<f32>(2.3, -1.9, 0.02, 2.6), at, place);
    let normal = normalize(vec3<f32>(-wave.y, 1.0, -wave.z));
    return tess_vertex_of(
        at, vec3<f32>(place.x, wave.x, place.y), normal, uv, vec4<f32>(1.0));
}

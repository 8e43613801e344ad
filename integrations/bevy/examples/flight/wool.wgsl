// A rounded mesh, displaced along its normals and moved by a joint: wool. The values are the joint's matrix, three rows.

const STEP = 0.001;

// It depends only on the place, so that edges stay closed.
fn wool(at: vec3<f32>) -> f32 {
    let p = 27.0 * at;
    return 0.014 * (sin(p.x) * sin(p.y + 0.7 * sin(p.z)) + 0.6 * sin(1.7 * p.z + p.x) * cos(1.9 * p.y));
}

// The head moves with the joint, the body stays; w is 0 for directions. The weight, too, depends only on the place at
// rest.
fn skinned(at: TessPlace, rest: vec3<f32>, v: vec4<f32>) -> vec3<f32> {
    var moved: vec3<f32>;
    for (var row = 0u; row < 3u; row++) {
        moved[row] = dot(v, vec4<f32>(
            tess_value(at, 4u * row), tess_value(at, 4u * row + 1u),
            tess_value(at, 4u * row + 2u), tess_value(at, 4u * row + 3u)));
    }
    return mix(v.xyz, moved, smoothstep(1.5, 2.1, rest.z));
}

fn hull(number: u32) -> TriFactors {
    return pn_factors(number);
}

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    let at = tess_place(number);
    let point = pn_point(at, uv);
    let high = wool(point.position);
    let rise = vec3<f32>(
        wool(point.position + vec3<f32>(STEP, 0.0, 0.0)) - high,
        wool(point.position + vec3<f32>(0.0, STEP, 0.0)) - high,
        wool(point.position + vec3<f32>(0.0, 0.0, STEP)) - high) / STEP;
    let bent = point.normal - (rise - dot(rise, point.normal) * point.normal);
    let brown = vec3<f32>(0.55, 0.24, 0.09);
    let cream = vec3<f32>(0.89, 0.69, 0.45);
    let color = mix(brown, cream, smoothstep(1.9, 2.3, point.position.z));
    let position = skinned(at, point.position, vec4<f32>(point.position + high * point.normal, 1.0));
    let normal = normalize(skinned(at, point.position, vec4<f32>(bent, 0.0)));
    return tess_vertex_of(at, position, normal, uv, vec4<f32>(color, 1.0));
}

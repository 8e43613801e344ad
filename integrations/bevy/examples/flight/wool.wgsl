// A rounded mesh, displaced along its normals: wool.

const STEP = 0.001;

// It depends on the place alone, so that edges stay closed.
fn wool(at: vec3<f32>) -> f32 {
    let p = 27.0 * at;
    return 0.014 * (sin(p.x) * sin(p.y + 0.7 * sin(p.z)) + 0.6 * sin(1.7 * p.z + p.x) * cos(1.9 * p.y));
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
    return tess_vertex_of(
        at, point.position + high * point.normal, normalize(bent), uv, vec4<f32>(color, 1.0));
}

// Cubic curves and bicubic patches in homogeneous coordinates, (w x, w y, w z, w), w > 0.
// The formulas of curve.rs and bezier.rs.

struct CurvePoint {
    value: vec4f,
    derivative: vec4f,
}

struct SurfacePoint {
    position: vec3f,
    du: vec3f,
    dv: vec3f,
}

// a + (b - a) t: exact at t = 0 and where a equals b.
fn bezier_lerp(a: vec4f, b: vec4f, t: f32) -> vec4f {
    return a + (b - a) * t;
}

fn bezier_project(point: vec4f) -> vec3f {
    return point.xyz / point.w;
}

// Point and derivative of a cubic at t in 0..1, by repeated interpolation.
fn bezier_curve(points: array<vec4f, 4>, t: f32) -> CurvePoint {
    let ab = bezier_lerp(points[0], points[1], t);
    let bc = bezier_lerp(points[1], points[2], t);
    let cd = bezier_lerp(points[2], points[3], t);
    let value = bezier_lerp(bezier_lerp(ab, bc, t), bezier_lerp(bc, cd, t), t);
    let d0 = points[1] - points[0];
    let d1 = points[2] - points[1];
    let d2 = points[3] - points[2];
    let derivative = 3.0 * bezier_lerp(bezier_lerp(d0, d1, t), bezier_lerp(d1, d2, t), t);
    return CurvePoint(value, derivative);
}

// -1, 0 or 1 as a sorts before b, equals it, or sorts after it.
fn bezier_compare(a: vec4f, b: vec4f) -> i32 {
    for (var i = 0u; i < 4u; i++) {
        if a[i] < b[i] {
            return -1;
        }
        if a[i] > b[i] {
            return 1;
        }
    }
    return 0;
}

// Above 0 if a curve must be reversed to run in canonical direction, 0 if it is the same both ways.
fn bezier_direction(points: array<vec4f, 4>) -> i32 {
    let outer = bezier_compare(points[0], points[3]);
    return select(outer, bezier_compare(points[1], points[2]), outer == 0);
}

fn bezier_is_reversed(points: array<vec4f, 4>) -> bool {
    return bezier_direction(points) > 0;
}

// Whether all control points are one and the same point, whatever their weights.
fn bezier_is_collapsed(points: array<vec4f, 4>) -> bool {
    let a = bezier_project(points[0]);
    return all(a == bezier_project(points[1])) && all(a == bezier_project(points[2]))
        && all(a == bezier_project(points[3]));
}

// A point of an edge at the patch's own t, the same from both sides of the edge: evaluated in canonical direction, the
// ends being control points. An edge that runs back on itself is folded in its middle, a collapsed one is its point.
fn bezier_edge(points: array<vec4f, 4>, t: f32) -> vec3f {
    if bezier_is_collapsed(points) {
        return bezier_project(points[0]);
    }
    var curve = points;
    var s = t;
    let direction = bezier_direction(points);
    if direction > 0 {
        curve = array<vec4f, 4>(points[3], points[2], points[1], points[0]);
        s = 1.0 - t;
    } else if direction == 0 {
        s = min(t, 1.0 - t);
    }
    if s <= 0.0 {
        return bezier_project(curve[0]);
    }
    if s >= 1.0 {
        return bezier_project(curve[3]);
    }
    return bezier_project(bezier_curve(curve, s).value);
}

fn bezier_quotient(derivative: vec4f, s: vec4f, position: vec3f) -> vec3f {
    return (derivative.xyz - position * derivative.w) / s.w;
}

// Position and partial derivatives inside a patch; net[4 * row + column], rows along v.
fn bezier_patch(net: array<vec4f, 16>, u: f32, v: f32) -> SurfacePoint {
    var points: array<vec4f, 4>;
    var slopes: array<vec4f, 4>;
    var all = net;
    for (var row = 0u; row < 4u; row++) {
        let line = array<vec4f, 4>(all[4u * row], all[4u * row + 1u], all[4u * row + 2u], all[4u * row + 3u]);
        let at = bezier_curve(line, u);
        points[row] = at.value;
        slopes[row] = at.derivative;
    }
    let along_v = bezier_curve(points, v);
    let along_u = bezier_curve(slopes, v);
    let position = bezier_project(along_v.value);
    return SurfacePoint(
        position,
        bezier_quotient(along_u.value, along_v.value, position),
        bezier_quotient(along_v.derivative, along_v.value, position),
    );
}

// Position of a patch at any domain point: on its edges as bezier_edge gives it.
fn bezier_patch_position(net: array<vec4f, 16>, u: f32, v: f32) -> vec3f {
    if u <= 0.0 {
        return bezier_edge(array<vec4f, 4>(net[0], net[4], net[8], net[12]), v);
    }
    if u >= 1.0 {
        return bezier_edge(array<vec4f, 4>(net[3], net[7], net[11], net[15]), v);
    }
    if v <= 0.0 {
        return bezier_edge(array<vec4f, 4>(net[0], net[1], net[2], net[3]), u);
    }
    if v >= 1.0 {
        return bezier_edge(array<vec4f, 4>(net[12], net[13], net[14], net[15]), u);
    }
    return bezier_patch(net, u, v).position;
}

// Unit normal of a patch. Where the derivatives do not span a plane, that of a point 1/1024 of the way to the middle. On
// the collapsed edges of the teapot it is less than 0.03 degrees off the limit, which bezier.rs derives.
fn bezier_patch_normal(net: array<vec4f, 16>, u: f32, v: f32) -> vec3f {
    let at = bezier_patch(net, u, v);
    var normal = cross(at.du, at.dv);
    if dot(normal, normal) <= 1e-9 * dot(at.du, at.du) * dot(at.dv, at.dv) {
        let inside = bezier_patch(net, mix(u, 0.5, 1.0 / 1024.0), mix(v, 0.5, 1.0 / 1024.0));
        normal = cross(inside.du, inside.dv);
    }
    return normalize(normal);
}

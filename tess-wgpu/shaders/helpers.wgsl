// What hull and domain functions can call. Everything about an edge depends on its two ends alone and is the
// same, to the bit, in whichever order they are given, so that both patches of an edge agree.

// --- Factors of edges ---

// So many pixels for each segment of the edge a-b, wherever it turns: `pixels_per_unit` is how many pixels a
// length of 1 at distance 1 has: height / (2 * tan(field of view / 2)).
fn tess_edge_by_screen_size(
    a: vec3<f32>, b: vec3<f32>, eye: vec3<f32>, pixels_per_unit: f32, segment: f32,
) -> f32 {
    let away = max(distance(eye, (a + b) * 0.5), 1e-6);
    return tess_in_range(distance(a, b) * pixels_per_unit / (away * segment));
}

// `scale` at distance 1, less in proportion to the distance of the edge's middle.
fn tess_edge_by_distance(a: vec3<f32>, b: vec3<f32>, eye: vec3<f32>, scale: f32) -> f32 {
    return tess_in_range(scale / max(distance(eye, (a + b) * 0.5), 1e-6));
}

// Segments that stay within `tolerance` of the curve that a PN triangle or quad has between two corners with
// these unit normals.
fn tess_edge_by_curvature(
    a: vec3<f32>, normal_a: vec3<f32>, b: vec3<f32>, normal_b: vec3<f32>, tolerance: f32,
) -> f32 {
    let near_a = (2.0 * a + b - normal_a * dot(b - a, normal_a)) / 3.0;
    let near_b = (2.0 * b + a - normal_b * dot(a - b, normal_b)) / 3.0;
    // Six times these are the curve's second derivatives at its ends; between them they are mixed. The sums
    // in front are those of the other direction with their terms exchanged.
    let bend = max(length((a + near_b) - 2.0 * near_a), length((near_a + b) - 2.0 * near_b));
    return tess_in_range(sqrt(0.75 * bend / tolerance));
}

// 1 to 64; 1 for what is no number.
fn tess_in_range(factor: f32) -> f32 {
    if factor > 1.0 {
        return min(factor, 64.0);
    }
    return 1.0;
}

// --- Factors of patches ---

// Edges along u = 0, v = 0, u = 1, v = 1; each inside factor is the mean of the edges that run its way.
fn tess_quad_factors(edges: vec4<f32>) -> QuadFactors {
    return QuadFactors(edges, 0.5 * vec2<f32>(edges.y + edges.w, edges.x + edges.z));
}

// Edges along u = 0, v = 0, w = 0; the inside factor is their mean.
fn tess_tri_factors(edges: vec3<f32>) -> TriFactors {
    return TriFactors(edges, (edges.x + edges.y + edges.z) / 3.0);
}

// --- Culling: return `QuadFactors()` or `TriFactors()` for a patch that nobody sees ---

// Whether a ball is outside what a projection shows, z from 0 to w. The ball holds all of the patch, its
// displacement too.
fn tess_is_outside(clip_from_world: mat4x4<f32>, center: vec3<f32>, radius: f32) -> bool {
    let rows = transpose(clip_from_world);
    return tess_is_behind(rows[3] + rows[0], center, radius)
        || tess_is_behind(rows[3] - rows[0], center, radius)
        || tess_is_behind(rows[3] + rows[1], center, radius)
        || tess_is_behind(rows[3] - rows[1], center, radius)
        || tess_is_behind(rows[2], center, radius)
        || tess_is_behind(rows[3] - rows[2], center, radius);
}

// Whether a ball is wholly on the negative side of a plane.
fn tess_is_behind(plane: vec4<f32>, center: vec3<f32>, radius: f32) -> bool {
    return dot(plane.xyz, center) + plane.w < -radius * length(plane.xyz);
}

// Whether all of a surface turns its back to the eye: it lies in a ball, and its normals are within an angle
// around `axis`, a unit vector, whose sine this is. An angle of 90 degrees or more never does.
fn tess_faces_away(
    center: vec3<f32>, radius: f32, axis: vec3<f32>, sine: f32, eye: vec3<f32>,
) -> bool {
    let seen = center - eye;
    return dot(seen, axis) > sine * length(seen) + radius;
}

// --- Points on patches that agree along edges ---
// They serve positions, texture coordinates and everything that corners have; unused parts may be 0.

// Whether a comes before b, in an order that is the same whoever asks.
fn tess_is_before(a: vec4<f32>, b: vec4<f32>) -> bool {
    for (var i = 0u; i < 4u; i++) {
        if a[i] != b[i] {
            return a[i] < b[i];
        }
    }
    return false;
}

// A point between two corners, t from 0 at a to 1 at b; tess_along(a, b, t) is tess_along(b, a, 1 - t).
// At its ends it is the corner itself.
fn tess_along(a: vec4<f32>, b: vec4<f32>, t: f32) -> vec4<f32> {
    if t <= 0.0 {
        return a;
    }
    if t >= 1.0 {
        return b;
    }
    if tess_is_before(b, a) {
        return b + (a - b) * (1.0 - t);
    }
    return a + (b - a) * t;
}

// A point of a bilinear quad; corners at (0,0), (1,0), (1,1), (0,1).
fn tess_on_quad(corners: array<vec4<f32>, 4>, uv: vec2<f32>) -> vec4<f32> {
    if uv.x <= 0.0 {
        return tess_along(corners[0], corners[3], uv.y);
    }
    if uv.x >= 1.0 {
        return tess_along(corners[1], corners[2], uv.y);
    }
    if uv.y <= 0.0 {
        return tess_along(corners[0], corners[1], uv.x);
    }
    if uv.y >= 1.0 {
        return tess_along(corners[3], corners[2], uv.x);
    }
    return mix(mix(corners[0], corners[1], uv.x), mix(corners[3], corners[2], uv.x), uv.y);
}

// A point of a flat triangle; corners at u = 1, v = 1, w = 1.
fn tess_on_triangle(corners: array<vec4<f32>, 3>, uv: vec2<f32>) -> vec4<f32> {
    let w = 1.0 - uv.x - uv.y;
    if uv.x <= 0.0 {
        return tess_along(corners[2], corners[1], uv.y);
    }
    if uv.y <= 0.0 {
        return tess_along(corners[2], corners[0], uv.x);
    }
    if w <= 0.0 {
        return tess_along(corners[1], corners[0], uv.x);
    }
    return corners[0] * uv.x + corners[1] * uv.y + corners[2] * w;
}

// The first channel of a texture at `at`, 0 to 1, mixed from its four nearest texels, the outermost ones
// repeated. The same `at` gives the same bits in every shader: nothing depends on the device's samplers.
fn tess_sample(map: texture_2d<f32>, at: vec2<f32>) -> f32 {
    let size = vec2<i32>(textureDimensions(map));
    // In 1/256 texels, so that the mixing is exact for texels of up to 8 bits.
    let place = vec2<i32>(round((at * vec2<f32>(size) - 0.5) * 256.0));
    let low = place >> vec2<u32>(8u);
    let part = vec2<f32>(place - (low << vec2<u32>(8u))) / 256.0;
    let last = size - 1;
    let a = clamp(low, vec2<i32>(0), last);
    let b = clamp(low + 1, vec2<i32>(0), last);
    let above = mix(textureLoad(map, a, 0).x, textureLoad(map, vec2<i32>(b.x, a.y), 0).x, part.x);
    let below = mix(textureLoad(map, vec2<i32>(a.x, b.y), 0).x, textureLoad(map, b, 0).x, part.x);
    return mix(above, below, part.y);
}

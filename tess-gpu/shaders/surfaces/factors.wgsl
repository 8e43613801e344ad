// Factor rules, with the formulas of factors.rs. A rule depends only on data that both patches of an edge share, and
// gives the same bits whichever end comes first. Both patches therefore get the same factor, and no crack opens.
// Needs pn_edge.wgsl.

// The factor clamped to 1 to 64; 1 for NaN.
fn tess_clamp_factor(factor: f32) -> f32 {
    if factor > 1.0 {
        return min(factor, 64.0);
    }
    return 1.0;
}

// dividend / divisor within 1 to 64, also for a divisor of 0. The result is 1 unless both are numbers and
// dividend > divisor >= 0. WGSL does not define the result of a division that overflows, so such divisions are avoided.
fn tess_quotient(dividend: f32, divisor: f32) -> f32 {
    if !(dividend > divisor && divisor >= 0.0) {
        return 1.0;
    }
    if dividend * 0.015625 >= divisor { // 1/64
        return 64.0;
    }
    return tess_clamp_factor(dividend / divisor);
}

// The square root of dividend / divisor within 1 to 64, with the exceptions of tess_quotient.
fn tess_root_quotient(dividend: f32, divisor: f32) -> f32 {
    if !(dividend > divisor && divisor >= 0.0) {
        return 1.0;
    }
    if dividend * 0.000244140625 >= divisor { // 1/4096
        return 64.0;
    }
    return tess_clamp_factor(sqrt(dividend / divisor));
}

// The smallest power of two that is at least `factor`, which is from 1 to 64.
fn tess_power_of_two(factor: f32) -> f32 {
    var power = 1.0;
    while power < factor {
        power *= 2.0;
    }
    return power;
}

// --- Edges ---

// A factor for segments of `segment` pixels, in whichever direction the edge from a to b points. `pixels_per_unit` is
// the number of pixels that a length of 1 covers at distance 1: height / (2 * tan(field of view / 2)).
fn tess_edge_by_screen_size(
    a: vec3<f32>, b: vec3<f32>, eye: vec3<f32>, pixels_per_unit: f32, segment: f32,
) -> f32 {
    return tess_quotient(distance(a, b) * pixels_per_unit, distance(eye, (a + b) * 0.5) * segment);
}

// A factor for segments of `segment` pixels under a camera without perspective: a length of 1 covers
// `pixels_per_unit` pixels at any distance.
fn tess_edge_by_length(a: vec3<f32>, b: vec3<f32>, pixels_per_unit: f32, segment: f32) -> f32 {
    return tess_quotient(pixels_per_unit * distance(a, b), segment);
}

// `scale` divided by the distance from the eye to the edge's middle.
fn tess_edge_by_distance(a: vec3<f32>, b: vec3<f32>, eye: vec3<f32>, scale: f32) -> f32 {
    return tess_quotient(scale, distance(eye, (a + b) * 0.5));
}

// A factor that keeps segments within `tolerance` of the cubic that a point-normal triangle or quad has between two
// corners with these unit normals.
fn tess_edge_by_curvature(
    a: vec3<f32>, normal_a: vec3<f32>, b: vec3<f32>, normal_b: vec3<f32>, tolerance: f32,
) -> f32 {
    let near_a = tess_pn_edge_point(a, normal_a, b);
    let near_b = tess_pn_edge_point(b, normal_b, a);
    // The cubic's second derivative is 6 times these at its ends, and linear between. A chord over 1/n of a curve
    // with second derivative M is within M / (8 n^2) of it.
    let bend = max(length((a + near_b) - 2.0 * near_a), length((near_a + b) - 2.0 * near_b));
    return tess_root_quotient(0.75 * bend, tolerance);
}

// A factor, a power of two, that keeps segments within `tolerance` of a surface whose bend along the edge is at most
// `bend` in both patches (bend.rs has the bounds).
fn tess_edge_by_flatness(bend: f32, tolerance: f32) -> f32 {
    return tess_power_of_two(tess_root_quotient(bend, 4.0 * tolerance));
}

// The factors of an edge next to two edges of half its length, from the factor that a rule gives the whole edge. The
// whole edge gets a power of two from 2 to 64, at least the rule's factor; each half gets half of it. Both sides then
// have the same points under integer and power-of-two partitioning. Neighbours must compute both factors from the whole
// edge.
fn tess_edge_beside_halves(factor: f32) -> vec2<f32> {
    let whole = max(tess_power_of_two(tess_clamp_factor(factor)), 2.0);
    return vec2<f32>(whole, 0.5 * whole);
}

// A factor of at most `most`, like HLSL's `maxtessfactor`. A factor that culls still culls if `most` is positive.
fn tess_at_most(factor: f32, most: f32) -> f32 {
    return select(factor, most, factor > most);
}

// --- Insides ---
// Each is a mean, as in the Direct3D 11 samples and HLSL's ProcessQuadTessFactorsAvg.

// The inside factors along u and v of a quad with these factors on its edges u = 0, v = 0, u = 1, v = 1: the mean of
// the two edges that run the same way.
fn tess_inside_quad(edges: vec4<f32>) -> vec2<f32> {
    return 0.5 * vec2<f32>(edges.y + edges.w, edges.x + edges.z);
}

// The inside factor of a triangle: the mean of its edges, exact if they are equal.
fn tess_inside_triangle(edges: vec3<f32>) -> f32 {
    return edges.x + ((edges.y - edges.x) + (edges.z - edges.x)) / 3.0;
}

// Stitches between two rows of vertices (spec sections 7.2 and 7.3), and the triangles inside the
// innermost ring (7.4): the n-th triangle from closed forms, clockwise or counter-clockwise.
//
// A stitch is three words:
// x: index of the outer row's first vertex; of a centre, of the innermost ring's first
// y: points on the outer row in bits 0..6, on the inner 7..13, the entry that closes the outer
//    ring 14..20, the inner 21..27 (127: none does), kind 28..29, 30 set if the inner row descends
// z: from the outer row's first vertex to the inner's in bits 0..9, vertices of the outer ring
//    10..18, of the inner 19..27

const KIND_SEQUENCE = 0u;
const KIND_TRANSITION = 1u;
const KIND_RING = 2u;
const KIND_CENTRE = 3u;

const CLOSES_NOTHING = 127u;

// A centre has the number of its quads in place of the outer points, and this in place of the inner.
const CENTRE_TRIANGLE = 0u;
const CENTRE_ALONG_U = 1u;
const CENTRE_ALONG_V = 2u;
const CENTRE_ALONG_V_MIRRORED = 3u;
const CENTRE_MINIMUM_QUAD = 4u;

// One step of a stitch: it advances along one row, from vertex `outer` or `inner` of the two rows
// that it stands on. In `is_rotated` steps the triangle begins with the vertex across.
struct Step {
    advances_outer: bool,
    is_rotated: bool,
    outer: u32,
    inner: u32,
}

// Of a ring stitch, whose diagonals are mirrored about the middle.
fn ring_step(inner_points: u32, step: u32) -> Step {
    let second_half = select(0u, 1u, step > (inner_points & 126u));
    let advances_outer = (step & 1u) == second_half;
    let is_last = step == 2u * inner_points - 1u;
    return Step(
        advances_outer,
        advances_outer == (second_half == 1u) && !is_last,
        (step + 1u + second_half) >> 1u,
        (step - second_half) >> 1u,
    );
}

// Of the transition between an outer edge and ring 1: its first half merges two half edges in
// split order, which a table has as bits (set: advance outer); its second half is the mirror image.
fn transition_step(outer_points: u32, inner_points: u32, step: u32) -> Step {
    let outer_half = (outer_points - 1u) >> 1u;
    let inner_half = (inner_points + 1u) >> 1u;
    let half = outer_half + inner_half - 1u;
    let mirror = outer_points + inner_points - 3u - step;
    let is_second = step > mirror;
    let near = min(step, mirror);
    if near >= half {
        return middle_step(outer_half, inner_half - 1u, inner_points, step - half);
    }
    let at = STEPS_AT + 2u * (33u * outer_half + inner_half);
    let low = tables[at];
    let high = tables[at + 1u];
    let below = (1u << (near & 31u)) - 1u;
    let is_high = near >= 32u;
    let advances_outer = ((select(low, high, is_high) >> (near & 31u)) & 1u) == 1u;
    let outer = select(
        countOneBits(low & below), countOneBits(low) + countOneBits(high & below), is_high);
    let inner = near - outer;
    let advance = select(0u, 1u, advances_outer);
    return Step(
        advances_outer,
        false,
        select(outer, outer_points - 1u - outer - advance, is_second),
        select(inner, inner_points - 2u - inner + advance, is_second),
    );
}

// Where an odd side's segment lies across the middle.
fn middle_step(outer: u32, inner: u32, inner_points: u32, step: u32) -> Step {
    let inside_is_odd = (inner_points & 1u) == 0u;
    if inside_is_odd && step == 0u {
        return Step(false, false, outer, inner);
    }
    return Step(true, true, outer, inner + select(0u, 1u, inside_is_odd));
}

fn wound(a: u32, b: u32, c: u32, is_swapped: bool) -> vec3<u32> {
    let swaps = is_swapped != (OUTPUT == OUTPUT_TRIANGLE_CCW);
    return vec3<u32>(a, select(b, c, swaps), select(c, b, swaps));
}

// Triangle `step` of a stitch.
fn stitch_triangle(stitch: vec3<u32>, step: u32) -> vec3<u32> {
    let kind = (stitch.y >> 28u) & 3u;
    if kind == KIND_CENTRE {
        return centre_triangle(stitch, step);
    }
    let outer_points = stitch.y & 127u;
    let inner_points = (stitch.y >> 7u) & 127u;
    var at: Step;
    if kind == KIND_RING {
        at = ring_step(inner_points, step);
    } else {
        at = transition_step(outer_points, inner_points, step);
    }
    return step_triangle(stitch, at);
}

// Rows run from a to b on the side that advances, c lies across: outer steps are (a, b, c),
// inner ones (a, c, b), and rotated ones begin with c. Only b and c can close their ring.
fn step_triangle(stitch: vec3<u32>, at: Step) -> vec3<u32> {
    let inner_first = stitch.x + (stitch.z & 1023u);
    let inner_sign = 1u - ((stitch.y >> 29u) & 2u); // 1, or -1 modulo 2^32
    let a = select(
        inner_first + inner_sign * at.inner, stitch.x + at.outer, at.advances_outer);
    let outer = at.outer + select(0u, 1u, at.advances_outer);
    let inner = at.inner + select(1u, 0u, at.advances_outer);
    let outer_perimeter = (stitch.z >> 10u) & 511u;
    let inner_perimeter = stitch.z >> 19u;
    let outer_vertex = stitch.x + outer
        - select(0u, outer_perimeter, outer == ((stitch.y >> 14u) & 127u));
    let inner_vertex = inner_first + inner_sign * inner
        - select(0u, inner_perimeter, inner == ((stitch.y >> 21u) & 127u));
    let b = select(inner_vertex, outer_vertex, at.advances_outer);
    let c = select(outer_vertex, inner_vertex, at.advances_outer);
    return wound(
        select(a, c, at.is_rotated),
        select(b, a, at.is_rotated),
        select(c, b, at.is_rotated),
        !at.advances_outer,
    );
}

// A strip of quads, each two triangles, between two sides of the innermost ring; or what small
// patches have instead.
fn centre_triangle(stitch: vec3<u32>, step: u32) -> vec3<u32> {
    let first = stitch.x;
    let form = (stitch.y >> 7u) & 127u;
    if form == CENTRE_TRIANGLE {
        return wound(first, first + 1u, first + 2u, false);
    }
    if form == CENTRE_MINIMUM_QUAD {
        return wound(first + step, first + 1u + step, first + 3u, false);
    }
    let quads = stitch.y & 127u;
    let k = step >> 1u;
    let is_first = (step & 1u) == 0u;
    let is_along_u = form == CENTRE_ALONG_U;
    let a = first + k + select(0u, 1u, is_along_u);
    let b_end = first + 2u * quads + select(1u, 2u, is_along_u);
    let b = select(b_end - k, first, is_along_u && k == 0u);
    let b_next = b_end - 1u - k;
    if form == CENTRE_ALONG_V_MIRRORED {
        if k == quads >> 1u {
            return wound(a, select(a + 1u, b_next, is_first), select(b_next, b, is_first), false);
        }
        return wound(select(b, a, is_first), a + 1u, select(b_next, b, is_first), false);
    }
    return wound(b, select(a + 1u, a, is_first), select(b_next, a + 1u, is_first), false);
}

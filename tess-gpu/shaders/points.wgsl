// The domain points of a patch as runs (spec section 6): along each run one coordinate is placed
// point by point while the other is constant. Runs are numbered in output order: lines of an
// isoline patch; outer edges, then the edges of each interior ring, then the centre.

// How a run's two numbers become a point: `fixed` is its constant, `q` the placed location.
const FORM_FIXED_Q = 0u;
const FORM_Q_FIXED = 1u;
const FORM_Q_REST = 2u; // the third coordinate of the triangle is the constant one
const FORM_CORNER = 3u; // corner by number; with a constant that is not 0, the constant twice

fn point_runs(topology: vec2<u32>) -> u32 {
    let state = state_of(topology);
    if state == CULLED {
        return 0u;
    }
    if DOMAIN == ISOLINE {
        return outer_points(topology, 0u) - 1u;
    }
    return select(EDGES * point_ring_end(topology) + 1u, 1u, state == MINIMUM);
}

// Points at the centre: one of a triangle, a row of a quad, or none.
fn centre_points(topology: vec2<u32>) -> u32 {
    let long = max(inside_u(topology), inside_v(topology));
    // If both axes are equally long but only one is even, their counts differ: no tie to break.
    let short_is_even = (min(inside_u(topology), inside_v(topology)) & 1u) == 1u;
    return select(0u, long - 2u * point_ring_end(topology), short_is_even);
}

fn point_run(topology: vec2<u32>, run: u32) -> Segment {
    if DOMAIN == ISOLINE {
        let along = outer_points(topology, 1u);
        return Segment(run * along, along);
    }
    if state_of(topology) == MINIMUM {
        return Segment(0u, EDGES);
    }
    let ring = run / EDGES;
    let edge = run % EDGES;
    if ring == 0u {
        return Segment(outer_before(topology, edge) - edge, outer_points(topology, edge) - 1u);
    }
    let start = boundary(topology) + points_before_ring(topology, ring);
    if ring == point_ring_end(topology) {
        return Segment(start, centre_points(topology));
    }
    let before = along_before(topology, edge) - edge * (2u * ring + 1u);
    return Segment(start + before, along_points(topology, edge) - 1u - 2u * ring);
}

// A run in a word: constant in bits 0..16, position of its first point 17..23, 24 set if positions
// descend, form 25..26, number of its context 27..29.
fn make_run(fixed: u32, first: u32, descends: bool, form: u32, context: u32) -> u32 {
    return fixed | (first << 17u) | (select(0u, 1u, descends) << 24u) | (form << 25u)
        | (context << 27u);
}

fn describe_run(patch_index: u32, topology: vec2<u32>, run: u32) -> u32 {
    if DOMAIN == ISOLINE {
        return make_run(place(context_of(patch_index, 0u), run), 0u, false, FORM_Q_FIXED, 1u);
    }
    if state_of(topology) == MINIMUM {
        return make_run(0u, 0u, false, FORM_CORNER, 0u);
    }
    if DOMAIN == TRIANGLE {
        return describe_triangle_run(patch_index, topology, run / 3u, run % 3u);
    }
    return describe_quad_run(patch_index, topology, run / 4u, run % 4u);
}

fn describe_triangle_run(patch_index: u32, topology: vec2<u32>, ring: u32, edge: u32) -> u32 {
    let is_outer = ring == 0u;
    if ring == point_ring_end(topology) {
        return make_run(ONE_THIRD, 0u, false, FORM_CORNER, 0u);
    }
    var fixed = 0u;
    if !is_outer {
        fixed = (place(context_of(patch_index, 3u), ring) * TWO_THIRDS + HALF) >> 16u;
    }
    let points = select(inside_u(topology), outer_points(topology, edge), is_outer);
    let first = select(points - 1u - ring, ring, edge == 1u);
    return make_run(fixed, first, edge != 1u, edge, select(3u, edge, is_outer));
}

fn describe_quad_run(patch_index: u32, topology: vec2<u32>, ring: u32, edge: u32) -> u32 {
    let descends = edge == 0u || edge == 3u;
    let form = edge & 1u; // edges 0 and 2 run along v at a constant u
    if ring == 0u {
        let last = outer_points(topology, edge) - 1u;
        return make_run(
            select(0u, ONE, edge >= 2u), select(0u, last, descends), descends, form, edge);
    }
    if ring == point_ring_end(topology) {
        let is_along_u = inside_u(topology) > inside_v(topology);
        if is_along_u {
            return make_run(HALF, ring, false, FORM_Q_FIXED, 4u);
        }
        return make_run(HALF, inside_v(topology) - 1u - ring, true, FORM_FIXED_Q, 5u);
    }
    let across = select(inside_u(topology), inside_v(topology), form == 1u);
    let position = select(ring, across - 1u - ring, edge >= 2u);
    let fixed = place(context_of(patch_index, 4u + form), position);
    let last = along_points(topology, edge) - 1u - ring;
    return make_run(fixed, select(ring, last, descends), descends, form, 5u - form);
}

// The corners of a minimum patch, and the centre of a triangle (spec sections 3 and 6).
fn corner(fixed: u32, number: u32) -> vec2<u32> {
    if fixed != 0u {
        return vec2<u32>(fixed, fixed);
    }
    if DOMAIN == TRIANGLE {
        return vec2<u32>(select(0u, ONE, number == 2u), select(0u, ONE, number == 0u));
    }
    return vec2<u32>(select(0u, ONE, number == 1u || number == 2u), select(0u, ONE, number >= 2u));
}

// Point `step` of a run: u and v, 16.16.
//
// On triangles locations along a ring's edge move back by half of its distance from the edge.
fn point_of_run(patch_index: u32, run: u32, step: u32) -> vec2<u32> {
    let fixed = run & 0x1ffffu;
    let form = (run >> 25u) & 3u;
    if form == FORM_CORNER {
        return corner(fixed, step);
    }
    let first = (run >> 17u) & 127u;
    let position = select(first + step, first - step, ((run >> 24u) & 1u) == 1u);
    var q = place(context_of(patch_index, run >> 27u), position);
    if DOMAIN == TRIANGLE {
        q -= (fixed + 1u) >> 1u;
        if form == FORM_Q_REST {
            return vec2<u32>(q, ONE - q - fixed);
        }
    }
    return select(vec2<u32>(fixed, q), vec2<u32>(q, fixed), form == FORM_Q_FIXED);
}

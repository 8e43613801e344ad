// The domain points of a patch as runs (spec section 6): along a run one coordinate is placed
// point by point while the other is constant. Which run a point belongs to follows from closed
// forms; runs come in output order: lines of an isoline patch; outer edges, then the edges of each
// interior ring, then the centre.

// How a run's two numbers become a point: `fixed` is its constant, `q` the placed location.
const FORM_FIXED_Q = 0u;
const FORM_Q_FIXED = 1u;
const FORM_Q_REST = 2u; // the third coordinate of the triangle is the constant one
const FORM_CORNER = 3u; // corner by number; with a constant that is not 0, the constant twice

struct Run {
    // Its points, and the one that is meant.
    size: u32,
    step: u32,
    fixed: u32,
    form: u32,
    // The context that its points are placed with, the position of the first, and 1 or -1
    // (modulo 2^32).
    context: vec2<u32>,
    first: u32,
    sign: u32,
}

const DOWN = 0xffffffffu;

// A patch, its shape and the contexts of its inside axes u and v.
struct Domain {
    patch_index: u32,
    shape: Shape,
    along_u: vec2<u32>,
    along_v: vec2<u32>,
}

fn domain_of(patch_index: u32, topology: vec2<u32>) -> Domain {
    let shape = shape_of(topology);
    let along_u = context_of(patch_index, EDGES, shape.u);
    if DOMAIN == TRIANGLE {
        return Domain(patch_index, shape, along_u, along_u);
    }
    return Domain(patch_index, shape, along_u, context_of(patch_index, EDGES + 1u, shape.v));
}

// Of the inside axis that an edge runs along.
fn inside_context(domain: Domain, edge: u32) -> vec2<u32> {
    return select(domain.along_v, domain.along_u, (edge & 1u) == 1u);
}

// Where point i of a regular patch is; the outer ring is ring 0.
fn point_spot(shape: Shape, i: u32) -> Spot {
    let is_outer = i < shape.boundary;
    let end = point_ring_end(shape) - 1u;
    var ring = 0u;
    var rest = i;
    var begin_1 = shape.before_1 - 1u;
    var begin_2 = shape.before_2 - 2u;
    var size_2 = outer_of(shape, 2u) - 1u;
    if !is_outer {
        let form = shape.along - 2u * EDGES;
        let k = last_before(i - shape.boundary, end, form, EDGES);
        ring = k + 1u;
        rest = i - shape.boundary - k * (form - EDGES * k);
        size_2 = shape.v - 1u - 2u * ring;
        begin_1 = select(size_2, NEVER, k == end); // the centre has one edge
        begin_2 = select(shape.sides - 2u - 4u * ring, NEVER, k == end);
    }
    return spot_on_edges(ring, rest, begin_1, begin_2, size_2);
}

// The run of a spot.
fn run_of(domain: Domain, spot: Spot) -> Run {
    let shape = domain.shape;
    let ring = spot.ring;
    let is_outer = ring == 0u;
    let is_centre = ring == point_ring_end(shape);
    // A row in the centre lies along the longer axis, as edge 0 or 1 do.
    let edge = select(spot.edge, select(0u, 1u, shape.u > shape.v), is_centre);
    let along = along_of(shape, edge);
    let points = select(along, outer_of(shape, edge), is_outer);
    let last = points - 1u - ring;
    var fixed = place_before_middle(inside_context(domain, edge + 1u), ring);
    var form = edge & 1u; // edges 0 and 2 of quads run along v at a constant u
    var descends = edge == 0u || edge == 3u;
    if DOMAIN == TRIANGLE {
        fixed = select((fixed * TWO_THIRDS + HALF) >> 16u, ONE_THIRD, is_centre);
        form = select(edge, FORM_CORNER, is_centre);
        descends = edge != 1u;
    } else {
        fixed = select(fixed, ONE - fixed, edge >= 2u);
        fixed = select(fixed, HALF, is_centre);
    }
    var context = inside_context(domain, edge);
    if is_outer {
        context = context_of(domain.patch_index, edge, points);
    }
    return Run(
        last - ring + select(0u, 1u, is_centre), spot.step, fixed, form, context,
        select(ring, last, descends), select(1u, DOWN, descends));
}

fn minimum_run(i: u32) -> Run {
    return Run(EDGES, i, 0u, FORM_CORNER, vec2<u32>(0u), 0u, 1u);
}

fn line_run(patch_index: u32, topology: vec2<u32>, i: u32) -> Run {
    let along = outer_points(topology, 1u);
    let line = i / along;
    let v = place(context_of(patch_index, 0u, outer_points(topology, 0u)), line);
    return Run(
        along, i - line * along, v, FORM_Q_FIXED, context_of(patch_index, 1u, along), 0u, 1u);
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
fn point_of_run(run: Run, step: u32) -> vec2<u32> {
    let fixed = run.fixed;
    if run.form == FORM_CORNER {
        return corner(fixed, step);
    }
    var q = place(run.context, run.first + run.sign * step);
    if DOMAIN == TRIANGLE {
        q -= (fixed + 1u) >> 1u;
        if run.form == FORM_Q_REST {
            return vec2<u32>(q, ONE - q - fixed);
        }
    }
    return select(vec2<u32>(fixed, q), vec2<u32>(q, fixed), run.form == FORM_Q_FIXED);
}

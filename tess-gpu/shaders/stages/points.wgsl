// needs: stages/fixed_point, {place}, {contexts}, stages/rings, layout/setup, layout/topology
// The domain points of a patch (spec section 6): any point from its number, in closed form.
//
// Tiles, the catalogue and `Pull` ask for point i of a patch. Points come in runs, along which one coordinate is
// constant and the other is placed point by point, so the work that a run shares is done once for it.
//
//     RingLocation         which ring, which edge of it, which step on the edge       point_location
//       -> RunShape        which factor places it, from which position, up or down    shape_of: reads the topology
//       -> PointRun        the constant's value and the context                       run_of: reads contexts
//       -> (u, v)          one `place` for each point                                 point_of_run
//
// Runs follow each other in output order: lines of an isoline patch; or the outer edges, the edges of each interior
// ring, and the centre, which is a point or a row of points if the smaller inside axis has an odd number of points.
//
//     edge     quad                          triangle
//     0        u = 0, v descends             u = 0, v descends
//     1        v = 0, u ascends              v = 0, u ascends
//     2        u = 1, v ascends              w = 0, u and v together
//     3        v = 1, u descends
//
// The quad patch (3, 4.5, 5, 6; 4, 7) has 43 points: 22 on the outer ring, 16 on ring 1, a row of 5 in the centre.
//
//   point 31: ring 1, edge 2, step 1
//   fixed 0x10000 - 0x4000 = 0xc000, q 0x4aab
//
// Edge 2 of ring 1 is one position from u = 1, which inside u places at 0x4000; inside v places step 1 at
// position 2.
//
// What must hold:
// - `last_before` gets products that ascend up to `end`; beyond it they descend, and the search would miss.
// - shape_of reads no context, so that shared/described.wgsl can keep its answer for any patch of the topology.
// - `place_before_middle` serves constants, because a ring is never beyond the middle.
//
// The simpler form walks the patch from its first point, which gives each patch one thread. It takes 1.7 to 13
// times as long on an H100 (docs/performance.md, table gpu-one-thread).

// How a run's two numbers become a point: `fixed` is its constant, `q` the placed location.
const FORM_FIXED_Q = 0u;
const FORM_Q_FIXED = 1u;
const FORM_Q_REST = 2u; // the third coordinate of the triangle is the constant one
const FORM_CORNER = 3u; // a corner by its number; if `fixed` is not 0: (fixed, fixed)

struct PointRun {
    // Point count; index of the current point.
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

// A patch, its rings and the contexts of its inside axes u and v.
struct PatchAxes {
    patch_index: u32,
    rings: Rings,
    along_u: vec2<u32>,
    along_v: vec2<u32>,
}

fn axes_of(patch_index: u32, topology: vec2<u32>) -> PatchAxes {
    let rings = rings_of(topology);
    let along_u = context_of(patch_index, EDGES, rings.u);
    if DOMAIN == TRIANGLE {
        return PatchAxes(patch_index, rings, along_u, along_u);
    }
    return PatchAxes(patch_index, rings, along_u, context_of(patch_index, EDGES + 1u, rings.v));
}

// The factor of the inside axis that an edge runs along; a triangle has one.
fn inside_factor(edge: u32) -> u32 {
    return select(EDGES + 1u, EDGES, DOMAIN == TRIANGLE || (edge & 1u) == 1u);
}

// The context of an inside factor.
fn inside_context(axes: PatchAxes, factor: u32) -> vec2<u32> {
    return select(axes.along_v, axes.along_u, factor == EDGES);
}

// A run before its contexts are known: it depends only on the topology.
struct RunShape {
    size: u32,
    form: u32,
    // The factor that places its points, that factor's points, the position of the first, and 1 or -1.
    factor: u32,
    points: u32,
    first: u32,
    sign: u32,
    constant: Constant,
}

// The constant of a run: how far ring `ring` is from the outer one, by an inside factor.
struct Constant {
    factor: u32,
    ring: u32,
    // Whether it is measured from the far side of a quad, and whether it is in the centre, where the
    // factors don't matter.
    is_far: bool,
    is_centre: bool,
}

// Where point i of a regular patch is; the outer ring is ring 0.
fn point_location(rings: Rings, i: u32) -> RingLocation {
    let is_outer = i < rings.boundary;
    let end = point_ring_end(rings) - 1u;
    var ring = 0u;
    var rest = i;
    var begin_1 = rings.before_1 - 1u;
    var begin_2 = rings.before_2 - 2u;
    var size_2 = outer_of(rings, 2u) - 1u;
    if !is_outer {
        let form = rings.along - 2u * EDGES;
        let k = last_before(i - rings.boundary, end, form, EDGES);
        ring = k + 1u;
        rest = i - rings.boundary - k * (form - EDGES * k);
        size_2 = rings.v - 1u - 2u * ring;
        // The centre has one edge.
        begin_1 = select(size_2, NEVER, k == end);
        begin_2 = select(rings.sides - 2u - 4u * ring, NEVER, k == end);
    }
    return location_on_edges(ring, rest, begin_1, begin_2, size_2);
}

// What the run at a location looks like.
fn shape_of(rings: Rings, location: RingLocation) -> RunShape {
    let ring = location.ring;
    let is_outer = ring == 0u;
    let is_centre = ring == point_ring_end(rings);
    // A row in the centre runs along the longer axis, like edge 0 or 1.
    let edge = select(location.edge, select(0u, 1u, rings.u > rings.v), is_centre);
    let points = select(along_of(rings, edge), outer_of(rings, edge), is_outer);
    let last = points - 1u - ring;
    var form = edge & 1u; // edges 0 and 2 of quads run along v at a constant u
    var descends = edge == 0u || edge == 3u;
    if DOMAIN == TRIANGLE {
        form = select(edge, FORM_CORNER, is_centre);
        descends = edge != 1u;
    }
    return RunShape(
        last - ring + select(0u, 1u, is_centre), form,
        select(inside_factor(edge), edge, is_outer), points,
        select(ring, last, descends), select(1u, DOWN, descends),
        Constant(inside_factor(edge + 1u), ring, edge >= 2u, is_centre));
}

// The value of a constant; `context` is that of its factor.
fn constant_value(constant: Constant, context: vec2<u32>) -> u32 {
    let fixed = place_before_middle(context, constant.ring);
    if DOMAIN == TRIANGLE {
        return select((fixed * TWO_THIRDS + HALF) >> 16u, ONE_THIRD, constant.is_centre);
    }
    return select(select(fixed, ONE - fixed, constant.is_far), HALF, constant.is_centre);
}

// The run at a location.
fn run_of(axes: PatchAxes, location: RingLocation) -> PointRun {
    let shape = shape_of(axes.rings, location);
    var context = inside_context(axes, shape.factor);
    if location.ring == 0u {
        context = context_of(axes.patch_index, shape.factor, shape.points);
    }
    let constant = shape.constant;
    return PointRun(
        shape.size, location.step, constant_value(constant, inside_context(axes, constant.factor)),
        shape.form, context, shape.first, shape.sign);
}

// The run of point i of a patch.
fn run_at_point(patch_index: u32, topology: vec2<u32>, i: u32) -> PointRun {
    if DOMAIN == ISOLINE {
        return line_run(patch_index, topology, i);
    }
    if state_of(topology) == MINIMUM {
        return minimum_run(i);
    }
    let axes = axes_of(patch_index, topology);
    return run_of(axes, point_location(axes.rings, i));
}

fn minimum_run(i: u32) -> PointRun {
    return PointRun(EDGES, i, 0u, FORM_CORNER, vec2<u32>(0u), 0u, 1u);
}

fn line_run(patch_index: u32, topology: vec2<u32>, i: u32) -> PointRun {
    let along = outer_points(topology, 1u);
    let line = i / along;
    let v = place(context_of(patch_index, 0u, outer_points(topology, 0u)), line);
    return PointRun(
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
// On triangles, locations along an edge of a ring move back by half of the ring's distance from the
// patch's edge.
fn point_of_run(run: PointRun, step: u32) -> vec2<u32> {
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

// needs: layout/setup, layout/topology
// The rings of a regular triangle or quad patch: the numbers that all of its elements share.

struct Rings {
    // Points along each outer edge, as in the topology.
    outer: u32,
    // Those of the edges before edge 1, 2 and 3, added up.
    before_1: u32,
    before_2: u32,
    before_3: u32,
    // Points along each inside axis, of the shorter one, and of the axes of edges 0 and 1 together.
    u: u32,
    v: u32,
    short: u32,
    sides: u32,
    // Points of the outer ring, and of all edges along the inside axes.
    boundary: u32,
    along: u32,
}

fn rings_of(topology: vec2<u32>) -> Rings {
    let u = inside_u(topology);
    let v = inside_v(topology);
    let sides = u + v;
    return Rings(
        topology.x, outer_before(topology, 1u), outer_before(topology, 2u), outer_before(topology, 3u),
        u, v, min(u, v), sides, boundary(topology), select(2u * sides, sides + u, DOMAIN == TRIANGLE));
}

fn outer_of(rings: Rings, edge: u32) -> u32 {
    return (rings.outer >> (7u * edge)) & 127u;
}

// `outer_before` of an edge.
fn outer_sum(rings: Rings, edge: u32) -> u32 {
    let high = select(rings.before_2, rings.before_3, edge == 3u);
    return select(select(0u, rings.before_1, edge == 1u), high, edge >= 2u);
}

// Points of the inside axis that an edge runs along: v for edges 0 and 2, u for 1 and 3.
fn along_of(rings: Rings, edge: u32) -> u32 {
    return select(rings.v, rings.u, (edge & 1u) == 1u);
}

// The sum of `along_of` over the edges before this one.
fn along_sum(rings: Rings, edge: u32) -> u32 {
    return select(0u, rings.v, (edge & 1u) == 1u) + select(0u, rings.sides, edge >= 2u);
}

// Points on an interior ring that goes round, from 1.
fn ring_points(rings: Rings, ring: u32) -> u32 {
    return rings.along - EDGES - 2u * EDGES * ring;
}

// The first point of interior ring `ring`, from 1.
fn first_of_ring(rings: Rings, ring: u32) -> u32 {
    return rings.boundary + (ring - 1u) * (rings.along - EDGES - EDGES * ring);
}

// One more than the number of interior rings of points that go round.
fn point_ring_end(rings: Rings) -> u32 {
    return rings.short >> 1u;
}

// One more than the number of rings that are stitched to the ring outside of them.
fn stitch_ring_end(rings: Rings) -> u32 {
    return (rings.short + 1u) >> 1u;
}

// The last k in 0..=end with k * (form - scale * k) <= goal. The product grows with k up to `end`, which is at
// most 31.
fn last_before(goal: u32, end: u32, form: u32, scale: u32) -> u32 {
    var k = 0u;
    if end > 3u {
        k = nearer_ring(k, 16u, goal, end, form, scale);
        k = nearer_ring(k, 8u, goal, end, form, scale);
        k = nearer_ring(k, 4u, goal, end, form, scale);
    }
    k = nearer_ring(k, 2u, goal, end, form, scale);
    return nearer_ring(k, 1u, goal, end, form, scale);
}

fn nearer_ring(k: u32, reach: u32, goal: u32, end: u32, form: u32, scale: u32) -> u32 {
    let next = min(k + reach, end);
    return select(k, next, next * (form - scale * next) <= goal);
}

// Step `step` along edge `edge` of a ring: a point, or a triangle between that ring and the one
// outside of it. The centre counts as the ring after the last.
struct RingLocation {
    ring: u32,
    edge: u32,
    step: u32,
}

// The location of element `rest` of a ring. Edges 0 and 2 have `size_0` elements each, edges 1 and 3
// `size_1`.
fn location_on_ring(ring: u32, rest: u32, size_0: u32, size_1: u32) -> RingLocation {
    return location_on_edges(ring, rest, size_0, size_0 + size_1, size_0);
}

// The location of element `rest` of a ring. Edge 1 begins at `begin_1`, edge 2 at `begin_2`, and edge 3
// `size_2` elements later.
fn location_on_edges(ring: u32, rest: u32, begin_1: u32, begin_2: u32, size_2: u32) -> RingLocation {
    let is_high = rest >= begin_2;
    let low = rest - select(0u, begin_2, is_high);
    let size = select(begin_1, select(size_2, NEVER, DOMAIN == TRIANGLE), is_high);
    let is_odd = low >= size;
    return RingLocation(
        ring,
        select(0u, 2u, is_high) + select(0u, 1u, is_odd),
        low - select(0u, size, is_odd));
}

// The first step of the next edge.
fn next_edge(location: RingLocation) -> RingLocation {
    let is_last = location.edge + 1u == EDGES;
    return RingLocation(select(location.ring, location.ring + 1u, is_last), select(location.edge + 1u, 0u, is_last), 0u);
}

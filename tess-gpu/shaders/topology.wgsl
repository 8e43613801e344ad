// What connectivity and counts depend on (spec section 12.8), in 8 bytes per patch: the points
// along each edge and along each inside axis, 2..=65 in 7 bits.
//
// word 0: outer edges in order from bit 0, state in bits 28..29
// word 1: inside u from bit 0, inside v from bit 7. A triangle's one inside factor is both;
// an isoline's density and detail are edges 0 and 1.

const CULLED = 0u;
const MINIMUM = 1u;
const REGULAR = 2u;

fn state_of(topology: vec2<u32>) -> u32 {
    return topology.x >> 28u;
}

fn outer_points(topology: vec2<u32>, edge: u32) -> u32 {
    return (topology.x >> (7u * edge)) & 127u;
}

fn inside_u(topology: vec2<u32>) -> u32 {
    return topology.y & 127u;
}

fn inside_v(topology: vec2<u32>) -> u32 {
    return topology.y >> 7u;
}

// Points of the inside axis that an edge runs along: v for edges 0 and 2, u for 1 and 3.
fn along_points(topology: vec2<u32>, edge: u32) -> u32 {
    return (topology.y >> (7u * (1u - (edge & 1u)))) & 127u;
}

// The sum of `outer_points` over the edges before this one.
fn outer_before(topology: vec2<u32>, edge: u32) -> u32 {
    return select(0u, outer_points(topology, 0u), edge > 0u)
        + select(0u, outer_points(topology, 1u), edge > 1u)
        + select(0u, outer_points(topology, 2u), edge > 2u);
}

// The sum of `along_points` over the edges before this one.
fn along_before(topology: vec2<u32>, edge: u32) -> u32 {
    return ((edge + 1u) >> 1u) * inside_v(topology) + (edge >> 1u) * inside_u(topology);
}

// Points on the outer ring.
fn boundary(topology: vec2<u32>) -> u32 {
    return outer_before(topology, EDGES - 1u) + outer_points(topology, EDGES - 1u) - EDGES;
}

// A sum over the edges that both closed forms below are a multiple of.
fn ring_form(topology: vec2<u32>, ring: u32) -> u32 {
    return along_before(topology, EDGES) - EDGES - EDGES * ring;
}

// Points on the interior rings 1..ring, for ring >= 1.
fn points_before_ring(topology: vec2<u32>, ring: u32) -> u32 {
    return (ring - 1u) * ring_form(topology, ring);
}

// Triangles of the ring stitches 2..ring, for ring >= 2.
fn triangles_before_ring(topology: vec2<u32>, ring: u32) -> u32 {
    return 2u * (ring - 2u) * ring_form(topology, ring);
}

// One more than the number of interior rings of points that go round.
fn point_ring_end(topology: vec2<u32>) -> u32 {
    return min(inside_u(topology), inside_v(topology)) >> 1u;
}

// One more than the number of rings that are stitched to the ring outside of them.
fn stitch_ring_end(topology: vec2<u32>) -> u32 {
    return (min(inside_u(topology), inside_v(topology)) + 1u) >> 1u;
}

// A run of a patch's elements.
struct Segment {
    // Its first element, counted within the patch, and how many it has.
    start: u32,
    size: u32,
}

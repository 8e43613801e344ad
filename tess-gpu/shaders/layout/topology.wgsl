// needs: layout/setup
// The numbers that connectivity and counts depend on (spec section 12.8), in 8 bytes per patch: the points
// along each edge and along each inside axis, 2..=65 in 7 bits. `factors` writes it, the expansions read it.
//
//             31..30     29..28   27..21   20..14   13..7      6..0
//     word 0  (unused)   state    edge 3   edge 2   edge 1     edge 0
//     word 1  31..14: slot in the catalogue,        inside v   inside u
//             0 if there is none (variants/listing.wgsl)
//
// A triangle's one inside factor is both; an isoline's density and detail are edges 0 and 1. The quad patch
// (3, 4.5, 5, 6; 4, 7) with even fractional factors:
//
//   outer points [5, 7, 7, 7], inside points [5, 9], state 2
//   words 0x20e1c385 0x00000485

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
    return (topology.y >> 7u) & 127u;
}

// The number of the topology's slot in the catalogue, from 1 on; 0 if it has none.
fn listed_slot(topology: vec2<u32>) -> u32 {
    return topology.y >> 14u;
}

// The sum of `outer_points` over the edges before this one.
fn outer_before(topology: vec2<u32>, edge: u32) -> u32 {
    return select(0u, outer_points(topology, 0u), edge > 0u)
        + select(0u, outer_points(topology, 1u), edge > 1u)
        + select(0u, outer_points(topology, 2u), edge > 2u);
}

// Points on the outer ring.
fn boundary(topology: vec2<u32>) -> u32 {
    return outer_before(topology, EDGES - 1u) + outer_points(topology, EDGES - 1u) - EDGES;
}

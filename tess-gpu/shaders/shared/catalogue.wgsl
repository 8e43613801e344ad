// needs: layout/setup, layout/topology
// The catalogue: the output of each distinct small topology of a long batch, expanded once.
//
// Neighbouring patches with different topologies cannot be copied from each other (shared/alike.wgsl), but a batch
// has few topologies if its factors are small. So each topology gets a slot of a hash table, `list` expands every
// slot once, and the expansions look elements up. The entry points use one buffer, one after the other:
//
//     word                    what                                    written by      read by
//     0 .. SLOTS              key of each slot, 0 if free             factors, list   factors, list
//     USED_AT                 points, then triangles, taken so far    factors, list   list
//     PLACES_AT + 2 * slot    where its points and triangles begin,   list            expand_points,
//                             0 if they are not there                                 expand_primitives
//     POINTS_AT ..            points: two words each with integer     list            expand_points
//                             factors, or else one (described.wgsl)
//     TRIANGLES_AT ..         triangles: one word each                list            expand_primitives
//
// A key is the topology without its unused values. The points along an edge or axis, less 2, fill 5 bits:
//
//     31..30   29..25     24..20     19..15   14..10   9..5     4..0
//     state    inside v   inside u   edge 3   edge 2   edge 1   edge 0
//
// The quad patch (3, 4.5, 5, 6; 4, 7) with even fractional factors has outer points 5, 7, 7, 7 and inside points 5,
// 9:
//
//   key 0x8e3294a3, first slot tried 1658 of 8192
//
// What must hold:
// - A key has room for 33 points, no more: `has_key` refuses 34. Two topologies with one key would exchange their
//   output.
// - The key of a topology is never 0, which means that a slot is free: its state is MINIMUM or REGULAR.
// - `list` writes 0 over every key, so that the next run finds an empty table. Only the places are read after that.
// - The slot's number travels in bits 14.. of the topology's second word (layout/topology.wgsl), where 0 means
//   none. A patch without a slot is computed, so a full table costs speed but never a bit.
//
// The simpler form computes every patch of such a tile. On an H100 it takes 1053 microseconds for `character`
// instead of 709, and 655 instead of 584 for `terrain` (benches/records/gpu-ablation.json, shaders `no catalogue`).

// A key has the points along each edge and inside axis, less 2, in 5 bits each, and the state in bits 30..31.
fn key_of(topology: vec2<u32>) -> u32 {
    var key = ((inside_u(topology) - 2u) << 20u) | ((inside_v(topology) - 2u) << 25u);
    for (var edge = 0u; edge < EDGES; edge++) {
        key |= (outer_points(topology, edge) - 2u) << (5u * edge);
    }
    return key | (state_of(topology) << 30u);
}

// Whether a key has room for the points along everything.
fn has_key(topology: vec2<u32>) -> bool {
    var most = max(inside_u(topology), inside_v(topology));
    for (var edge = 0u; edge < EDGES; edge++) {
        most = max(most, outer_points(topology, edge));
    }
    return state_of(topology) != CULLED && most <= 33u;
}

// The topology of a key.
fn topology_of(key: u32) -> vec2<u32> {
    var outer = 0u;
    for (var edge = 0u; edge < EDGES; edge++) {
        outer |= (((key >> (5u * edge)) & 31u) + 2u) << (7u * edge);
    }
    let u = ((key >> 20u) & 31u) + 2u;
    let v = ((key >> 25u) & 31u) + 2u;
    return vec2<u32>(outer | ((key >> 30u) << 28u), u | (v << 7u));
}

// needs: layout/setup, layout/topology
// The catalogue holds the output of each distinct small topology of a long batch once, so that patches unlike
// their neighbours look their elements up. A topology is found by a key of 32 bits in a hash table of SLOTS
// slots: the stage `factors` enters the keys, `list` expands each topology, and the expansions read.
// The words of the buffer: keys of all slots, two counters, for each slot where its points and its triangles
// begin (0 if they are not there), then points and triangles.

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

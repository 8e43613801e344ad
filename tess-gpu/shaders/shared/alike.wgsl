// needs: shared/offsets, shared/tile, layout/topology; bindings: job, offsets
// Tiles whose patches all have the same topology: the elements of one patch are made once, kept in
// workgroup memory and copied, if there are not so many that making them takes longer than it saves.

struct Repeat {
    topology: vec2<u32>,
    // Elements of each patch; 0 if the tile has to be expanded patch by patch.
    size: u32,
    // Elements of the first patch that lie before the tile (modulo 2^32).
    before: u32,
    // 2^21 / size, rounded up.
    inverse: u32,
    // The first point of the first patch, and points of each.
    base: u32,
    points: u32,
}

// How the elements of a tile repeat, if a patch has at most `most` of them, which is at most 640.
// `kind` is POINTS or PRIMITIVES.
fn repeat_of(tile: Tile, kind: u32, most: u32) -> Repeat {
    var none: Repeat;
    none.size = 0u;
    let topology = common_topology(tile);
    if COPIES == 0u || tile.first_patch == tile.last_patch || state_of(topology) == CULLED {
        return none;
    }
    let begin = patch_offset(tile.first_patch);
    let size = patch_offset(tile.first_patch + 1u) - begin;
    if size[kind] > most {
        return none;
    }
    return Repeat(
        topology, size[kind], tile.base - begin[kind],
        (0x1fffffu + size[kind]) / size[kind], begin.x, size.x);
}

// The topology of all patches of the blocks in which a tile's patches are, or a culled one.
fn common_topology(tile: Tile) -> vec2<u32> {
    let first = job.alike_at + (tile.first_patch >> BLOCK_BITS);
    let last = job.alike_at + (tile.last_patch >> BLOCK_BITS);
    let topology = offsets[first];
    for (var block = first + 1u; block <= last; block++) {
        if any(offsets[block] != topology) {
            return vec2<u32>(0u, 0u);
        }
    }
    return topology;
}

// Which of the tile's patches an element belongs to. Exact, and without overflow, for a position of
// at most 2046 + size and a size of at most 640.
fn patch_at(repeat: Repeat, position: u32) -> u32 {
    return (position * repeat.inverse) >> 21u;
}

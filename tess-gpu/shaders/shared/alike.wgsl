// needs: shared/offsets, shared/tile, layout/topology; bindings: job, offsets
// Tiles whose patches all have the same topology: one patch is expanded into workgroup memory, and the tile copies
// it.
//
// The tiles of points and of primitives call `repeat_of` first. It answers from two numbers per block, which
// `process_block` (shared/block.wgsl) has left in the buffer of offsets; only if it says 0 is the tile expanded
// patch by patch.
//
//     offsets[alike_at + block]   the topology of all 256 patches of the block, 0 if they differ     written by factors
//     tile's patches              first_patch ... last_patch: the blocks between must agree          read here
//     scratch                     the elements of one patch, at most SCRATCH, or two to an entry     written and read by a tile
//
// Element e of the tile has position e + before, where `before` counts the elements of the first patch that
// precede the tile. Its patch is position / size, by a multiplication with the inverse. The quad patch (3,
// 4.5, 5, 6; 4, 7) has 62 triangles:
//
//   size 62, inverse 33826: position 100 is triangle 38 of patch 1
//
// What must hold:
// - position <= 2046 + size and size <= 640, so that the product stays below 2^32 and the quotient is exact
//   (src/sizes.rs asserts the sizes, tests/worked.rs divides every position by every size).
// - Equal topologies always have equal triangles, but equal points only with integer factors or in a minimum patch
//   (`has_same_points` in shared/point_tile.wgsl).
// - A culled block has no elements to copy.
//
// The simpler form expands each patch. On an H100 it takes 684 microseconds for `uniform-16` instead of 460, and 1.7
// times as long for `uniform-1` (benches/records: gpu-ablation.json, shaders `no copies`, and gpu-no-copies.json).

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

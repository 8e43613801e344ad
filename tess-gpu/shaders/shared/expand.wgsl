// needs: {catalogue}, shared/offsets, layout/setup, shared/tile, layout/topology; bindings: job, offsets, topologies
// Shared by the tiles of points and of primitives: the patches of a tile, a round at a time.
//
// A tile is 2^tile_bits consecutive elements of the output, and `tiles` has the patch that it begins with. Its
// patches begin at arbitrary elements, so each thread has to find the patch of its element. The workgroup loads up
// to ROUND patches together, and a thread searches among those.
//
//     tile      |<------------------ 2048 elements ------------------>|
//     patches  ...p|   p+1   |  p+2  | ...                       | p+n ...
//     begins    -20     23      66     ...      where each patch begins, counted from the tile's base; negative for a
//                                               patch that begins before it
//     scratch   topology of each patch          (or, in shared/alike.wgsl, the elements of one patch)
//     listed    where the patch's elements are in the catalogue, less where they begin; index of its first point
//
// Three patches like (3, 4.5, 5, 6; 4, 7), of 43 points each, in the first tile:
//
//   begins [0, 43, 86]: element 50 is point 7 of patch 1
//
// `find_patch` halves its reach at each step, from the power of two below the number of patches, without a branch
// that differs between threads. `next_patch` serves the second element of a pair, which is at most a few culled
// patches further.
//
// What must hold:
// - `begins` is ascending. Culled patches begin where the next one does, and the search takes the last, which has
//   elements.
// - Every thread of the workgroup calls `load_round`, because it has barriers.
// - `load_patch` reads only patches of this portion: the caller's last_patch comes from the same portion's table.
// - is_listed is the same for all threads, so that a round is looked up or computed as a whole.
//
// The simpler form is a loop. naga adds a counter to every loop, which costs more than the steps of a binary search
// (docs/experiments.md), so the steps are written out. Rounds of 256 patches would need more workgroup memory, so
// fewer tiles would run at once: on an H100, 669 microseconds for `terrain` instead of 584, and 819 for `character`
// instead of 709 (benches/records/gpu-ablation.json).

// Patches of the tile that are expanded together: `count` of them from `first`, and the elements
// begin..end of the tile, counted from its base, that they have.
struct Round {
    first: u32,
    count: u32,
    begin: u32,
    end: u32,
    // Whether the topologies of all its patches are in the catalogue.
    is_listed: bool,
}

// Where each patch of a round begins, counted from the tile's base.
var<workgroup> begins: array<i32, ROUND>;
// The topologies of a round's patches; or the elements of one patch, in a tile that copies them
// (shared/alike.wgsl). Its size limits how many tiles run at once.
var<workgroup> scratch: array<vec2<u32>, SCRATCH>;

// For each patch of a round, where its elements are in the catalogue, less where they begin in the tile (modulo
// 2^32); and the index of its first point.
var<workgroup> listed: array<vec2<u32>, ROUND>;
// Whether the catalogue lacks a patch of the round.
var<workgroup> is_missing: atomic<u32>;

// Where a patch's elements are in the catalogue; 0 if it has none there.
fn place_of(patch_index: u32, topology: vec2<u32>, kind: u32) -> u32 {
    var slot = listed_slot(topology);
    if slot == 0u {
        slot = listed_slot(offsets[job.alike_at + (patch_index >> BLOCK_BITS)]);
    }
    if slot == 0u {
        return 0u;
    }
    return catalogue_word(PLACES_AT + 2u * (slot - 1u) + kind);
}

// Loads patch `i` of a round, which is a patch of the portion.
fn load_patch(i: u32, patch_index: u32, tile: Tile, kind: u32) {
    let topology = topologies[patch_index];
    let offset = patch_offset(patch_index);
    let begin = offset[kind] - tile.base;
    begins[i] = i32(begin);
    scratch[i] = topology;
    let found = place_of(patch_index, topology, kind);
    let words = select(1u, POINT_WORDS, kind == POINTS);
    listed[i] = vec2<u32>(found - words * begin, select(0u, offset.x, NUMBERING == PER_BATCH));
    if found == 0u && state_of(topology) != CULLED {
        atomicStore(&is_missing, 1u);
    }
}

// Loads the round of patches from `first` on. Called by all threads; `kind` is POINTS or PRIMITIVES.
fn load_round(tile: Tile, first: u32, kind: u32, thread: u32) -> Round {
    let count = min(ROUND, tile.last_patch - first + 1u);
    workgroupBarrier();
    if thread == 0u {
        atomicStore(&is_missing, 0u);
    }
    workgroupBarrier();
    for (var i = thread; i < count; i += THREADS) {
        load_patch(i, first + i, tile, kind);
    }
    workgroupBarrier();
    let begin = u32(max(begins[0], i32(tile.begin - tile.base)));
    var end = tile.end - tile.base;
    if first + count <= tile.last_patch {
        end = patch_offset(first + count)[kind] - tile.base;
    }
    return Round(first, count, begin, end, atomicLoad(&is_missing) == 0u);
}

// The last of a round's patches that begins at or before an element.
fn find_patch(round: Round, element: u32) -> u32 {
    var found = 0u;
    if round.count == 1u {
        return found;
    }
    let last = round.count - 1u;
    if round.count > 32u {
        found = nearer_patch(found, 64u, last, element);
        found = nearer_patch(found, 32u, last, element);
    }
    if round.count > 8u {
        found = nearer_patch(found, 16u, last, element);
        found = nearer_patch(found, 8u, last, element);
    }
    if round.count > 4u {
        found = nearer_patch(found, 4u, last, element);
    }
    found = nearer_patch(found, 2u, last, element);
    return nearer_patch(found, 1u, last, element);
}

fn nearer_patch(found: u32, reach: u32, last: u32, element: u32) -> u32 {
    let next = min(found + reach, last);
    return select(found, next, begins[next] <= i32(element));
}

// The same for an element that belongs to patch `number` or to a later one.
fn next_patch(round: Round, number: u32, element: u32) -> u32 {
    var found = number;
    while found + 1u < round.count && begins[found + 1u] <= i32(element) {
        found++;
    }
    return found;
}

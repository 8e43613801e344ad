// needs: offsets, tile; bindings: topologies
// What the expansions of points and of primitives share: a tile's patches, a round at a time.

// Patches of the tile that are expanded together: `count` of them from `first`, and the elements
// begin..end of the tile, counted from its base, that they have.
struct Round {
    first: u32,
    count: u32,
    begin: u32,
    end: u32,
}

// Where each patch of a round begins, counted from the tile's base.
var<workgroup> begins: array<i32, ROUND>;
// The topologies of a round's patches; or the elements of one patch, in a tile that copies them
// (alike.wgsl). Its size limits how many tiles run at once.
var<workgroup> scratch: array<vec2<u32>, SCRATCH>;

// Loads the round of patches from `first` on. Called by all threads; `kind` is POINTS or PRIMITIVES.
fn load_round(tile: Tile, first: u32, kind: u32, thread: u32) -> Round {
    let count = min(ROUND, tile.last_patch - first + 1u);
    workgroupBarrier();
    for (var i = thread; i < count; i += WORKGROUP) {
        begins[i] = i32(patch_offset(first + i)[kind] - tile.base);
        scratch[i] = topologies[first + i];
    }
    workgroupBarrier();
    let begin = u32(max(begins[0], i32(tile.begin - tile.base)));
    var end = tile.end - tile.base;
    if first + count <= tile.last_patch {
        end = patch_offset(first + count)[kind] - tile.base;
    }
    return Round(first, count, begin, end);
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

// The same for an element that belongs to patch `number` or to one behind it.
fn next_patch(round: Round, number: u32, element: u32) -> u32 {
    var found = number;
    while found + 1u < round.count && begins[found + 1u] <= i32(element) {
        found++;
    }
    return found;
}

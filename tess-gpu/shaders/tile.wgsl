// A tile: TILE consecutive elements of the output, expanded by one workgroup, and its patches.

struct Tile {
    // Its first element and the elements begin..end that are to be written.
    base: u32,
    begin: u32,
    end: u32,
    // The first and last patch that have elements in it.
    first_patch: u32,
    last_patch: u32,
}

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
// The topologies of its patches. Tiles without rounds keep there what they copy (alike.wgsl). How
// many tiles run at once depends on the size of this.
var<workgroup> round_topologies: array<vec2<u32>, KEPT>;

// The tile of a workgroup; `end` is 0 if there is none for it. `begin..end` is the chunk's range,
// whose table of tiles begins at `table_at`.
fn tile_of(workgroup: u32, begin: u32, end: u32, table_at: u32) -> Tile {
    let chunk_first = begin / TILE;
    let first = max(chunk_first, job.window_first);
    let last = min((end + TILE - 1u) / TILE, job.window_first + job.window_tiles);
    let number = first + workgroup;
    if end <= begin || number >= last {
        return Tile(0u, 0u, 0u, 0u, 0u);
    }
    let base = number * TILE;
    let at = table_at + number - chunk_first;
    return Tile(base, max(base, begin), min(base + TILE, end), tiles[at], tiles[at + 1u]);
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

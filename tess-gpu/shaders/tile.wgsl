// A tile: TILE consecutive elements of the output, expanded by one workgroup. Its segments (runs
// of elements that share their arithmetic) are laid down at the tile position where they begin;
// an element finds its segment as the last one that begins at or before it.

const TILE_WORDS = TILE / 32u;

// Bit e of the tile: a segment begins at element e.
var<workgroup> starts: array<atomic<u32>, TILE_WORDS>;
// For each word of `starts`, the last begin in the words before it.
var<workgroup> start_before: array<u32, TILE_WORDS>;
// How many elements of the segment at position 0 lie in the tiles before.
var<workgroup> cut_off: u32;

struct Tile {
    // Its first element and the elements begin..end that are to be written.
    base: u32,
    begin: u32,
    end: u32,
    // The first and last patch that have elements in it.
    first_patch: u32,
    last_patch: u32,
}

// An element's segment, by the tile position where it begins, and the element's place in it.
struct Found {
    position: u32,
    step: u32,
}

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

fn clear_segments(thread: u32) {
    if thread < TILE_WORDS {
        atomicStore(&starts[thread], 0u);
    }
    if thread == 0u {
        cut_off = 0u;
    }
}

// Marks where a segment begins that has elements begin..end of the output, if the tile has any of
// them. Returns the position to lay it down at, or TILE.
fn lay_down(tile: Tile, begin: u32, end: u32) -> u32 {
    if end <= begin || begin >= tile.end || end <= tile.base {
        return TILE;
    }
    var position = begin - tile.base;
    if begin < tile.base {
        position = 0u;
        cut_off = tile.base - begin;
    }
    atomicOr(&starts[position >> 5u], 1u << (position & 31u));
    return position;
}

// Between two barriers after all segments are laid down.
fn link_segments(thread: u32) {
    if thread >= TILE_WORDS {
        return;
    }
    var word = thread;
    var bits = 0u;
    while word > 0u && bits == 0u {
        word -= 1u;
        bits = atomicLoad(&starts[word]);
    }
    start_before[thread] = select(32u * word + firstLeadingBit(bits), 0u, bits == 0u);
}

fn find_segment(element: u32) -> Found {
    let word = element >> 5u;
    let bits = atomicLoad(&starts[word]) & (0xffffffffu >> (31u - (element & 31u)));
    let own = 32u * word + firstLeadingBit(bits);
    let position = select(own, start_before[word], bits == 0u);
    return Found(position, element - position + select(0u, cut_off, position == 0u));
}

// How the workgroup's threads are shared out among the tile's patches, as the binary logarithm of
// how many patches are worked on at a time: as many as there are, rounded up, at most WORKGROUP.
fn share_patches(tile: Tile) -> u32 {
    let more = tile.last_patch - tile.first_patch; // one less than the number of patches
    return min(select(0u, firstLeadingBit(more) + 1u, more != 0u), firstLeadingBit(WORKGROUP));
}

// needs: shared/tile_size; bindings: job, tiles
// A tile: consecutive elements of the output, expanded by one workgroup, and its patches.

struct Tile {
    // Its first element and the elements begin..end that are to be written.
    base: u32,
    begin: u32,
    end: u32,
    // The first and last patch that have elements in it.
    first_patch: u32,
    last_patch: u32,
}

// The tile of a workgroup; `end` is 0 if there is none for it. `begin..end` is the portion's range,
// whose table of tiles begins at `table_at`.
fn tile_of(workgroup: u32, begin: u32, end: u32, table_at: u32) -> Tile {
    let portion_first = tile_at(begin);
    let first = max(portion_first, job.window_first);
    let last = min(tile_end(end), job.window_first + job.window_tiles);
    let number = first + workgroup;
    if end <= begin || number >= last {
        return Tile(0u, 0u, 0u, 0u, 0u);
    }
    let base = number << job.tile_bits;
    let at = table_at + number - portion_first;
    return Tile(base, max(base, begin), min(base + (1u << job.tile_bits), end), tiles[at], tiles[at + 1u]);
}

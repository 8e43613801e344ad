// needs: nothing
// The elements of a tile in a long batch: a constant, so that loops over them are cheap.

fn tile_size() -> u32 {
    return TILE;
}

// needs: nothing; bindings: job
// The elements of a tile in a short batch.

fn tile_size() -> u32 {
    return 1u << job.tile_bits;
}

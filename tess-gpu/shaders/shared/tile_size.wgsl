// needs: nothing; bindings: job
// A tile has 2^tile_bits consecutive elements of the output.

// The tile of an element.
fn tile_at(element: u32) -> u32 {
    return element >> job.tile_bits;
}

// One more than the last tile of the elements before `end`.
fn tile_end(end: u32) -> u32 {
    return (end + (1u << job.tile_bits) - 1u) >> job.tile_bits;
}

// needs: nothing; bindings: job, offsets
// Where in the whole output a patch begins: [POINTS] and [PRIMITIVES].

fn patch_offset(patch_index: u32) -> vec2<u32> {
    return offsets[patch_index] + offsets[job.blocks_at + (patch_index >> BLOCK_BITS)]
        + offsets[job.sections_at + (patch_index >> SECTION_BITS)];
}

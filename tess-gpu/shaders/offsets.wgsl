// Where in the whole output a patch begins: points and primitives.

fn patch_offset(patch_index: u32) -> vec2<u32> {
    return offsets[patch_index] + offsets[job.blocks_at + (patch_index >> 8u)]
        + offsets[job.groups_at + (patch_index >> 16u)];
}

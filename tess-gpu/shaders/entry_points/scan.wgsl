// needs: shared/prefix_sum, layout/setup
// One workgroup per section, one thread per block.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read_write> offsets: array<vec2<u32>>;

fn block_count() -> u32 {
    return (job.patches + BLOCK - 1u) / BLOCK;
}

// No overflow: the 65536 patches of a section have at most 2^29 triangles.
@compute @workgroup_size(SUMMED)
fn scan(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let section = workgroup.x + workgroup.y * job.max_workgroups;
    let block = section * SECTION_BLOCKS + thread;
    var own = vec2<u32>(0u, 0u);
    if block < block_count() {
        own = offsets[job.blocks_at + block];
    }
    let sums = prefix_sums(thread, own);
    if block < block_count() {
        offsets[job.blocks_at + block] = sums.before;
    }
    // The last row of workgroups can have more than there are sections.
    if thread == 0u && block < block_count() {
        offsets[job.sections_at + section] = sums.all;
    }
}

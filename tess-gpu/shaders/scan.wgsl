// The upper levels of the prefix sums over all patches. A patch's place in the output is the sum
// of three numbers: its offset within its block of 256 patches (the stage `factors` wrote it),
// the block's offset within its group of 256 blocks, and the group's offset in the output.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read_write> offsets: array<vec2<u32>>;

fn blocks() -> u32 {
    return (job.patches + 255u) / 256u;
}

// One workgroup per group: sums of blocks become offsets within the group.
// No overflow: 65536 patches have at most 2^29 triangles.
@compute @workgroup_size(256)
fn scan(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let block = workgroup.x * 256u + thread;
    var own = vec2<u32>(0u, 0u);
    if block < blocks() {
        own = offsets[job.blocks_at + block];
    }
    let sums = prefix_sums(thread, own);
    if block < blocks() {
        offsets[job.blocks_at + block] = sums.before;
    }
    if thread == 0u {
        offsets[job.groups_at + workgroup.x] = sums.all;
    }
}

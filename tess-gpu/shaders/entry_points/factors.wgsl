// needs: shared/block, {listing}, layout/setup
// One workgroup per block of patches.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> raw_factors: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> tables: array<u32>;
@group(0) @binding(3) var<storage, read_write> topologies: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read_write> contexts: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read_write> offsets: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read_write> catalogue: array<atomic<u32>>;

@compute @workgroup_size(BLOCK)
fn factors(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let block = workgroup.x + workgroup.y * job.max_workgroups;
    let all = process_block(block, thread).all;
    if thread == 0u && block + job.first_patch == 0u {
        empty_catalogue();
    }
    if thread == 0u && block * BLOCK < job.patches {
        offsets[job.blocks_at + block] = all;
    }
}

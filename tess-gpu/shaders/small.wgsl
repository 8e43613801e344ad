// needs: block, finish, search, state
// A small batch: one workgroup does what the stages `factors`, `scan`, `totals` and `partition` do for
// a large one, because four small dispatches take longer than their work. Its patches are
// one section of one chunk, and their output is below 2^32.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> raw_factors: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> tables: array<u32>;
@group(0) @binding(3) var<storage, read_write> topologies: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read_write> contexts: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read_write> offsets: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read_write> status: Status;
@group(0) @binding(7) var<storage, read_write> tiles: array<u32>;
@group(0) @binding(8) var<storage, read_write> arguments: array<u32>;

@compute @workgroup_size(BLOCK)
fn small(@builtin(local_invocation_index) thread: u32) {
    var sum = vec2<u32>(0u, 0u);
    for (var block = 0u; block * BLOCK < job.patches; block++) {
        workgroupBarrier(); // before a block's workgroup memory serves the next one
        let all = process_block(block, thread);
        if thread == 0u {
            offsets[job.blocks_at + block] = sum;
        }
        sum += all;
    }
    let range = Range(0u, sum.x, 0u, sum.y);
    if thread == 0u {
        offsets[job.sections_at] = vec2<u32>(0u, 0u);
        status.points = sum.x;
        status.points_high = 0u;
        status.primitives = sum.y;
        status.primitives_high = 0u;
        status.ranges[0] = range;
    }
    storageBarrier();
    finish(thread);
    if overflow() != 0u {
        return;
    }
    let count = entries(range.points_begin, range.points_end)
        + entries(range.primitives_begin, range.primitives_end);
    for (var number = thread; number < count; number += BLOCK) {
        write_entry(number, range);
    }
}

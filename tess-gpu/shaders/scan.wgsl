// The upper levels of the prefix sums over all patches. A patch's place in the output is the sum
// of three numbers: its offset within its block of 256 patches (the stage `factors` wrote it),
// the block's offset within its group of 256 blocks, and the group's offset in the output.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read_write> offsets: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> status: Status;

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

// The sum of a.x + 2^16 * a.y and b, as low and high word. Both parts of `a` are below 2^24.
fn add_wide(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let shifted = a.y << 16u;
    let sum = a.x + shifted;
    let low = sum + b.x;
    let carries = select(0u, 1u, sum < shifted) + select(0u, 1u, low < sum);
    return vec2<u32>(low, (a.y >> 16u) + b.y + carries);
}

// One workgroup: sums of groups become offsets in the output, behind the chunks before; the
// totals grow by this chunk's. Offsets wrap where the output could not fit anyway; the totals, summed in halves of 16 bits,
// do not.
@compute @workgroup_size(256)
fn totals(@builtin(local_invocation_index) thread: u32) {
    let groups = (blocks() + 255u) / 256u;
    var own = vec2<u32>(0u, 0u);
    if thread < groups {
        own = offsets[job.groups_at + thread];
    }
    let sums = prefix_sums(thread, own);
    let points = prefix_sums(thread, vec2<u32>(own.x & 0xffffu, own.x >> 16u)).all;
    let primitives = prefix_sums(thread, vec2<u32>(own.y & 0xffffu, own.y >> 16u)).all;
    let begin = vec2<u32>(status.points, status.primitives);
    storageBarrier();
    if thread < groups {
        offsets[job.groups_at + thread] = begin + sums.before;
    }
    if thread == 0u {
        let end = begin + sums.all;
        status.ranges[job.chunk] = Range(begin.x, end.x, begin.y, end.y);
        let all_points = add_wide(points, vec2<u32>(status.points, status.points_high));
        let all_primitives =
            add_wide(primitives, vec2<u32>(status.primitives, status.primitives_high));
        status.points = all_points.x;
        status.points_high = all_points.y;
        status.primitives = all_primitives.x;
        status.primitives_high = all_primitives.y;
    }
}

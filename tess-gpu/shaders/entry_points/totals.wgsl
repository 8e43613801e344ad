// needs: shared/finish, shared/prefix_sum, layout/setup
// One workgroup, one thread per section. After the last portion it also does the work that depends on
// the totals (shared/finish.wgsl).

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read_write> offsets: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> status: Status;
@group(0) @binding(3) var<storage, read_write> arguments: array<u32>;

// How often the sums over the sections pass 2^32.
var<workgroup> carries: array<atomic<u32>, 2>;

@compute @workgroup_size(SUMMED)
fn totals(@builtin(local_invocation_index) thread: u32) {
    let sections = (job.patches + SECTION - 1u) / SECTION;
    var own = vec2<u32>(0u, 0u);
    if thread < sections {
        own = offsets[job.sections_at + thread];
    }
    if thread < 2u {
        atomicStore(&carries[thread], 0u);
    }
    let sums = prefix_sums(thread, own);
    var begin = vec2<u32>(0u, 0u);
    var high = vec2<u32>(0u, 0u);
    if job.portion > 0u {
        begin = vec2<u32>(status.points, status.primitives);
        high = vec2<u32>(status.points_high, status.primitives_high);
    }
    // Modulo 2^32. A section has less than 2^32 elements, so its sum passes 2^32 at most once, and the carries of all
    // sections add up to the upper word.
    let own_begin = begin + sums.before;
    let carry = vec2<u32>(own_begin + own < own_begin);
    atomicAdd(&carries[0], carry.x);
    atomicAdd(&carries[1], carry.y);
    // All carries are counted, and all threads have read the portion before, which thread 0 replaces.
    workgroupBarrier();
    storageBarrier();
    if thread < sections {
        offsets[job.sections_at + thread] = own_begin;
    }
    if thread == 0u {
        let end = begin + sums.all;
        status.ranges[job.portion] = Range(begin.x, end.x, begin.y, end.y);
        status.points = end.x;
        status.points_high = high.x + atomicLoad(&carries[0]);
        status.primitives = end.y;
        status.primitives_high = high.y + atomicLoad(&carries[1]);
    }
    storageBarrier();
    if job.portion + 1u >= job.portions {
        finish(thread);
    }
}

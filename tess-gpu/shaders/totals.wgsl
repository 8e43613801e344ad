// needs: prefix_sum, state
// One workgroup: sums of groups become offsets in the output, behind the chunks before; the totals
// grow by this chunk's. Offsets wrap where the output could not fit anyway; the totals have a
// second word for that. Behind the last chunk follows what depends on the totals: whether
// the output fits, the draw arguments and the sizes of the dispatches.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read_write> offsets: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> status: Status;
// draw_indexed_indirect's five numbers, three reserved, then dispatch sizes of three numbers:
// for each chunk its partition, its windows of points, its windows of primitives.
@group(0) @binding(3) var<storage, read_write> arguments: array<u32>;

fn write_dispatch(number: u32, workgroups: u32) {
    let rows = (workgroups + job.max_workgroups - 1u) / job.max_workgroups;
    let at = DISPATCHES_AT + 3u * number;
    arguments[at] = select(job.max_workgroups, workgroups, rows <= 1u);
    arguments[at + 1u] = max(rows, 1u);
    arguments[at + 2u] = 1u;
}

// Tiles that begin..end touches.
fn tiles_between(begin: u32, end: u32) -> u32 {
    return select(0u, (end + TILE - 1u) / TILE - begin / TILE, end > begin);
}

// Tiles of begin..end in a window.
fn tiles_in_window(begin: u32, end: u32, window: u32, window_tiles: u32) -> u32 {
    let first = max(begin / TILE, window * window_tiles);
    let last = min((end + TILE - 1u) / TILE, (window + 1u) * window_tiles);
    return select(0u, last - first, last > first && end > begin);
}

fn workgroups_of(slot: u32, range: Range) -> u32 {
    if slot == 0u {
        let count = tiles_between(range.points_begin, range.points_end)
            + tiles_between(range.primitives_begin, range.primitives_end);
        return (count + 2u + WORKGROUP - 1u) / WORKGROUP; // one more entry for each output: see partition.wgsl
    }
    if slot <= job.point_windows {
        return tiles_in_window(
            range.points_begin, range.points_end, slot - 1u, job.point_window_tiles);
    }
    return tiles_in_window(
        range.primitives_begin, range.primitives_end,
        slot - 1u - job.point_windows, job.primitive_window_tiles);
}

fn overflow() -> u32 {
    let points = status.points_high != 0u || status.points > job.point_capacity;
    let primitives = status.primitives_high != 0u || status.primitives > job.primitive_capacity;
    return select(0u, 1u, points) | select(0u, 2u, primitives);
}

// For the whole batch: the draw arguments, and the workgroups of every chunk in every window.
fn finish(thread: u32) {
    let slots = 1u + job.point_windows + job.primitive_windows;
    let is_overflow = overflow();
    for (var slot = thread; slot < job.chunks * slots; slot += SUMMED) {
        let workgroups = workgroups_of(slot % slots, status.ranges[slot / slots]);
        write_dispatch(slot, select(workgroups, 0u, is_overflow != 0u));
    }
    if thread == 0u {
        status.overflow = is_overflow;
        arguments[0] = select(status.primitives * INDICES, 0u, is_overflow != 0u);
        arguments[1] = 1u; // instances
        arguments[2] = 0u; // first index
        arguments[3] = 0u; // base vertex
        arguments[4] = 0u; // first instance
    }
}

// How often the sums over the groups pass 2^32.
var<workgroup> carries: array<atomic<u32>, 2>;

@compute @workgroup_size(SUMMED)
fn totals(@builtin(local_invocation_index) thread: u32) {
    let groups = (job.patches + GROUP - 1u) / GROUP;
    var own = vec2<u32>(0u, 0u);
    if thread < groups {
        own = offsets[job.groups_at + thread];
    }
    if thread < 2u {
        atomicStore(&carries[thread], 0u);
    }
    let sums = prefix_sums(thread, own);
    let begin = vec2<u32>(status.points, status.primitives);
    let own_begin = begin + sums.before;
    let carry = vec2<u32>(own_begin + own < own_begin);
    atomicAdd(&carries[0], carry.x);
    atomicAdd(&carries[1], carry.y);
    workgroupBarrier();
    storageBarrier();
    if thread < groups {
        offsets[job.groups_at + thread] = own_begin;
    }
    if thread == 0u {
        let end = begin + sums.all;
        status.ranges[job.chunk] = Range(begin.x, end.x, begin.y, end.y);
        status.points = end.x;
        status.points_high += atomicLoad(&carries[0]);
        status.primitives = end.y;
        status.primitives_high += atomicLoad(&carries[1]);
    }
    storageBarrier();
    if job.chunk + 1u >= job.chunks {
        finish(thread);
    }
}

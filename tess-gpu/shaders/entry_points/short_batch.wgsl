// needs: shared/block, shared/finish, layout/setup, shared/tile_size
// A short batch: one workgroup does what the stages `factors`, `scan`, `totals` and `partition` do for
// a long one, because four little dispatches take longer than their work. Its patches are
// one section of one portion, and their output is below 2^32.

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
fn short_batch(@builtin(local_invocation_index) thread: u32) {
    var sum = vec2<u32>(0u, 0u);
    // This thread's last patch that has output, and where that ends.
    var last = NEVER;
    var last_end = vec2<u32>(0u, 0u);
    for (var block = 0u; block * BLOCK < job.patches; block++) {
        workgroupBarrier(); // before a block's workgroup memory serves the next one
        let in_block = process_block(block, thread);
        if thread == 0u {
            offsets[job.blocks_at + block] = sum;
        }
        if any(in_block.own != vec2<u32>(0u, 0u)) {
            let begin = sum + in_block.before;
            last = block * BLOCK + thread;
            last_end = begin + in_block.own;
            write_tiles(0u, begin.x, last_end.x, job.point_capacity, last);
            write_tiles(job.primitive_tiles_at, begin.y, last_end.y, job.primitive_capacity, last);
        }
        sum += in_block.all;
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
    let is_overflow = overflow(sum, vec2<u32>(0u, 0u));
    if thread < slots() {
        write_dispatch(thread, workgroups_of(thread, range, is_overflow));
    }
    if thread == 0u {
        write_draw(sum.y, is_overflow);
    }
    if is_overflow == 0u && last != NEVER {
        // Behind the last tile: the patch of the last element.
        if last_end.x == sum.x {
            tiles[tile_end(sum.x)] = last;
        }
        if last_end.y == sum.y {
            tiles[job.primitive_tiles_at + tile_end(sum.y)] = last;
        }
    }
}

// The table of tiles, as shared/search.wgsl has it, from the patches: each is entered for the tiles that begin in it.
// What does not fit is not entered.
fn write_tiles(first_entry: u32, begin: u32, end: u32, capacity: u32, patch_index: u32) {
    if end > capacity {
        return;
    }
    for (var tile = tile_end(begin); tile < tile_end(end); tile++) {
        tiles[first_entry + tile] = patch_index;
    }
}

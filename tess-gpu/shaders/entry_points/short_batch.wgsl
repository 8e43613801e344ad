// needs: shared/block, shared/finish, layout/setup, shared/tile_size
// A short batch, of up to 1024 patches with little output: one workgroup does everything that precedes the
// expansion.
//
// A long batch runs `factors`, `scan`, `totals` and `partition` here, four dispatches that each wait for the one
// before. Their work for a short batch takes less time than their beginning, so one workgroup of 256 threads does
// it, a block of patches at a time, and keeps the sums in registers.
//
// Three quad patches (3, 4.5, 5, 6; 4, 7) have 129 points in tiles of 128, so patch 0 begins tile 0 and patch 2
// tile 1:
//
//   points begin at [0, 43, 86], end at 129; tiles of points [0, 2], then 2 for the last point
//
// What must hold:
// - The batch is one section of one portion, and its output is below 2^32 (src/plan.rs, `is_short`): no carries.
// - A barrier separates the blocks, whose workgroup memory is the same.
// - A patch enters no tile if its elements end beyond the room, so that no write leaves the table.
// - The last patch that has output enters one more tile, where the expansion looks for the last patch of the last
//   tile.
//
// The long form takes four dispatches, of 9 to 10 microseconds for each two on an H200. 256 patches of `character`
// took 17 microseconds when each tile searched for its patch and totals were read back, and take 15 now
// (docs/experiments.md, "Small batches").

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
        // After the last tile: the patch of the last element.
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

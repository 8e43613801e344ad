// needs: state
// For each tile of the output, the patch that its first element belongs to: one thread per tile,
// a binary search on each level of the offsets. One more entry says to whom the last element belongs.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> offsets: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> status: Status;
@group(0) @binding(3) var<storage, read_write> tiles: array<u32>;

fn offset_at(index: u32, kind: u32) -> u32 {
    return offsets[index][kind];
}

// The number of the last of `count` (1..=SUMMED) ascending entries, from entry `first` on, that is at
// most `goal`. The first one always is.
fn last_at_or_before(first: u32, count: u32, kind: u32, goal: u32) -> u32 {
    var found = 0u;
    if count > 16u {
        found = nearer_entry(found, 128u, first, count, kind, goal);
        found = nearer_entry(found, 64u, first, count, kind, goal);
        found = nearer_entry(found, 32u, first, count, kind, goal);
        found = nearer_entry(found, 16u, first, count, kind, goal);
    }
    if count > 1u {
        found = nearer_entry(found, 8u, first, count, kind, goal);
        found = nearer_entry(found, 4u, first, count, kind, goal);
        found = nearer_entry(found, 2u, first, count, kind, goal);
        found = nearer_entry(found, 1u, first, count, kind, goal);
    }
    return found;
}

fn nearer_entry(found: u32, reach: u32, first: u32, count: u32, kind: u32, goal: u32) -> u32 {
    let next = min(found + reach, count - 1u);
    return select(found, next, offset_at(first + next, kind) <= goal);
}

// The patch that an element of this chunk's output belongs to; `kind` is POINTS or PRIMITIVES.
// Among patches that begin together only the last one has elements.
fn patch_of(goal: u32, kind: u32) -> u32 {
    let blocks = (job.patches + BLOCK - 1u) >> BLOCK_BITS;
    let groups = (blocks + GROUP_BLOCKS - 1u) >> GROUP_BLOCK_BITS;
    let group = last_at_or_before(job.groups_at, groups, kind, goal);
    let in_group = goal - offset_at(job.groups_at + group, kind);
    let first_block = job.blocks_at + (group << GROUP_BLOCK_BITS);
    let count = min(GROUP_BLOCKS, blocks - (group << GROUP_BLOCK_BITS));
    let block = (group << GROUP_BLOCK_BITS) + last_at_or_before(first_block, count, kind, in_group);
    let in_block = in_group - offset_at(job.blocks_at + block, kind);
    let patches = min(BLOCK, job.patches - (block << BLOCK_BITS));
    return (block << BLOCK_BITS) + last_at_or_before(block << BLOCK_BITS, patches, kind, in_block);
}

// Entries for begin..end: one per tile and one for the last element.
fn entries(begin: u32, end: u32) -> u32 {
    return select(0u, (end + TILE - 1u) / TILE - begin / TILE + 1u, end > begin);
}

fn entry(number: u32, begin: u32, end: u32, kind: u32) -> u32 {
    let element = (begin / TILE + number) * TILE;
    return patch_of(clamp(element, begin, end - 1u), kind);
}

@compute @workgroup_size(WORKGROUP)
fn partition_tiles(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let number = (workgroup.x + workgroup.y * job.max_workgroups) * WORKGROUP + thread;
    let range = status.ranges[job.chunk];
    let point_entries = entries(range.points_begin, range.points_end);
    let primitive_entries = entries(range.primitives_begin, range.primitives_end);
    if number < point_entries {
        tiles[number] = entry(number, range.points_begin, range.points_end, POINTS);
    } else if number - point_entries < primitive_entries {
        let own = number - point_entries;
        tiles[job.primitive_tiles_at + own] =
            entry(own, range.primitives_begin, range.primitives_end, PRIMITIVES);
    }
}

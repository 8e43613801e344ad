// One workgroup per tile of points: the tile's runs first, then every point of it.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> topologies: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> contexts: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> offsets: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> status: Status;
@group(0) @binding(5) var<storage, read> tiles: array<u32>;
@group(0) @binding(6) var<storage, read_write> points_out: array<vec2<u32>>;

var<workgroup> runs: array<u32, TILE>;
var<workgroup> run_patches: array<u32, TILE>;

fn context_of(patch_index: u32, context: u32) -> vec2<u32> {
    return contexts[context * job.stride + patch_index];
}

fn lay_down_runs(tile: Tile, patch_index: u32, lane: u32, lanes: u32) {
    let topology = topologies[patch_index];
    let offset = patch_offset(patch_index).x;
    let count = point_runs(topology);
    for (var run = lane; run < count; run += lanes) {
        let own = point_run(topology, run);
        let begin = offset + own.start;
        let position = lay_down(tile, begin, begin + own.size);
        if position < TILE {
            runs[position] = describe_run(patch_index, topology, run);
            run_patches[position] = patch_index;
        }
    }
}

fn write_point(tile: Tile, element: u32) {
    let found = find_segment(element);
    let patch_index = run_patches[found.position];
    let point = point_of_run(patch_index, runs[found.position], found.step);
    let at = tile.base + element - job.window_first * TILE;
    points_out[at] = format_point(point, job.first_patch + patch_index);
}

@compute @workgroup_size(WORKGROUP)
fn expand_points(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let range = status.ranges[job.chunk];
    let number = workgroup.x + workgroup.y * workgroups.x;
    let tile = tile_of(number, range.points_begin, range.points_end, 0u);
    if tile.end == 0u {
        return;
    }
    clear_segments(thread);
    workgroupBarrier();
    let share = share_patches(tile);
    let lanes = WORKGROUP >> share;
    let first = tile.first_patch + thread / lanes;
    for (var patch_index = first; patch_index <= tile.last_patch; patch_index += 1u << share) {
        lay_down_runs(tile, patch_index, thread % lanes, lanes);
    }
    workgroupBarrier();
    link_segments(thread);
    workgroupBarrier();
    for (var element = thread; element < TILE; element += WORKGROUP) {
        let at = tile.base + element;
        if at >= tile.begin && at < tile.end {
            write_point(tile, element);
        }
    }
}

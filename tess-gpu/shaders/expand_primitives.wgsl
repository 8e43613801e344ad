// One workgroup per tile of primitives: the tile's segments first, then every primitive of it.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> topologies: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> tables: array<u32>;
@group(0) @binding(3) var<storage, read> offsets: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> status: Status;
@group(0) @binding(5) var<storage, read> tiles: array<u32>;
@group(0) @binding(6) var<storage, read_write> indices_out: array<u32>;

var<workgroup> stitches_x: array<u32, TILE>;
var<workgroup> stitches_y: array<u32, TILE>;
var<workgroup> stitches_z: array<u32, TILE>;

fn lay_down_segments(tile: Tile, patch_index: u32, lane: u32, lanes: u32) {
    let topology = topologies[patch_index];
    let offset = patch_offset(patch_index);
    let base = select(0u, offset.x, NUMBERING == PER_BATCH);
    let count = primitive_segments(topology);
    for (var segment = lane; segment < count; segment += lanes) {
        let own = primitive_segment(topology, segment);
        let begin = offset.y + own.start;
        let position = lay_down(tile, begin, begin + own.size);
        if position < TILE {
            let stitch = describe_segment(topology, segment, base);
            stitches_x[position] = stitch.x;
            stitches_y[position] = stitch.y;
            stitches_z[position] = stitch.z;
        }
    }
}

fn write_primitive(tile: Tile, element: u32) {
    let found = find_segment(element);
    let at = (tile.base + element - job.window_first * TILE) * INDICES;
    let first = stitches_x[found.position];
    if IS_TRIANGLES {
        let stitch = vec3<u32>(first, stitches_y[found.position], stitches_z[found.position]);
        let triangle = stitch_triangle(stitch, found.step);
        indices_out[at] = triangle.x;
        indices_out[at + 1u] = triangle.y;
        indices_out[at + 2u] = triangle.z;
    } else {
        indices_out[at] = first + found.step;
        if INDICES == 2u {
            indices_out[at + 1u] = first + found.step + 1u;
        }
    }
}

@compute @workgroup_size(WORKGROUP)
fn expand_primitives(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let range = status.ranges[job.chunk];
    let number = workgroup.x + workgroup.y * workgroups.x;
    let tile = tile_of(
        number, range.primitives_begin, range.primitives_end, job.primitive_tiles_at);
    if tile.end == 0u {
        return;
    }
    clear_segments(thread);
    workgroupBarrier();
    let share = share_patches(tile);
    let lanes = WORKGROUP >> share;
    let first = tile.first_patch + thread / lanes;
    for (var patch_index = first; patch_index <= tile.last_patch; patch_index += 1u << share) {
        lay_down_segments(tile, patch_index, thread % lanes, lanes);
    }
    workgroupBarrier();
    link_segments(thread);
    workgroupBarrier();
    for (var element = thread; element < TILE; element += WORKGROUP) {
        let at = tile.base + element;
        if at >= tile.begin && at < tile.end {
            write_primitive(tile, element);
        }
    }
}

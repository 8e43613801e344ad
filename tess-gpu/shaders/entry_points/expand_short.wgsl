// needs: shared/point_tile, shared/primitive_tile, layout/setup, shared/tile_size
// Both expansions of a short batch in one dispatch: one workgroup per tile, those of the points first.
// The indices are binding 6 (variants/indices_u32.wgsl, variants/indices_u16.wgsl).

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> topologies: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> contexts: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> tables: array<u32>;
@group(0) @binding(4) var<storage, read> offsets: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read> status: Status;
@group(0) @binding(7) var<storage, read> tiles: array<u32>;
@group(0) @binding(8) var<storage, read_write> points_out: array<vec2<u32>>;

@compute @workgroup_size(THREADS)
fn expand_short(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let number = workgroup.x + workgroup.y * job.max_workgroups;
    let point_tiles = tile_end(job.point_capacity);
    if number < point_tiles {
        write_point_tile(number, thread);
    } else {
        write_primitive_tile(number - point_tiles, thread);
    }
}

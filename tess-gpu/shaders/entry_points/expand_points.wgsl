// needs: shared/point_tile, layout/setup
// One workgroup per tile of points.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> topologies: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> contexts: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> tables: array<u32>;
@group(0) @binding(4) var<storage, read> offsets: array<vec2<u32>>;
@group(0) @binding(5) var<storage, read> status: Status;
@group(0) @binding(6) var<storage, read> tiles: array<u32>;
@group(0) @binding(7) var<storage, read_write> points_out: array<vec2<u32>>;
@group(0) @binding(8) var<storage, read> catalogue: array<u32>;

@compute @workgroup_size(THREADS)
fn expand_points(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let number = workgroup.x + workgroup.y * job.max_workgroups;
    write_point_tile(number, thread);
}

// needs: shared/search, layout/setup
// One thread per entry of the table of tiles.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> offsets: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> status: Status;
@group(0) @binding(3) var<storage, read_write> tiles: array<u32>;

@compute @workgroup_size(WORKGROUP)
fn partition_tiles(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let number = (workgroup.x + workgroup.y * job.max_workgroups) * WORKGROUP + thread;
    write_entry(number, status.ranges[job.portion]);
}

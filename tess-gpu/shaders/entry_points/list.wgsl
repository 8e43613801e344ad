// needs: shared/catalogue, stages/connect, stages/counts, shared/described, layout/packed_triangle, layout/point_format, stages/points, layout/setup
// One workgroup per slot of the catalogue.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> tables: array<u32>;
@group(0) @binding(2) var<storage, read_write> catalogue: array<atomic<u32>>;

// Where the points and the triangles of this topology go; 0 if there is no room.
var<workgroup> places: vec2<u32>;

// Room for a topology with these points and triangles.
fn take_room(counts: vec2<u32>) -> vec2<u32> {
    let points = atomicAdd(&catalogue[USED_AT], counts.x);
    let triangles = atomicAdd(&catalogue[USED_AT + 1u], counts.y);
    if points + counts.x > CATALOGUE_POINTS || triangles + counts.y > CATALOGUE_TRIANGLES {
        return vec2<u32>(0u, 0u);
    }
    return vec2<u32>(POINTS_AT + POINT_WORDS * points, TRIANGLES_AT + triangles);
}

fn keep_point(topology: vec2<u32>, i: u32, at: u32) {
    if IS_INTEGER {
        let run = run_at_point(0u, topology, i);
        let point = format_point(point_of_run(run, run.step), 0u);
        atomicStore(&catalogue[at], point.x);
        atomicStore(&catalogue[at + 1u], point.y);
    } else {
        atomicStore(&catalogue[at], described_point(topology, i));
    }
}

@compute @workgroup_size(WORKGROUP)
fn list(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let slot = workgroup.x + workgroup.y * job.max_workgroups;
    if slot >= SLOTS {
        return;
    }
    let key = atomicLoad(&catalogue[slot]);
    let topology = topology_of(key);
    let counts = counts(topology);
    if thread == 0u {
        places = vec2<u32>(0u, 0u);
        if key != 0u {
            places = take_room(counts);
        }
        atomicStore(&catalogue[PLACES_AT + 2u * slot], places.x);
        atomicStore(&catalogue[PLACES_AT + 2u * slot + 1u], places.y);
    }
    workgroupBarrier();
    if thread == 0u {
        atomicStore(&catalogue[slot], 0u); // for the next run
    }
    if places.x == 0u {
        return;
    }
    for (var i = thread; i < counts.x; i += WORKGROUP) {
        keep_point(topology, i, places.x + POINT_WORDS * i);
    }
    for (var t = thread; t < counts.y; t += WORKGROUP) {
        atomicStore(&catalogue[places.y + t], packed_triangle(triangle_of(topology, t)));
    }
}

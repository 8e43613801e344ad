// needs: shared/offsets, layout/setup
// One thread per group.

@group(0) @binding(0) var<uniform> job: Job;
@group(0) @binding(1) var<storage, read> offsets: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> status: Status;
// The first patch of each group.
@group(0) @binding(3) var<storage, read> group_begins: array<u32>;
@group(0) @binding(4) var<storage, read_write> draws: array<DrawIndexed>;

// The host's `layout::DrawIndexed`.
struct DrawIndexed {
    index_count: u32,
    instance_count: u32,
    first_index: u32,
    base_vertex: u32,
    first_instance: u32,
}

// The first index of a patch of this portion; past the portion, the end of its indices.
fn first_index_of(patch_number: u32) -> u32 {
    let patch_index = patch_number - job.first_patch;
    if patch_index >= job.patches {
        return status.ranges[job.portion].primitives_end * INDICES;
    }
    return patch_offset(patch_index)[PRIMITIVES] * INDICES;
}

@compute @workgroup_size(WORKGROUP)
fn groups(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let group = (workgroup.x + workgroup.y * job.max_workgroups) * WORKGROUP + thread;
    let count = arrayLength(&group_begins);
    if group >= count {
        return;
    }
    let begin = group_begins[group];
    var end = NEVER;
    if group + 1u < count {
        end = group_begins[group + 1u];
    }
    if begin >= job.first_patch {
        draws[group] = DrawIndexed(0u, 1u, first_index_of(begin), 0u, 0u);
    }
    if end >= job.first_patch && status.overflow == 0u {
        draws[group].index_count = first_index_of(end) - draws[group].first_index;
    }
}

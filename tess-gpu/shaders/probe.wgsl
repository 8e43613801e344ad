// needs: {probe}
// One thread per probe.

@compute @workgroup_size(WORKGROUP)
fn probes(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    probe((workgroup.x + workgroup.y * workgroups.x) * WORKGROUP + thread);
}
